// carom simulate: numbers only, no picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/cpu_timer.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/motion_output.h"
#include "cli/options.h"
#include "cli/shown_simulation.h"
#include "cli/standard_output.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "motion/csv.h"
#include "report/growing_motion.h"
#include "scene/frame_rate.h"
#include "scene/scalar.h"

namespace carom {

namespace {

struct SimulateOptions {
    std::string scene;
    std::string output;
    std::string events;
    std::string rate;
    std::string format;  ///< of standard output
    CommonOptions common;
};

/// Shows how far the simulation is, and when it has ended, how far the rows are.
class RowProgress {
  public:
    RowProgress(const SimulateOptions& options, const Interrupt& interrupt, double duration)
        : options_(options), interrupt_(interrupt), duration_(duration) {
        begin(kSimulating);
    }
    /// `known_until` is the simulation's time, infinity at its end; `written` that of the rows.
    void update(double known_until, double written) {
        if (is_simulating_ && known_until < duration_) return progress_->update(known_until);
        if (is_simulating_) {
            progress_->update(duration_);
            is_simulating_ = false;
            begin(kWritingRows);
        }
        progress_->update(written);
    }

  private:
    void begin(const ProgressWork& work) {
        progress_.reset();
        progress_.emplace(options_.common.progress_mode(), interrupt_, work,
                          std::optional(duration_));
    }

