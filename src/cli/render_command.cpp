// carom render: from a scene to a film or to PNG frames.
#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/against.h"
#include "cli/commands.h"
#include "cli/cpu_timer.h"
#include "cli/exit_codes.h"
#include "cli/film_plan.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "render/painter.h"
#include "sim/simulate.h"

namespace carom {

namespace {

struct RenderOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::string format = "mp4";
    std::string frames;
    std::string chunk;
    bool dry_run = false;
    AgainstOptions against;
    CommonOptions common;
    EncodingOptions encoding;
};

std::vector<std::int64_t> wanted_frames(const RenderOptions& options, std::int64_t count) {
    if (!options.frames.empty()) return parse_frames(options.frames, count);
    if (!options.chunk.empty()) return parse_chunk(options.chunk, count);
    return all_frames(count);
}

std::vector<OutputRequest> requests(const RenderOptions& options) {
    std::vector<OutputRequest> result;
    for (const std::string& path : options.outputs) result.push_back({path, options.format});
    return result;
}

using Sinks = std::vector<std::unique_ptr<FrameSink>>;

/// Draws `frames` into every sink; returns how many were drawn before the end or an interrupt.
std::int64_t film(Painter& painter, const Film& film, const std::vector<std::int64_t>& frames,
                  const Sinks& sinks, const RenderOptions& options, const Interrupt& interrupt) {
    Progress progress(options.common.progress_mode(), "frames",
                      static_cast<std::int64_t>(frames.size()));
    Image picture;
    std::int64_t done = 0;
    for (const std::int64_t frame : frames) {
        if (interrupt.requested()) break;
        painter.paint(frame_time(film, frame), picture);
        for (std::size_t i = 0; i + 1 < sinks.size(); ++i) sinks[i]->write(frame, picture);
        // The driver has compiled its shaders by now: tens of megabytes that only the compiler
        // needed go back before the encoder grows.
        if (done == 0) malloc_trim(0);
        sinks.back()->write_swapped(frame, picture);  // nobody else needs it: no copy
        progress.update(++done);
    }
    return done;
}

/// Keeps what is playable and says how far it got.
int keep_partial(const Sinks& sinks, std::int64_t done, std::size_t wanted,
                 const Interrupt& interrupt) {
    fmt::print(stderr, "carom: interrupted after {} of {} frames\n", done, wanted);
    for (const auto& sink : sinks)
        if (const std::string kept = sink->keep_partial(); !kept.empty())
            fmt::print(stderr, "carom: kept {}\n", kept);
    return interrupt.exit_code();
}

void print_plan(const RenderOptions& options, const Scene& scene, const Motion& motion,
                const std::vector<std::int64_t>& frames) {
    fmt::print("{}: {} balls, {} surfaces, {} s of motion\n", scene.file, scene.balls.size(),
               scene.surfaces.size(), motion.duration);
    fmt::print("{} frames of {}x{} at {} frames/s, frame {} to {}\n", frames.size(),
               scene.film.width_px, scene.film.height_px, scene.film.fps.per_second(),
               frames.empty() ? -1 : frames.front(), frames.empty() ? -1 : frames.back());
    for (const std::string& path : options.outputs) fmt::print("-> {}\n", path);
}

/// The number of frames before simulating, when the scene says how long it lasts.
void check_early(const RenderOptions& options, const Scene& scene) {
    if (!scene.simulation.duration) return;
    const std::int64_t count = frame_count(scene.film, *scene.simulation.duration);
    check_outputs(requests(options), wanted_frames(options, count), options.common.overwrite);
}

int render(const RenderOptions& options, const Interrupt& interrupt) {
    Stats stats;
    if (!options.common.stats_path.empty())
        require_writable(options.common.stats_path, options.common.overwrite);

    std::optional<FilmScenes> scenes;
    {
        const CpuTimer timer(stats.scene_cpu_s);
        scenes = load_film_scenes(options.scene, options.common, options.against);
    }
    if (!scenes) return kExitInvalidScene;
    const Scene* scene = &scenes->scene;
    check_transparency(requests(options), *scene);
    check_early(options, *scene);

    SimulationResult simulated;
    std::optional<FilmedSecond> second;
    {
        const CpuTimer timer(stats.sim_cpu_s);
        simulated = simulate(*scene, interrupt.token());
        second = simulate_second(*scenes, simulated.motion, interrupt.token());
    }
    const Motion& motion = simulated.motion;
    if (second) stats.add_second(*second);
    stats.add_verdict(*scene, motion, options.common.quiet);
    Stats::warn_of_unrest(simulated.report, options.common.quiet);
    const std::vector<std::int64_t> frames =
        wanted_frames(options, frame_count(scene->film, motion.duration));
    check_outputs(requests(options), frames, options.common.overwrite);
    if (options.dry_run) {
        print_plan(options, *scene, motion, frames);
        return kExitDone;
    }

    Painter painter(*scene, motion,
                    {scene->film.width_px, scene->film.height_px, second ? &second->run : nullptr});
    if (options.common.verbose) fmt::print(stderr, "carom: {}\n", painter.renderer());
    Sinks sinks;
    for (const OutputRequest& output : requests(options))
        sinks.push_back(open_output(output, *scene, options.encoding));

    stats.frames = film(painter, scene->film, frames, sinks, options, interrupt);
    if (stats.frames < static_cast<std::int64_t>(frames.size()))
        return keep_partial(sinks, stats.frames, frames.size(), interrupt);
    for (const auto& sink : sinks) {
        sink->finish();
        stats.add_sink(sink->times());
    }
    stats.add_painter(painter);

    if (!options.common.stats_path.empty())
        write_text_file(options.common.stats_path, stats_json(stats, &simulated));
    if (!options.common.quiet) {
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - stats.start;
        fmt::print(stderr, "carom: {} frames in {:.1f} s ({:.0f} frames/s)\n", stats.frames,
                   wall.count(), static_cast<double>(stats.frames) / wall.count());
    }
    return kExitDone;
}

}  // namespace

