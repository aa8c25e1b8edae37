// Times of impact of balls of which one at least is on a curved piece (motion/curve.h). All gaps
// are polynomials of degree up to 16 then; Bernstein's form isolates their roots, so that none is
// lost. Round rims are the exception (conservative_advancement.h).
#pragma once

#include <array>

#include "motion/motion.h"
#include "sim/collide/time_of_impact.h"

namespace carom {

/// A centre over some seconds: the sum of c[i] u^i, u = s / seconds in [0, 1].
struct HighDegreePath {
    std::array<Vec3, 9> c;
    double seconds = 0;
    /// Nothing holds the ball: what it touches without speed or pull it may come to press on later.
    bool flies = false;

    HighDegreePath() { c.fill(Vec3::Zero()); }
    Vec3 at(double u) const;
    HighDegreePath relative_to(const HighDegreePath& other) const;  ///< of the same seconds
    /// No place is farther than this from the first one, m.
    double reach() const;
};

/// The part of a piece from `from` on [s].
HighDegreePath high_degree_path(const Piece& piece, double from, double seconds);

/// As impact_with_sphere() and impact_with_surface(): the horizon is the path's length.
TimeOfImpact impact_with_sphere(const HighDegreePath& path, double distance, bool touching);
TimeOfImpact impact_with_surface(const HighDegreePath& ball, double radius,
                                 const SurfaceShape& shape, bool touching);

/// Seconds until direction . x falls below `offset`; at most the path's length.
double seconds_above(const HighDegreePath& path, const Vec3& direction, double offset);

}  // namespace carom
