// Where a piece of a curved contact ends because its laws do.
#pragma once

#include <limits>

#include "sim/integrate/single_motion.h"
#include "sim/integrate/single_ode.h"

namespace carom {

/// The first place in (0, h] where a gate turns negative.
struct Crossing {
    double seconds = std::numeric_limits<double>::infinity();
    CurvedEnd end = CurvedEnd::kNone;
};

/// Looks at a fitted piece, and finds the place itself on the course, to rounding. `settled` as in
/// next_piece().
Crossing first_crossing(const Course& course, const Piece& piece, bool settled);

}  // namespace carom
