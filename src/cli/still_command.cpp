// carom still: one picture of one instant.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cli/against.h"
#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/cpu_timer.h"
#include "cli/distinct_files.h"
#include "cli/encoding_options.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/layer_options.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/short_lived.h"
#include "cli/shown_simulation.h"
#include "cli/standard_output.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "media/png.h"
#include "render/gl/offscreen.h"
#include "render/painter.h"

namespace carom {

namespace {

struct StillOptions {
    std::string scene;
    std::string output;
    double time = 0;
    std::optional<double> strobe;  ///< s between instants
    std::optional<double> dpi;
    AgainstOptions against;
    LayerOptions layers;
    CommonOptions common;
};

/// Refuses a name that is no PNG, and a file that may not be replaced.
void check_output(const StillOptions& options) {
    require_stats_writable(options.common);
    if (options.output == "-") return;
    if (std::filesystem::path(options.output).extension() != ".png")
        throw Failure(FailureKind::kInput,
                      fmt::format("-o {}: a still is a .png file", options.output));
    require_writable(options.output, options.common.overwrite);
}

std::string layer_index_beside(const std::string& picture) {
    return (std::filesystem::path(picture).parent_path() / "layers.json").string();
}

/// Refuses layers of what is no single picture in a file, and files that may not be replaced.
void check_layers(const StillOptions& options) {
    if (!options.layers.wanted()) return;
    const std::vector<LayerKind> kinds = options.layers.kinds();
    if (options.output == "-")
        throw Failure(FailureKind::kInput, "--layers: layers are files beside the picture, not -");
    if (options.strobe)
        throw Failure(FailureKind::kInput,
                      "--layers: a picture of many instants (--strobe) has none");
    for (const LayerKind kind : kinds)
        require_writable(layer_path(options.output, layer_kind_info(kind)),
                         options.common.overwrite);
    require_writable(layer_index_beside(options.output), options.common.overwrite);
    require_layer_libraries(kinds);
}

void write_layers(const StillOptions& options, const Scene& scene, const Motion& motion,
                  const SecondRun* second, Stats& stats) {
    if (!options.layers.wanted()) return;
    LayerFiles layers(
        scene, motion,
        LayerSettings{scene.film.width_px, scene.film.height_px, options.layers.kinds(), second},
        layer_index_beside(options.output), options.common.existing(), Durability::kSynced);
    layers.write(options.output, std::nullopt,
                 instants_of_still(scene.film, options.time, motion.duration));
    layers.add_to_index();
    layers.finish();
    stats.layers_cpu_s = layers.cpu_s();
}

/// The instants time - k strobe from 0 on, increasing; `time` itself is the last.
std::vector<double> instants(const StillOptions& options) {
    constexpr double kMostInstants = 10'000;
    if (!options.strobe) return {options.time};
    const double step = *options.strobe;
    if (!(step > 0) || !std::isfinite(step))
        throw Failure(
            FailureKind::kInput,
            fmt::format("--strobe {}: the time between two instants must be above 0 s", step));
    // A start that is missed by rounding alone belongs to the picture.
    const double steps = std::floor(options.time / step * (1 + 1e-12) + 1e-12);
    if (steps >= kMostInstants)
        throw Failure(FailureKind::kInput,
                      fmt::format("--strobe {}: {:.3g} instants up to {} s; at most {:.0f} are "
                                  "possible",
                                  step, steps + 1, options.time, kMostInstants));
    std::vector<double> result;
    for (double k = steps; k >= 0; --k) result.push_back(std::max(0.0, options.time - k * step));
    return result;
}

PainterOptions painter_options(const StillOptions& options, const Film& film,
                               const SecondRun* second) {
    require_one_picture(options.layers, second);
    PainterOptions painting;
    painting.width_px = film.width_px;
    painting.height_px = film.height_px;
    painting.second = second;
    painting.few_pictures = draws_sooner_than_it_compiles(painting.width_px, painting.height_px);
    if (painting.few_pictures) prefer_quick_compile();
    painting.only_at = options.time;
    return painting;
}

int still(const StillOptions& options, const Interrupt& interrupt) {
    ask_for_memory_in_large_parts();
    Stats stats;
    require_distinct({{"-o", options.output}, {"--stats", options.common.stats_path}},
                     {{"SCENE", options.scene}, {"--against", options.against.scene}});
    check_output(options);
    check_layers(options);
    const DriverPreload driver;
    std::optional<FilmScenes> scenes;
    {
        const CpuTimer timer(stats.scene_cpu_s);
        scenes = load_film_scenes(options.scene, options.common, options.against);
    }
    if (!scenes) return kExitInvalidScene;
    const Scene* scene = &scenes->scene;
    if (scenes->second)
        require_distinct({{"-o", options.output}, {"--stats", options.common.stats_path}},
                         {{"against", scenes->second->file}});

    SimulationResult simulated;
    std::optional<FilmedSecond> second;
    {
        const CpuTimer timer(stats.sim_cpu_s);
        const ProgressMode mode = options.common.progress_mode();
        simulated = simulate_shown(*scene, interrupt, mode);
        second = simulate_second(*scenes, simulated.motion, interrupt, mode);
    }
    interrupt.reached("while drawing");
    if (second) stats.add_second(*second);
    stats.add_warnings(simulated.report, options.common.quiet);
    stats.add_verdict(*scene, simulated.motion, options.common.quiet);
    Stats::warn_of_unrest(simulated.report, options.common.quiet);
    const double duration = simulated.motion.duration;
    if (!(options.time >= 0 && options.time <= duration))
        throw Failure(FailureKind::kInput, fmt::format("--time {}: the motion lasts from 0 to {} s",
                                                       options.time, duration));

    const PainterOptions painting =
        painter_options(options, scene->film, second ? &second->run : nullptr);
    Painter painter(*scene, simulated.motion, painting);
    Image picture;
    painter.paint_strobe(instants(options), picture);
    interrupt.check();
    {
        const CpuTimer timer(stats.sinks.encode_cpu_s);
        const PngNotes notes = png_notes(*scene, options.time, options.dpi);
        if (options.output == "-")
            write_standard_output(encode_png(picture, PngEffort::kFast, notes));
        else
            write_png(options.output, picture, PngEffort::kFast, Durability::kSynced,
                      options.common.existing(), notes);
    }
    write_layers(options, *scene, simulated.motion, painting.second, stats);
    stats.frames = 1;
    stats.add_painter(painter);
    if (!options.common.stats_path.empty())
        write_stats(options.common, stats_json(stats, &simulated));
    end_at_once(kExitDone);
}

}  // namespace

void add_still_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("still", "Draw one instant of a scene as a PNG");
    auto options = std::make_shared<StillOptions>();
    command->footer(
        "  carom still scene.yaml --time 1.2 -o picture.png\n"
        "  carom still scene.yaml --time 2 --strobe 0.1 -o strobe.png\n");
    add_scene_argument(*command, options->scene);
    command
        ->add_option("--time", options->time, "Instant of the motion in seconds, from 0 to its end")
        ->required()
        ->type_name("T");
    command
        ->add_option(
            "--strobe", options->strobe,
            "Lay the instants before T over one another, DT seconds apart (default: T alone)")
        ->type_name("DT");
    command->add_option("-o,--output", options->output, "picture.png, or - for standard output")
        ->required()
        ->type_name("OUT.png");
    add_dpi_option(*command, options->dpi);
    add_layer_option(*command, options->layers);
    add_against_options(*command, options->against);
    add_scene_options(*command, options->common);
    add_picture_options(*command, options->common);
    add_backend_option(*command);
    add_output_options(*command, options->common);
    add_progress_options(*command, options->common);
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return still(*options, interrupt); };
    });
}

}  // namespace carom
