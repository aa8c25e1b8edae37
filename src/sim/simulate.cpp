#include "sim/simulate.h"

#include "sim/exact.h"
#include "sim/fixed.h"

namespace carom {

SimulationResult simulate(const Scene& scene, const std::stop_token& stop,
                          const SimulationProgress& progress) {
    switch (scene.simulation.method) {
        case Method::kFixed:
            return simulate_fixed(scene, stop, progress);
        case Method::kExact:
            return simulate_exact(scene, stop, progress);
    }
    return {};
}

}  // namespace carom