void add_render_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("render", "Film a scene: MP4, Matroska, or PNG frames");
    auto options = std::make_shared<RenderOptions>();
    command->add_option("scene", options->scene, "Scene file, - for standard input")
        ->required()
        ->type_name("SCENE");
    command
        ->add_option("-o,--output", options->outputs,
                     "film.mp4, film.mkv, a name with %05d for PNG frames, a folder, or - "
                     "(repeatable: all from the same drawing)")
        ->required()
        ->type_name("OUT")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--format", options->format, "mp4, mkv or png, for -o -")
        ->check(CLI::IsMember({"mp4", "mkv", "png"}));
    auto* frames = command->add_option("--frames", options->frames, "e.g. 0-9,20-40:2,100-")
                       ->type_name("RANGES");
    command->add_option("--chunk", options->chunk, "Chunk I of N of the frames, or auto")
        ->type_name("I/N")
        ->excludes(frames);
    command->add_flag("--dry-run", options->dry_run, "Say what would be filmed, draw nothing");
    command->add_option("--fps", options->common.fps, "Frames per second, e.g. 30000/1001");
    command->add_option("--quality", options->encoding.quality, "draft, medium or high")
        ->check(CLI::IsMember({"draft", "medium", "high"}));
    command->add_option("--crf", options->encoding.crf, "x264's constant rate factor")
        ->check(CLI::Range(1, 51));
    command->add_option("--preset", options->encoding.preset, "x264's preset, e.g. medium");
    command->add_option("--threads", options->encoding.threads, "Threads of the encoder")
        ->check(CLI::Range(1, 128));
    add_against_options(*command, options->against);
    add_scene_options(*command, options->common);
    add_picture_options(*command, options->common);
    add_output_options(*command, options->common);
    add_talk_options(*command, options->common);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return render(*options, interrupt); };
    });
}

}  // namespace carom
