// The box with sides along the axes around a shape, and a sphere around it.
#pragma once

#include "geometry/shape.h"

namespace carom {

/// Empty for a plane, which has no bounds.
Box3 bounds_of(const SurfaceShape& shape);

struct SphereAround {
    Vec3 center = Vec3::Zero();
    double radius = 0;  ///< m; infinite around a plane
};
SphereAround sphere_around(const SurfaceShape& shape);

}  // namespace carom
