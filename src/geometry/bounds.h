// The box with sides along the axes around a shape.
#pragma once

#include "geometry/shape.h"

namespace carom {

/// Empty for a plane, which has no bounds.
Box3 bounds_of(const SurfaceShape& shape);

}  // namespace carom
