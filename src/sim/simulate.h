// From a Scene to its Motion.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <stop_token>
#include <string>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// Whether a part of the model was needed for this scene, and why (or why not).
struct Effect {
    bool on = false;
    std::string why;
};

/// What the simulation did, for --stats.
struct SimulationReport {
    std::int64_t steps = 0;       ///< of ODE
    std::int64_t integrated = 0;  ///< pieces of balls that act on each other, by the method exact
    std::int64_t impacts = 0;
    std::int64_t given_up = 0;  ///< contacts that were stepped because nothing else got on
    std::map<std::string, Effect> effects;  ///< gravity, friction, spin, pairs, ...
    /// Of a motion until rest that ended at max_duration: what still moved. Else empty.
    std::string unrest;
};

struct SimulationResult {
    Motion motion;
    SimulationReport report;
};

/// Called now and then with the simulated time in seconds.
using SimulationProgress = std::function<void(double time)>;

/// Runs the scene's method. Throws Failure(kRun) when the solver fails, a state is not finite
/// (naming ball and time), or `stop` was requested.
SimulationResult simulate(const Scene& scene, const std::stop_token& stop = {},
                          const SimulationProgress& progress = {});

}  // namespace carom
