// From YAML text to a Scene, with every mistake of the file in one list.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "scene/scene.h"

namespace carom {

/// `--set PATH=VALUE`: PATH goes by keys, by the names of list entries, or by [i];
/// VALUE is YAML. Applied to the document before it is validated.
struct Override {
    std::string path;
    std::string value;
};

/// The scene if there is no error in `diagnostics` (warnings may be there beside it).
struct SceneResult {
    std::optional<Scene> scene;
    Diagnostics diagnostics;
};

/// Reads a scene from text; `file` is the name that messages use.
SceneResult read_scene(std::string_view text, const std::string& file,
                       const std::vector<Override>& overrides = {});

/// The text of a scene file, or of another `kind` of file; of standard input for "-"; of a file
/// that is too large to be a scene, as much as shows it. Throws Failure(kInput) if the file is
/// missing or unreadable.
std::string read_scene_text(const std::string& path, const char* kind = "scene");

/// Reads a scene file, or standard input for "-".
/// Throws Failure(kInput) if the file is missing or unreadable.
SceneResult read_scene_file(const std::string& path, const std::vector<Override>& overrides = {});

/// "PATH=VALUE" split at the first '='; throws Failure(kInput) if there is none.
Override parse_override(const std::string& argument);

}  // namespace carom
