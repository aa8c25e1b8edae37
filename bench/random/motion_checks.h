// Invariants of a motion, read off its trajectories at the begin and end of every piece and at
// instants between.
#pragma once

#include <string>
#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom::bench {

/// A measured value and when it was found.
struct Worst {
    double value = 0;
    double time = 0;  ///< s
    void take(double v, double t) {
        if (!(v <= value)) *this = {v, t};
    }
};

/// A thousand instants a second, and the starts of all pieces (of many, evenly chosen ones).
std::vector<double> check_times(const Motion& motion);

/// How far kinetic and potential energy rise above their running minimum, relative to the energy
/// that has been in play until then: kinetic, and gravity times the way along it (at least each
/// ball's radius). Both sides of each instant are looked at.
Worst energy_rise(const Scene& scene, const Motion& motion, const std::vector<double>& times);

/// The deepest overlap of a ball with a surface or another ball, m.
Worst deepest(const Scene& scene, const Motion& motion, const std::vector<double>& times);

/// Of a scene without surfaces: how far the momentum is from the start's and what gravity adds,
/// relative to the sum of all |m v| so far.
Worst momentum_error(const Scene& scene, const Motion& motion, const std::vector<double>& times);

/// The rows of events around t, and what the balls' pieces there are, for people.
std::string what_happens_at(const Motion& motion, double t);

}  // namespace carom::bench
