// Tables and charts of bench/simbenchmark.
#pragma once

#include <string>
#include <vector>

#include "simbenchmark_runs.h"

namespace carom::bench {

/// simbenchmark.csv, simbenchmark.md, simbenchmark_targets.md and one SVG per task, into `folder`.
void write_simbenchmark(const std::vector<Point>& points, const std::string& folder);

/// What `exact` must reach on each task beside plain ODE (dWorldStep), as a Markdown table.
std::string targets_text(const std::vector<Point>& points);

}  // namespace carom::bench
