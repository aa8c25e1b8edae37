// A simulation that shows how far it is.
#pragma once

#include "cli/progress.h"
#include "sim/simulate.h"

namespace carom {

class Interrupt;

/// simulate(), with progress in seconds of the motion: "12.3/1000 s simulated".
SimulationResult simulate_shown(const Scene& scene, const Interrupt& interrupt, ProgressMode mode,
                                const ProgressWork& work = kSimulating);

}  // namespace carom
