// Times of impact with shapes whose gap is no polynomial of time: those with round rims. A ball's
// centre at the distance d from a circle would be a root of a polynomial of degree 8 on a parabola,
// 32 on a curved piece, squared twice over, so that grazes and far starts lose their digits.
// Instead the ball advances by steps in which a bound from below (geometry/gap_bound.h) proves that
// the gap does not close, up to where it is 0 to rounding (B. Mirtich, "Impulse-based Dynamic
// Simulation of Rigid Body Systems", PhD thesis, Berkeley 1996, section 2.3, with a bound of second
// order instead of first: near an impact the steps then converge quadratically, and pass a graze in
// a number that goes with the logarithm of its gap). The gap itself is looked at, never its square:
// times are right to the rounding of places, and no root is passed by.
#pragma once

#include "sim/collide/time_of_impact.h"
#include "sim/collide/time_of_impact_high_degree.h"

namespace carom {

/// As impact_with_surface(). A gap that dips below 0 by no more than its rounding is a miss. For
/// the shapes that gap_bound() knows.
template <class Shape>
TimeOfImpact advance_to_impact(const Path& ball, double radius, const Shape& shape, bool touching,
                               double horizon);
template <class Shape>
TimeOfImpact advance_to_impact(const HighDegreePath& ball, double radius, const Shape& shape,
                               bool touching);

}  // namespace carom