    const SimulateOptions& options_;
    const Interrupt& interrupt_;
    double duration_;
    bool is_simulating_ = true;
    std::optional<Progress> progress_;
};

/// The rows of a motion as it is computed; what is written is let go.
SimulationReport write_as_computed(const SimulateOptions& options, const Scene& scene,
                                   const FrameRate& rate, const Interrupt& interrupt) {
    GrowingMotion motion(scene, GrowingMotion::Keep::kNeeded, interrupt.token());
    RowProgress progress(options, interrupt, motion.motion().duration);
    write_text_output(
        options.output, options.common.existing(), interrupt, [&](const TextSink& sink) {
            double written = 0;
            const auto show = [&] { progress.update(motion.known_until(), written); };
            const auto await = [&](double time) {
                motion.wait_for({time, time}, show);
                written = time;
                show();
            };
            write_motion_csv(motion.motion(), rate.numerator, rate.denominator, sink, {}, await);
        });
    return motion.finish().report;
}

/// True where nothing but the rows is asked for, and they can be written as they come to be.
bool needs_rows_alone(const SimulateOptions& options, const Scene& scene, MotionFormat format) {
    return format == MotionFormat::kCsv && options.events.empty() &&
           options.common.stats_path.empty() && !scene.test && scene.simulation.duration &&
           why_known_at_end(scene).empty();
}

/// The motion and, where they are wanted, the events.
void write_results(const SimulateOptions& options, const Scene& scene, const Motion& motion,
                   MotionFormat format, const FrameRate& rate, const Interrupt& interrupt) {
    const Existing existing = options.common.existing();
    {
        Progress progress(options.common.progress_mode(), interrupt, kWritingRows,
                          std::optional(motion.duration));
        if (format == MotionFormat::kCsv)
            write_text_output(options.output, existing, interrupt, [&](const TextSink& sink) {
                write_motion_csv(motion, rate.numerator, rate.denominator, sink,
                                 [&](double time) { progress.update(time); });
            });
        else
            write_motion(format, scene, motion, options.output, existing, interrupt, rate,
                         [&](double part) { progress.update(part * motion.duration); });
    }
    if (options.events.empty()) return;
    write_text_output(options.events, existing, interrupt,
                      [&](const TextSink& sink) { write_events_csv(motion, sink); });
}

/// Rows per second: --rate, or the film's frame rate.
FrameRate row_rate(const SimulateOptions& options, const Scene& scene) {
    constexpr double kMostRows = 1e7;  // per second: a tenth of a microsecond
    if (options.rate.empty()) return scene.film.fps;
    const std::optional<FrameRate> rate = parse_rate(options.rate, kMostRows);
    if (!rate)
        throw Failure(FailureKind::kInput,
                      fmt::format("--rate {}: rows per second are a number above 0 and at most {}, "
                                  "such as 1000 or 30000/1001",
                                  options.rate, number_text(kMostRows)));
    return *rate;
}

/// Refuses a file that nobody can mean, before anything is simulated.
void require_writable_rows(const Scene& scene, const FrameRate& rate, double duration) {
    constexpr double kMostRows = 1e9;      // some 150 GB
    constexpr double kBytesInRow = 150.0;  // with 15 numbers, most of 17 digits
    const double rows = duration * rate.per_second() * static_cast<double>(scene.balls.size());
    if (rows <= kMostRows) return;
    throw Failure(
        FailureKind::kInput,
        fmt::format("the motion would have {:.4g} rows ({} balls, {:.6g} times a second, "
                    "{:.6g} s), about {:.4g} GB; at most {:.0e} are written: lower --rate "
                    "or shorten simulation.duration",
                    rows, scene.balls.size(), rate.per_second(), duration, rows * kBytesInRow / 1e9,
                    kMostRows));
}

int simulate_to_files(const SimulateOptions& options, const Interrupt& interrupt) {
    Stats stats;
    const MotionFormat format = motion_format(options.output, options.format);
    if (!options.rate.empty() && !has_rows(format))
        throw Failure(
            FailureKind::kInput,
            fmt::format("--rate {}: .json and .glb hold the motion itself, not rows of it; "
                        ".csv and .npz take a rate",
                        options.rate));
    require_distinct({{"-o", options.output},
                      {"--events", options.events},
                      {"--stats", options.common.stats_path}},
                     {{"SCENE", options.scene}});
    for (const std::string& path : {options.output, options.events, options.common.stats_path})
        if (!path.empty() && path != "-") require_writable(path, options.common.overwrite);

    std::optional<Scene> scene;
    {
        const CpuTimer timer(stats.scene_cpu_s);
        scene = load_scene(options.scene, options.common);
    }
    if (!scene) return kExitInvalidScene;
    const FrameRate rate = row_rate(options, *scene);
    if (has_rows(format))
        require_writable_rows(*scene, rate, scene->simulation.duration.value_or(0));
    if (needs_rows_alone(options, *scene, format)) {
        stats.add_warnings(write_as_computed(options, *scene, rate, interrupt),
                           options.common.quiet);
        return kExitDone;
    }
    SimulationResult simulated;
    {
        const CpuTimer timer(stats.sim_cpu_s);
        simulated = simulate_shown(*scene, interrupt, options.common.progress_mode());
    }
    stats.add_warnings(simulated.report, options.common.quiet);
    stats.add_verdict(*scene, simulated.motion, options.common.quiet);
    Stats::warn_of_unrest(simulated.report, options.common.quiet);

    if (has_rows(format)) require_writable_rows(*scene, rate, simulated.motion.duration);
    {
        const CpuTimer timer(stats.sinks.write_cpu_s);
        write_results(options, *scene, simulated.motion, format, rate, interrupt);
    }
    if (!options.common.stats_path.empty())
        write_stats(options.common, stats_json(stats, &simulated));
    return kExitDone;
}

}  // namespace

void add_simulate_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand(
        "simulate", "Write motion and events as CSV, JSON, NumPy's arrays or glTF, no picture");
    auto options = std::make_shared<SimulateOptions>();
    command->footer(
        "  carom simulate scene.yaml -o motion.csv --events events.csv\n"
        "  carom simulate scene.yaml -o - --rate 1000 | head\n"
        "  carom simulate scene.yaml -o motion.glb\n");
    add_scene_argument(*command, options->scene);
    command
        ->add_option(
            "-o,--output", options->output,
            "File of the motion, - for standard output: .npz holds states and events, .json "
            "pieces and events, .glb bodies and their motion; any other name is CSV")
        ->required()
        ->type_name("MOTION.csv");
    command->add_option("--format", options->format, "Format of -o - (default: csv)")
        ->check(CLI::IsMember({"csv", "json", "npz", "glb"}))
        ->type_name("csv|json|npz|glb");
    command
        ->add_option("--events", options->events,
                     "File of impacts and contacts, - for standard output (default: none)")
        ->type_name("EVENTS.csv");
    command
        ->add_option("--rate", options->rate,
                     "Rows per second of .csv and .npz, at most 1e7, e.g. 1000 or 30000/1001 "
                     "(default: the scene's film.fps)")
        ->type_name("HZ");
    add_scene_options(*command, options->common);
    add_output_options(*command, options->common);
    add_progress_options(*command, options->common);
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return simulate_to_files(*options, interrupt); };
    });
}

}  // namespace carom
