// The files of `carom accuracy`: table, numbers, work-precision plots.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "report/accuracy.h"
#include "report/plot.h"
#include "report/text_table.h"

namespace carom {

/// accuracy.csv, accuracy.json, accuracy.svg, accuracy.png, and the same plot of the peaks.
std::vector<std::string> accuracy_file_names();

/// One row per method and step; what was not measured is empty.
TextTable accuracy_table(const AccuracyReport& report);

std::string accuracy_json(const AccuracyReport& report);

/// Error down, cost across, both logarithmic; one line per method and solver. `error` picks the
/// measure. Empty where nothing has that error.
std::optional<Plot> work_precision_plot(const AccuracyReport& report, const std::string& measure,
                                        double (*error)(const MotionError&));

/// Writes the files into `folder`, which exists; peaks are left out where the scene has none.
/// Returns the names written.
std::vector<std::string> write_accuracy(const AccuracyReport& report, const std::string& folder,
                                        Existing existing = Existing::kReplace,
                                        const std::stop_token& stop = {});

}  // namespace carom
