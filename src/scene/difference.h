// What two scenes simulate differently, for the text on a film that shows both.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/reader.h"

namespace carom {

/// A value that is not the same in both: its path as --set takes it, and both values as YAML
/// (shortened where they are long), defaults filled in; "none" where there is nothing.
struct SceneDifference {
    std::string path;
    std::string first, second;
};

/// Compares simulation, materials, pairs, surfaces, defaults and balls of two texts after their
/// overrides, in the order of the reference; how things look, and the film, do not count. Both
/// texts must have been read without error.
std::vector<SceneDifference> scene_differences(std::string_view first,
                                               const std::vector<Override>& first_overrides,
                                               std::string_view second,
                                               const std::vector<Override>& second_overrides);

}  // namespace carom
