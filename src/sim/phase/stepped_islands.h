// Islands that ODE steps.
#pragma once

#include <optional>
#include <vector>

#include "sim/phase/island_links.h"
#include "sim/solve/island_solver.h"

namespace carom {

class SteppedIslands {
  public:
    SteppedIslands(ExactWorld& world, Links& links, RunLog& log, IslandLinks& island_links)
        : world_(world), links_(links), log_(log), island_links_(island_links) {}

    /// One step of an island. Where it has rested for long enough to fall asleep: below which
    /// speed [m/s].
    std::optional<double> step(const std::vector<int>& balls, double now);

  private:
    double step_speed(const std::vector<int>& balls) const;

    ExactWorld& world_;
    Links& links_;
    RunLog& log_;
    IslandLinks& island_links_;
    IslandSolver solver_;
};

}  // namespace carom
