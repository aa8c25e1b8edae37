// View space: where the scene is as the eye sees it, in double precision.
#pragma once

#include "core/types.h"
#include "render/view/camera.h"

namespace carom {

/// View space: the eye is the origin, x right, y down, z forward; metres. Computed in double from
/// world coordinates, so that a scene far from the origin loses nothing at the float border.
Vec3 view_direction(const View& view, const Vec3& world);
Vec3 view_point(const View& view, const Vec3& world);

/// Width of a pixel on the plane one metre before the eye, or everywhere under parallel rays, m.
double pixel_width(const View& view);

/// Where a point of view space, before the eye, is seen: pixels.
Vec2 view_pixel(const View& view, const Vec3& point);

}  // namespace carom
