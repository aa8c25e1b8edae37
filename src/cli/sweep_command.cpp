// carom sweep: many scenes from one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/slurm.h"
#include "cli/standard_error.h"
#include "cli/sweep_estimate.h"
#include "cli/sweep_options.h"
#include "cli/sweep_run.h"
#include "core/failure.h"
#include "sweep/file/plan.h"
#include "sweep/file/sweep_file.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// A table that no sweep has written would be lost.
void require_own_folder(const std::string& dir) {
    const fs::path folder = dir;
    if (!fs::exists(folder / "index.csv") || fs::exists(folder / "dataset.json")) return;
    throw Failure(
        FailureKind::kOutput,
        fmt::format("'{}' has an index.csv that no sweep has written: name another folder", dir));
}

/// What is asked for beside what it has no meaning with.
void require_sense(const SweepOptions& options) {
    const SlurmOptions& slurm = options.slurm;
    const bool to_slurm = slurm.submit || slurm.print;
    const auto refuse = [](bool wrong, const char* message) {
        if (wrong) throw Failure(FailureKind::kInput, message);
    };
    const char* of_slurm = slurm.tasks > 0            ? "--tasks"
                           : slurm.max_array > 0      ? "--max-array"
                           : !slurm.partition.empty() ? "--partition"
                           : !slurm.time.empty()      ? "--time"
                           : !slurm.account.empty()   ? "--account"
                                                      : nullptr;
    if (of_slurm != nullptr && !to_slurm)
        throw Failure(FailureKind::kInput, fmt::format("{} is for --slurm or --print", of_slurm));
    refuse(to_slurm && (!options.slice.empty() || options.index),
           "--slurm makes slices and the index itself: leave out --slice and --index");
    refuse(to_slurm && options.dry_run,
           "--dry-run makes runs here: leave out --slurm; --print shows what it would submit");
    refuse(options.index && options.dry_run,
           "--index makes no run whose cost --dry-run could say: leave out one of them");
}

int sweep_command(const SweepOptions& options, const Interrupt& interrupt) {
    require_sense(options);
    if (options.file == "-")
        throw Failure(FailureKind::kInput,
                      "SWEEP.yaml -: a sweep is a file, beside which its base is looked for");
    SweepResult read = read_sweep_file(options.file, options.common.overrides());
    for (const Diagnostic& d : read.diagnostics.items())
        if (!options.common.quiet || d.severity == Severity::kError)
            write_standard_error(d.shown());
    if (!read.sweep) return kExitInvalidScene;
    const Sweep& sweep = *read.sweep;
    const Plan plan(sweep);
    if (options.dry_run) {
        estimate_sweep(options, interrupt, sweep, plan);
        return kExitDone;
    }
    require_own_folder(options.dir);
    if (options.slurm.submit || options.slurm.print) {
        submit_to_slurm(options, plan.count());
        return kExitDone;
    }
    if (options.index) return index_sweep(options, sweep, plan);
    return run_sweep(options, interrupt, sweep, plan);
}

void add_run_options(CLI::App& command, SweepOptions& options) {
    command.add_option("sweep", options.file, "The sweep's file")
        ->required()
        ->type_name("SWEEP.yaml");
    command
        .add_option("-o,--output", options.dir,
                    "Folder of the runs, index.csv and dataset.json; what is there already and as "
                    "it should be is kept")
        ->required()
        ->type_name("DIR");
    command
        .add_option("--jobs", options.jobs,
                    "Runs at once (default: one per processor, fewer where memory is short; with "
                    "--slurm 1 a task)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
    command.add_flag("--fail-fast", options.fail_fast, "Begin no run after one that failed");
    command.add_flag("--dry-run", options.dry_run,
                     "List the runs, and say what they take by making a few in a temporary folder");
    auto* slice = command
                      .add_option("--slice", options.slice,
                                  "Make part I of N equal ones of the runs, without index.csv; "
                                  "auto in an array of Slurm, Grid Engine or AWS Batch (default: "
                                  "all)")
                      ->type_name("I/N");
    command
        .add_flag("--index", options.index,
                  "Make no run: write index.csv and dataset.json of what is there")
        ->excludes(slice);
}

void add_slurm_options(CLI::App& command, SlurmOptions& options) {
    command.add_flag(
        "--slurm", options.submit,
        "Submit the runs to Slurm as job arrays, and a last job that writes index.csv");
    command.add_flag("--print", options.print,
                     "Show the scripts and commands of --slurm, submit and write nothing");
    command
        .add_option("--tasks", options.tasks,
                    "With --slurm: in how many tasks, each a slice of the runs (default: 100, or "
                    "as many as there are runs)")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{10'000'000}))
        ->type_name("N");
    command
        .add_option("--max-array", options.max_array,
                    "With --slurm: tasks of one array (default: Slurm's MaxArraySize)")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{10'000'000}))
        ->type_name("N");
    command
        .add_option("--partition", options.partition,
                    "With --slurm: the partition (default: Slurm's)")
        ->type_name("NAME");
    command
        .add_option("--time", options.time,
                    "With --slurm: the time limit of a task, as sbatch takes it (default: Slurm's)")
        ->type_name("TIME");
    command
        .add_option("--account", options.account, "With --slurm: the account (default: Slurm's)")
        ->type_name("NAME");
}

}  // namespace

void add_sweep_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("sweep", "Make many scenes from one: grids, ranges, draws");
    auto options = std::make_shared<SweepOptions>();
    command->footer(
        "  carom sweep sweep.yaml -o out/sweep\n"
        "  carom sweep sweep.yaml -o out/sweep --dry-run\n"
        "  carom sweep sweep.yaml -o out/sweep --slurm --tasks 200 --time 1:00:00\n"
        "  seq 8 | parallel carom sweep sweep.yaml -o out/sweep -q --jobs 1 --slice {}/8\n"
        "  carom sweep sweep.yaml -o out/sweep --index\n");
    add_run_options(*command, *options);
    add_slurm_options(*command, options->slurm);
    add_scene_options(*command, options->common);
    add_progress_options(*command, options->common);
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return sweep_command(*options, interrupt); };
    });
}

}  // namespace carom
