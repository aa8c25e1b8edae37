// Scenes that travel inside the program, so that `carom figures` works from any folder.
#pragma once

#include <string_view>

namespace carom {

/// The text of `scenes/NAME.yaml`: figure8, figure9. Empty for another name.
std::string_view embedded_scene(std::string_view name);

}  // namespace carom
