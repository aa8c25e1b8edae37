// The runs of a sweep that are missing or changed, all or a slice of them.
#pragma once

#include <cstdint>

#include "cli/interrupt.h"
#include "cli/sweep_options.h"
#include "sweep/file/plan.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// Runs first ... last - 1.
struct SweepSlice {
    std::int64_t first = 0, last = 0;
};

/// Of "I/N" or "auto" out of `count` runs, as chunks of films are; all for "".
SweepSlice sweep_slice(const std::string& text, std::int64_t count);

/// Makes what is missing or changed; returns the exit code.
int run_sweep(const SweepOptions& options, const Interrupt& interrupt, const Sweep& sweep,
              const Plan& plan);

/// Writes index.csv and dataset.json from what is there; says what failed or is missing. The exit
/// code: 1 if any.
int index_sweep(const SweepOptions& options, const Sweep& sweep, const Plan& plan);

/// How many runs at once: --jobs, or one per processor as far as the memory goes.
int sweep_jobs(const SweepOptions& options, const Sweep& sweep, const Plan& plan);

}  // namespace carom
