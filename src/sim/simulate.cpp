#include "sim/simulate.h"

#include "core/failure.h"
#include "sim/fixed.h"

namespace carom {

SimulationResult simulate(const Scene& scene, std::stop_token stop,
                          const SimulationProgress& progress) {
    switch (scene.simulation.method) {
        case Method::kFixed:
            return simulate_fixed(scene, stop, progress);
        case Method::kExact:
            break;
    }
    throw Failure(FailureKind::kRun,
                  "method exact is not available in this version: use simulation.method: fixed");
}

}  // namespace carom
