// From a Scene to its Motion.
#pragma once

#include <stop_token>

#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// Runs the scene's method. Throws Failure(kRun) when the solver fails, a state is not finite
/// (naming ball and time), or `stop` was requested.
SimulationResult simulate(const Scene& scene, const std::stop_token& stop = {},
                          const SimulationProgress& progress = {});

}  // namespace carom
