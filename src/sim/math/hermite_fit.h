// The polynomial of a piece through the solution of a differential equation.
#pragma once

#include "motion/curve.h"

namespace carom {

/// A vector function and its first two derivatives at one place.
struct CurveNode {
    Vec3 value, rate, second;
};

/// The terms that take a parabola with the values of `begin` through `middle` and `end` too, at the
/// seconds h/2 and h: Hermite's interpolation at u = 0, 1/2, 1 with two derivatives, solved for the
/// powers 3 ... 8.
Curve::Terms curve_through(const CurveNode& begin, const CurveNode& middle, const CurveNode& end,
                           double h);

}  // namespace carom
