// When a ball leaves its cell of the grid.
#pragma once

#include "sim/world/exact_world.h"

namespace carom {

/// Seconds from `now` [s] on, at most `horizon`. Only for a ball that is in a cell.
double seconds_in_cell(const ExactWorld& world, int ball, double now, double horizon);

}  // namespace carom
