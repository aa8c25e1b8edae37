// A ball that bounces about inside of something.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "curved_scenes.h"

namespace carom::testing {

/// What happens within 5 s without loss: how far the energy strays [m^2/s^2], and the most of `out`
/// of the centre [m].
struct Wandering {
    double drift = 0, farthest = 0;
};
template <class Out>
Wandering wandering(Scene& scene, const Out& out) {
    const SimulationResult r = run(scene, 5);
    EXPECT_GT(impacts_of(r.motion).size(), 10u);
    const Trajectory& ball = r.motion.balls[0];
    Wandering worst;
    for (int i = 0; i <= 500; ++i) {
        const BallState s = ball.at(0.01 * i);
        worst.drift = std::max(worst.drift, std::abs(energy(scene, s) - energy(scene, ball.at(0))));
        worst.farthest = std::max(worst.farthest, out(s.position));
    }
    return worst;
}

}  // namespace carom::testing
