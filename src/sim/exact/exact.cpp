#include "sim/exact/exact.h"

#include "sim/exact/run.h"

namespace carom {

SimulationResult simulate_exact(const Scene& scene, const std::stop_token& stop,
                                const SimulationProgress& progress, const ExactOptions& options) {
    const Simulation& s = scene.simulation;
    ExactRun run(scene, s.duration.value_or(s.max_duration), options);
    run.run(stop, progress, !s.duration);
    return run.finish();
}

}  // namespace carom
