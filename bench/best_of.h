// The cheapest of a few runs.
#pragma once

#include <utility>

#include "clock.h"
#include "sim/simulate.h"

namespace carom::bench {

struct Measured {
    double seconds = 1e300;  ///< CPU
    SimulationResult result;
};

inline Measured best_of(const Scene& scene, int runs) {
    Measured best;
    for (int i = 0; i < runs; ++i) {
        const double start = cpu_seconds();
        SimulationResult result = simulate(scene);
        const double seconds = cpu_seconds() - start;
        if (seconds < best.seconds) best = {seconds, std::move(result)};
    }
    return best;
}

}  // namespace carom::bench
