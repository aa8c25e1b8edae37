// What a sweep would do, and what that takes, from a few of its runs.
#pragma once

#include "cli/interrupt.h"
#include "cli/sweep_options.h"
#include "sweep/file/plan.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// Lists the runs on standard output, makes a few of them in a temporary folder, and says what all
/// of them would take.
void estimate_sweep(const SweepOptions& options, const Interrupt& interrupt, const Sweep& sweep,
                    const Plan& plan);

}  // namespace carom
