// The rays of a picture's pixels, in the world.
#pragma once

#include "geometry/ray.h"
#include "render/view/camera.h"

namespace carom {

/// Through the place (x, y) of the picture, pixels from its top left corner: 0.5 is the centre of
/// the first pixel. Under parallel rays it begins on the plane through the eye.
Ray pixel_ray(const View& view, double x_px, double y_px);

/// The ray on which a point before the eye is seen.
Ray ray_to(const View& view, const Vec3& point);

}  // namespace carom
