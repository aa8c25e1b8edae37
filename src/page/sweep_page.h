// The page of `carom report` for a sweep's folder: results over what differs, numbers, pictures.
#pragma once

#include <string>

#include "sweep/runs/run_table.h"

namespace carom {

/// The whole page; the same table gives equal bytes. Of many runs the first kMostRows have a row,
/// and plots as in scatter_plot.h. Pictures are those that the runs have (`outputs.stills`), of
/// some runs. `version` is carom's.
std::string sweep_page(const RunTable& table, const std::string& version);
inline constexpr std::size_t kMostRows = 5000;

}  // namespace carom
