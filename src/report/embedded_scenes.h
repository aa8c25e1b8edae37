// Scenes that travel inside the program, so that `carom figures` and `carom new` work from any
// folder.
#pragma once

#include <string_view>
#include <vector>

namespace carom {

/// Names of the scenes inside the program: those of CMakeLists.txt (scene_files), in its order.
const std::vector<std::string_view>& embedded_scene_names();

/// The text of a scene's file. Empty for another name.
std::string_view embedded_scene(std::string_view name);

}  // namespace carom
