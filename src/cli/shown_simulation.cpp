#include "cli/shown_simulation.h"

#include "cli/interrupt.h"

namespace carom {

SimulationResult simulate_shown(const Scene& scene, const Interrupt& interrupt, ProgressMode mode,
                                const ProgressWork& work) {
    Progress progress(mode, interrupt, work, scene.simulation.duration);
    SimulationResult result =
        simulate(scene, interrupt.token(), [&](double time) { progress.update(time); });
    progress.update(result.motion.duration);
    return result;
}

}  // namespace carom
