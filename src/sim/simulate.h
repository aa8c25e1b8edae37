// From a Scene to its Motion.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sim/exact/exact.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// Runs the scene's method. Throws Failure(kRun) when the solver fails, a state is not finite
/// (naming ball and time), or `stop` was requested.
SimulationResult simulate(const Scene& scene, const std::stop_token& stop = {},
                          const SimulationProgress& progress = {});

/// Why the motion of this scene is known at its end only; "" where its pieces come to be in order
/// of time and stay as they are.
std::string why_known_at_end(const Scene& scene);

/// Simulates such a scene and hands its pieces and events to `tap`, the last ones with a `now` of
/// infinity. Fails as simulate() does. The result lacks both, and what follows from them:
/// complete() puts all that in.
SimulationResult simulate_piecewise(const Scene& scene, const std::stop_token& stop,
                                    const PieceTap& tap);
/// `balls` are the trajectories that the pieces make. Afterwards the result is simulate()'s.
void complete(const Scene& scene, std::vector<Trajectory> balls, std::vector<Event> events,
              SimulationResult& result);

}  // namespace carom
