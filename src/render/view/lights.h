// The light of a picture.
#pragma once

#include "core/types.h"
#include "render/view/camera.h"

namespace carom {

/// One directional key light with the size of a studio lamp, plus the sky (common.glsl).
struct Lights {
    Vec3 to_light = Vec3::UnitZ();  ///< world, unit, towards the lamp
    /// Tangent of the lamp's angular radius: the half-width of a penumbra per metre of distance.
    double tan_radius = 0.045;
};

/// From the upper left, before the scene: relative to the camera's heading, so that the lit side of
/// a ball is seen from everywhere, and always from above the floor (world z is up).
Lights choose_lights(const View& view);

}  // namespace carom
