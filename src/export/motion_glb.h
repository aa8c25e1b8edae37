// A scene with its motion as glTF 2.0 (.glb), for Blender, game engines and browsers.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// The bytes of the file: balls with their markings, surfaces, the camera, and one animation whose
/// splines are the motion itself (export/key_frames.h): off by at most 2 * 2^-23 of the motion's
/// extent and 1e-6 rad at every instant that is a float. docs/exports.md says what is in it.
/// `version` is carom's. `told` is called for each ball; it may throw. Markings are drawn with
/// OpenGL: Failure(kRun) as painters have it, only where a ball has any.
std::string motion_glb(const Scene& scene, const Motion& motion, std::string_view version,
                       const std::function<void(double part)>& told = {});

}  // namespace carom
