// Cheap answers about pairs that are far from meeting, so that the exact one (time_of_impact.h) is
// asked for only where it may matter. "No" says nothing.
#pragma once

#include <cmath>

#include "sim/collide/time_of_impact.h"

namespace carom {

/// Well above the roundings of what is computed here and in the exact answer.
inline constexpr double kSureMargin = 1e-9;

/// Whether the centre of a ball of `radius` [m] stays farther than that from a plane for so many
/// seconds, by more than roundings and `tolerance` [m].
inline bool surely_clear_of(const PlaneShape& plane, const Path& path, double radius,
                            double tolerance, double seconds) {
    const double height = plane.normal.dot(path.position) - plane.offset_m;
    const double rate = plane.normal.dot(path.velocity);
    const double half = 0.5 * plane.normal.dot(path.acceleration);
    const double margin = 2 * tolerance + kSureMargin * (radius + std::abs(plane.offset_m) +
                                                         path.position.cwiseAbs().sum());
    const double gap = height - radius - margin;
    if (!(gap > 0)) return false;
    // Where it falls, a gap that is open at both ends is so in between; where it rises, its lowest
    // point counts.
    if (half > 0) return rate >= 0 || rate * rate * (1 + kSureMargin) < 4 * half * gap;
    const double fall = seconds * (rate + seconds * half);
    return (rate >= 0 && half == 0) || gap + (1 + kSureMargin) * fall > 0;
}

/// Whether two balls that do not touch, on a straight relative path, `closing` = position .
/// velocity < 0, miss each other, or do not meet within so many seconds; `distance2` is the square
/// of the distance of the centres, `sum` that of the radii [m].
inline bool surely_apart(const Path& path, double distance2, double closing, double sum,
                         double seconds) {
    const double outside = distance2 - sum * sum - 1e-12 * distance2;
    if (!(outside > 0)) return false;
    const double speed2 = path.velocity.squaredNorm();
    const double rest = closing * closing * (1 + kSureMargin) - speed2 * outside;
    if (rest < 0) return true;
    return outside > (1 + kSureMargin) * seconds * (std::sqrt(rest) - closing);
}

}  // namespace carom
