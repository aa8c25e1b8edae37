// A shape seen from another origin.
#pragma once

#include "geometry/shape.h"

namespace carom {

/// The shape in a frame with the same axes and its origin at `origin` [m]. A plane's offset has one
/// rounding's error: it and normal . origin may both be large, and their difference small.
SurfaceShape seen_from(const SurfaceShape& shape, const Vec3& origin);

}  // namespace carom
