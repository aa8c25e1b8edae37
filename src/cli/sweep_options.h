// What `carom sweep` was asked for.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options.h"

namespace carom {

/// Of a batch system's jobs.
struct SlurmOptions {
    bool submit = false;         ///< --slurm
    bool print = false;          ///< --print: say what would be submitted
    std::int64_t tasks = 0;      ///< 0: as many as there are runs, at most kMostTasks
    std::int64_t max_array = 0;  ///< 0: what Slurm says, or its default
    std::string partition, time, account;
};

struct SweepOptions {
    std::string file;
    std::string dir;
    int jobs = 0;  ///< 0: one per processor; of a task of Slurm: one
    std::string slice;
    bool index = false;
    bool dry_run = false;
    bool fail_fast = false;
    SlurmOptions slurm;
    CommonOptions common;
};

}  // namespace carom
