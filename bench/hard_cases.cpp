// The hard cases (docs/accuracy.md) for every engine: error beside cost, and who fails how.
//   hard_cases [--quick] [--case ID]... [--engine WORD]... [--limit SECONDS] [--out DIR] [-v]
// --quick runs the shorter ones with fewer engines, and fails unless `exact`
// keeps every limit of error. --out writes hard_cases.csv, hard_cases.md, hard_cases_failures.md
// and hard_cases.svg.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "command_line.h"
#include "hard_cases_report.h"

namespace {

using namespace carom;
using namespace carom::bench;

struct Options {
    bool quick = false, verbose = false;
    std::vector<std::string> cases, engines;
    double cpu_limit_s = 10;
    std::string out;
};

bool wanted(const std::vector<std::string>& words, const std::string& name, bool whole) {
    return words.empty() || std::any_of(words.begin(), words.end(), [&](const std::string& w) {
               return whole ? name == w : name.find(w) != std::string::npos;
           });
}

/// --quick: `exact`, and the coarser of the steps, enough to show that the measures see errors.
bool is_quick(const Engine& engine) {
    return engine.family == "exact" || (engine.family != "ODE quick" && engine.step >= 1e-3);
}

Row run_row(const Case& one, const std::vector<Engine>& engines, const Options& options) {
    Row row{&one, {}};
    for (const Engine& engine : engines) {
        Cell cell;
        // What the stepped engines do in --quick only has to be wrong, not finished.
        const double limit = options.quick && engine.step > 0 ? 0.5 : options.cpu_limit_s;
        for (const Run& run : one.runs) {
            if (options.quick && !run.quick) continue;
            cell.runs.push_back(run_case(one, run, engine, limit, !options.quick));
            const Outcome& o = cell.runs.back();
            if (options.verbose)
                fmt::print("    {:<18} {:<9.2e} {}{}{}\n", engine.name, o.error, o.what,
                           o.how.empty() ? "" : "; ", o.how);
        }
        if (cell.runs.empty()) return {&one, {}};
        fmt::print("{:<4} {:<42} {:<18} {:>9} {} {:9.1e} s/s  {}\n", one.id, one.title, engine.name,
                   cell.error_text(), cell.holds() ? "ok" : "  ", cell.cost(), cell.failure());
        std::fflush(stdout);
        row.cells.push_back(std::move(cell));
    }
    return row;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// What --quick is for: `exact` keeps its limits, and the measures see the errors of large steps.
int verdict(const std::vector<Row>& rows, const std::vector<Engine>& engines) {
    int held = 0, failed = 0, seen = 0;
    for (const Row& row : rows)
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            if (engines[i].family == "exact") {
                ++(row.cells[i].holds() ? held : failed);
                if (!row.cells[i].holds())
                    fmt::print("exact misses {} ({}): {}\n", row.one->id, row.one->title,
                               row.cells[i].worst().what);
            } else {
                seen += !row.cells[i].holds();
            }
        }
    fmt::print("exact keeps {} of {} cases; the others miss a limit {} times\n", held,
               held + failed, seen);
    return failed == 0 && held > 0 && (seen > 0 || engines.size() == 1) ? 0 : 1;
}

int run(const Options& options) {
    std::vector<Engine> engines;
    for (Engine& engine : all_engines())
        if (wanted(options.engines, engine.name, false) && (!options.quick || is_quick(engine)))
            engines.push_back(std::move(engine));
    fmt::print("{}\n", engine_versions());
    const std::vector<Case> cases = all_cases();
    std::vector<Row> rows;
    for (const Case& one : cases) {
        if (!wanted(options.cases, one.id, true)) continue;
        Row row = run_row(one, engines, options);
        if (!row.cells.empty()) rows.push_back(std::move(row));
    }
    if (!options.out.empty()) {
        const std::filesystem::path folder = options.out;
        std::filesystem::create_directories(folder);
        write_text(folder / "hard_cases.csv", csv(rows, engines));
        write_text(folder / "hard_cases.md", markdown_table(rows, engines));
        write_text(folder / "hard_cases_failures.md", markdown_failures(rows, engines));
        write_error_plot(rows, engines, folder / "hard_cases.svg");
    }
    const int missed = verdict(rows, engines);
    return options.quick ? missed : 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App line({}, "hard_cases");
    line.add_flag("--quick", options.quick, "a few cases, whose errors must hold");
    line.add_flag("-v", options.verbose, "say more");
    line.add_option("--case", options.cases, "a part of a case's name (repeatable)")
        ->allow_extra_args(false);
    line.add_option("--engine", options.engines, "a part of an engine's name (repeatable)")
        ->allow_extra_args(false);
    line.add_option("--limit", options.cpu_limit_s, "CPU seconds of a run");
    line.add_option("--out", options.out, "folder for tables and plots");
    return run_line(line, argc, argv, [&] { return run(options); });
}
