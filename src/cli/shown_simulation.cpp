#include "cli/shown_simulation.h"

#include "cli/interrupt.h"

namespace carom {

SimulationResult simulate_shown(const Scene& scene, const Interrupt& interrupt, ProgressMode mode,
                                const std::string& what) {
    Progress progress(mode, interrupt, what, scene.simulation.duration);
    return simulate(scene, interrupt.token(), [&](double time) { progress.update(time); });
}

}  // namespace carom
