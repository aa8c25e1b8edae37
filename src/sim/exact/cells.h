// When a ball leaves its cell of the grid, and where it comes to.
#pragma once

#include <cstdint>

#include "sim/world/exact_world.h"

namespace carom {

/// When a ball leaves its cell [s], on its piece from `now` on; infinite if not before `until`.
double leaves_cell(const ExactWorld& world, int ball, double now, double until);

/// How a ball has changed its cell.
struct CellChange {
    int axes = 0;  ///< along so many, the last of them `axis`
    int axis = 0;
    std::int64_t side = 0;  ///< cells along that one
};
/// The ball is moved to the cell that it is in now. Only where there is a grid.
CellChange enter_cell(ExactWorld& world, int ball, double now);

}  // namespace carom
