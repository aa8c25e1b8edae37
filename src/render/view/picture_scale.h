// Lengths that make a picture look the same whether the scene is a millimetre or a kilometre wide.
#pragma once

#include "scene/scene.h"

namespace carom {

/// Lengths that the picture's atmosphere scales with, metres.
struct PictureScale {
    double fade_m = 50;       ///< distance at which planes melt into the horizon
    double ao_reach_m = 0.3;  ///< how far a crevice darkens its surroundings
};

/// From the camera's distance, and from the median of the balls' radii where there are balls.
PictureScale scale_of(const Scene& scene, const Camera& camera);

}  // namespace carom
