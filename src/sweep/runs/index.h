// The table of a sweep's runs, and what the data set as a whole is.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sweep/file/plan.h"
#include "sweep/file/sweep_file.h"
#include "sweep/runs/run_record.h"

namespace carom {

struct IndexCounts {
    std::int64_t done = 0, failed = 0, missing = 0;  ///< invalid ones count as failed
    std::vector<RunRecord> first_failed;             ///< some of them, in order
};

/// How the runs first ... last - 1 ended, from their records. One of other values counts as
/// missing.
IndexCounts count_runs(const Sweep& sweep, const Plan& plan, const std::string& dir,
                       std::int64_t first, std::int64_t last);

/// Writes index.csv and dataset.json from the records of all runs, each only where its text is
/// another. A record of other values counts as missing. `versions` are those of the libraries.
IndexCounts write_index(const Sweep& sweep, const Plan& plan, const std::string& dir,
                        const std::map<std::string, std::string>& versions);

}  // namespace carom
