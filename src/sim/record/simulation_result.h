// A motion and how it came about.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "motion/motion.h"

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
    std::int64_t given_up = 0;        ///< contacts that were stepped because nothing else got on
    std::int64_t without_spring = 0;  ///< impacts in piles that leave tangential restitution out
    std::int64_t collapses = 0;       ///< impacts on heaps that nothing presses together
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

}  // namespace carom
