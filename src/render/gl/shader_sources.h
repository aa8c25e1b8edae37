// The GLSL files of src/render/shaders, embedded at build time.
#pragma once

#include <string_view>

namespace carom {

/// The text of `shaders/NAME.glsl`, or empty if there is none.
std::string_view shader_source(std::string_view name);

}  // namespace carom
