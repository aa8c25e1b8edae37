// What the benches compare: each engine is a function from a scene to its motion, so that all are
// judged by the same measures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sim/simulate.h"

namespace carom::bench {

struct Engine {
    std::string name;    ///< "exact", "ODE world 1 ms"
    std::string family;  ///< without the step: one colour of a plot
    double step = 0;     ///< s; 0 where there is none
    std::function<SimulationResult(const Scene&, const SimulationProgress&)> simulate;
};

/// carom's `exact`; plain ODE, which is carom's method `fixed`, with dWorldStep and with
/// dWorldQuickStep (20 iterations); Bullet, if the build has it.
std::vector<Engine> all_engines();

/// The engines' versions and precisions, one line.
std::string engine_versions();

}  // namespace carom::bench
