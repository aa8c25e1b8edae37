// What common.glsl is told: the camera and the light, before and after it is compiled.
#pragma once

#include <string>
#include <vector>

#include "render/gl/gl_program.h"
#include "render/view/camera.h"
#include "render/view/lights.h"

namespace carom {

/// What common.glsl must be told before it is compiled for this view.
std::vector<std::string> view_defines(const View& view);

/// Sets the uniforms of common.glsl in the program, which becomes current.
void set_common_uniforms(GlProgram& program, const View& view, const Lights& lights);

}  // namespace carom
