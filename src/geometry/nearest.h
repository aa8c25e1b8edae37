// Where a shape is nearest to a point.
#pragma once

#include "geometry/shape.h"

namespace carom {

struct Nearest {
    double gap = 0;               ///< m, negative when ball and shape overlap
    Vec3 normal = Vec3::UnitZ();  ///< unit, from the shape towards the centre
    Vec3 point = Vec3::Zero();    ///< on the shape
};

/// Of a ball of `radius` [m] around `center` [m]. Where the centre is on the core of a sphere or a
/// capsule, every direction is as good: +z. Inside a box or a cylinder the nearest face counts. A
/// ball in the middle of a ring whose hole is too small for it touches it all around: the normal is
/// along the axis then, as of all these contacts together, and the point below the ball.
Nearest nearest_on(const PlaneShape& plane, const Vec3& center, double radius);
Nearest nearest_on(const BoxShape& box, const Vec3& center, double radius);
Nearest nearest_on(const SphereShape& sphere, const Vec3& center, double radius);
Nearest nearest_on(const CapsuleShape& capsule, const Vec3& center, double radius);
Nearest nearest_on(const CylinderShape& cylinder, const Vec3& center, double radius);
Nearest nearest_on(const RingShape& ring, const Vec3& center, double radius);
Nearest nearest_on(const BowlShape& bowl, const Vec3& center, double radius);
Nearest nearest_on(const PipeShape& pipe, const Vec3& center, double radius);
Nearest nearest_on(const SurfaceShape& shape, const Vec3& center, double radius);

/// Distance from a point to the surface of a shape, m; negative inside, and behind a plane. Bowls
/// and pipes have no inside: they are walls.
double signed_distance(const SurfaceShape& shape, const Vec3& point);

}  // namespace carom
