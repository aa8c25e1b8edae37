// A sweep as jobs of Slurm.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/sweep_options.h"

namespace carom {

/// Job arrays whose tasks are slices of the runs, and a job behind them that writes the index. With
/// --print, scripts and commands go to standard output and nothing else happens. Failure(kRun)
/// where Slurm's sbatch is missing or refuses.
void submit_to_slurm(const SweepOptions& options, std::int64_t runs);

}  // namespace carom
