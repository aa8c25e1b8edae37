// How a ball's gap to a shape may close: a bound from below on all ways from a place.
#pragma once

#include <limits>

#include "geometry/nearest.h"

namespace carom {

/// For every way w [m] from the centre that is no longer than `within`:
///   gap after it >= gap + normal . w - bend |w|^2 / 2.
struct GapBound {
    double gap = 0;               ///< m
    Vec3 normal = Vec3::UnitZ();  ///< unit, from the shape towards the centre
    double bend = 0;              ///< 1/m
    double within = std::numeric_limits<double>::infinity();  ///< m
};

/// Of a ball of `radius` [m] around `center` [m]. The distance from a convex body is a convex
/// function of the place: it stays above its tangent plane.
GapBound gap_bound(const CylinderShape& cylinder, const Vec3& center, double radius);
/// The distance from a circle of the radius R bends, at `away` from its axis and d from the circle,
/// by 1/d across the circle and by (away - R) / (away d) around the axis: downwards within the
/// circle, and there by no more than 1/away, since d >= R - away.
GapBound gap_bound(const RingShape& ring, const Vec3& center, double radius);
/// The distance from the inside of a round wall bends downwards by 1 / (distance from its middle),
/// that from its rim as from a ring. Both join smoothly where the rim begins.
GapBound gap_bound(const BowlShape& bowl, const Vec3& center, double radius);
/// The same; the axis is the middle of the wall and of the ends. Opposite to the wall both edges
/// are as near, and only the way itself bounds what the gap may lose.
GapBound gap_bound(const PipeShape& pipe, const Vec3& center, double radius);

}  // namespace carom
