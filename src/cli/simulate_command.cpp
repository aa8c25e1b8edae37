// carom simulate: numbers only, no picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/cpu_timer.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/shown_simulation.h"
#include "cli/standard_output.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "media/text_file.h"
#include "motion/csv.h"

namespace carom {

namespace {

struct SimulateOptions {
    std::string scene;
    std::string output;
    std::string events;
    std::string rate;
    CommonOptions common;
};

/// Runs `write` into a file that appears when whole, or into standard output for "-".
void write_csv(const std::string& path, const Interrupt& interrupt,
               const std::function<void(const TextSink&)>& write) {
    if (path == "-") {
        write([&](std::string_view text) {
            interrupt.check();
            write_standard_output(text);
        });
        return;
    }
    TextFile file(path);
    write([&](std::string_view text) {
        interrupt.check();
        file.write(text);
    });
    file.commit();
}

/// The motion and, where they are wanted, the events.
void write_results(const SimulateOptions& options, const Scene& scene, const Motion& motion,
                   const Interrupt& interrupt) {
    write_csv(options.output, interrupt, [&](const TextSink& sink) {
        Progress progress(options.common.progress_mode(), interrupt, "s written",
                          std::optional(motion.duration));
        write_motion_csv(motion, scene.film.fps.numerator, scene.film.fps.denominator, sink,
                         [&](double time) { progress.update(time); });
    });
    if (options.events.empty()) return;
    write_csv(options.events, interrupt,
              [&](const TextSink& sink) { write_events_csv(motion, sink); });
}

/// `--rate` goes through the film's frame rate, so that both understand the same numbers.
CommonOptions with_rate(const SimulateOptions& options) {
    CommonOptions common = options.common;
    if (!options.rate.empty()) common.fps = options.rate;
    return common;
}

int simulate_to_files(const SimulateOptions& options, const Interrupt& interrupt) {
    Stats stats;
    if (options.output == "-" && options.events == "-")
        throw Failure(FailureKind::kInput, "only one of -o and --events can be standard output");
    for (const std::string& path : {options.output, options.events, options.common.stats_path})
        if (!path.empty() && path != "-") require_writable(path, options.common.overwrite);

    std::optional<Scene> scene;
    {
        const CpuTimer timer(stats.scene_cpu_s);
        scene = load_scene(options.scene, with_rate(options));
    }
    if (!scene) return kExitInvalidScene;
    SimulationResult simulated;
    {
        const CpuTimer timer(stats.sim_cpu_s);
        simulated = simulate_shown(*scene, interrupt, options.common.progress_mode());
    }
    stats.add_verdict(*scene, simulated.motion, options.common.quiet);
    Stats::warn_of_unrest(simulated.report, options.common.quiet);

    {
        const CpuTimer timer(stats.sinks.write_cpu_s);
        write_results(options, *scene, simulated.motion, interrupt);
    }
    if (!options.common.stats_path.empty())
        write_text_file(options.common.stats_path, stats_json(stats, &simulated));
    return kExitDone;
}

}  // namespace

void add_simulate_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("simulate", "Write motion and events as CSV, no picture");
    auto options = std::make_shared<SimulateOptions>();
    command->add_option("scene", options->scene, "Scene file, - for standard input")
        ->required()
        ->type_name("SCENE");
    command->add_option("-o,--output", options->output, "Motion, or - for standard output")
        ->required()
        ->type_name("MOTION.csv");
    command->add_option("--events", options->events, "Impacts and contacts")
        ->type_name("EVENTS.csv");
    command->add_option("--rate", options->rate, "Rows per second (default: film.fps)")
        ->type_name("HZ");
    add_scene_options(*command, options->common);
    add_output_options(*command, options->common);
    add_progress_options(*command, options->common);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return simulate_to_files(*options, interrupt); };
    });
}

}  // namespace carom
