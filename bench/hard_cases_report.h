// The table, the list of failures and the plot of bench/hard_cases.
#pragma once

#include <string>
#include <vector>

#include "case.h"
#include "engine.h"
#include "run_case.h"

namespace carom::bench {

/// One case by one engine: its worst run, and the cost of all.
struct Cell {
    std::vector<Outcome> runs;

    const Outcome& worst() const;
    bool holds() const;
    /// CPU seconds per simulated second; not a number where nothing was simulated.
    double cost() const;
    /// "3.1e-16", or a word for what went wrong: "refused", "cut", "LCP error".
    std::string error_text() const;
    /// What goes wrong, in words: "" if the limits hold or the motion is merely inexact.
    std::string failure() const;
};

struct Row {
    const Case* one = nullptr;
    std::vector<Cell> cells;  ///< one per engine
};

/// Errors and costs of all engines, one row per case; an error within its limit is bold.
std::string markdown_table(const std::vector<Row>& rows, const std::vector<Engine>& engines);
/// How they fail, one item per case.
std::string markdown_failures(const std::vector<Row>& rows, const std::vector<Engine>& engines);
/// One line per run.
std::string csv(const std::vector<Row>& rows, const std::vector<Engine>& engines);
/// Error against cost of all cases, one series per family, into `path` (.svg or .png).
void write_error_plot(const std::vector<Row>& rows, const std::vector<Engine>& engines,
                      const std::string& path);

}  // namespace carom::bench
