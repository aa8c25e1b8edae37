// carom render: from a scene to a film or to PNG frames.
#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "cli/against.h"
#include "cli/commands.h"
#include "cli/cpu_timer.h"
#include "cli/exit_codes.h"
#include "cli/film_plan.h"
#include "cli/interrupt.h"
#include "cli/kept_work.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/shown_simulation.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "render/painter.h"

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

/// A film on its way into all its outputs.
class Filming {
  public:
    Filming(const RenderOptions& options, const Interrupt& interrupt,
            const std::vector<std::int64_t>& frames)
        : options_(options), interrupt_(interrupt), frames_(frames) {}

    void open(const Scene& scene) {
        for (const OutputRequest& output : requests(options_))
            sinks_.push_back(open_output(output, scene, options_.encoding));
    }

    /// Draws and writes all frames; throws Interrupted when it has kept what is playable.
    void film(Painter& painter, const Film& film);

    void add_to(Stats& stats) const {
        for (const auto& sink : sinks_) stats.add_sink(sink->times());
    }

  private:
    bool has_film() const;
    void draw_all(Painter& painter, const Film& film, KeptWork* kept);
    void keep_partial() const;

    const RenderOptions& options_;
    const Interrupt& interrupt_;
    const std::vector<std::int64_t>& frames_;
    std::vector<std::unique_ptr<FrameSink>> sinks_;
    std::int64_t done_ = 0;
};

void Filming::film(Painter& painter, const Film& film) {
    // PNGs are whole or not there; half a film must be closed to be one.
    std::optional<KeptWork> kept;
    if (has_film()) kept.emplace(interrupt_, [this] { keep_partial(); });
    draw_all(painter, film, kept ? &*kept : nullptr);
    if (done_ < static_cast<std::int64_t>(frames_.size())) {
        keep_partial();
        throw Interrupted{};
    }
    for (const auto& sink : sinks_) sink->finish();
}

bool Filming::has_film() const {
    const std::vector<OutputRequest> all = requests(options_);
    return std::any_of(all.begin(), all.end(),
                       [](const OutputRequest& output) { return output.is_film(); });
}

void Filming::draw_all(Painter& painter, const Film& film, KeptWork* kept) {
    Progress progress(options_.common.progress_mode(), interrupt_, "frames",
                      static_cast<std::int64_t>(frames_.size()));
    Image picture;
    for (const std::int64_t frame : frames_) {
        if (interrupt_.requested()) return;
        const auto paint = [&] { painter.paint(frame_time(film, frame), picture); };
        if (kept != nullptr)
            kept->step(paint);
        else
            paint();
        for (std::size_t i = 0; i + 1 < sinks_.size(); ++i) sinks_[i]->write(frame, picture);
        // The driver has compiled its shaders by now: tens of megabytes that only the compiler
        // needed go back before the encoder grows.
        if (done_ == 0) malloc_trim(0);
        sinks_.back()->write_swapped(frame, picture);  // nobody else needs it: no copy
        progress.update(static_cast<double>(++done_));
    }
}

/// Keeps what is playable and says how far it got.
void Filming::keep_partial() const {
    interrupt_.reached(fmt::format("after {} of {} frames", done_, frames_.size()));
    interrupt_.say();
    for (const auto& sink : sinks_)
        if (const std::string kept = sink->keep_partial(); !kept.empty())
            say("carom: kept {}\n", kept);
}

std::string plan_text(const RenderOptions& options, const Scene& scene, const Motion& motion,
                      const std::vector<std::int64_t>& frames) {
    std::string text = fmt::format("{}: {} balls, {} surfaces, {} s of motion\n", scene.file,
                                   scene.balls.size(), scene.surfaces.size(), motion.duration);
    text += fmt::format("{} frames of {}x{} at {} frames/s, frame {} to {}\n", frames.size(),
                        scene.film.width_px, scene.film.height_px, scene.film.fps.per_second(),
                        frames.empty() ? -1 : frames.front(), frames.empty() ? -1 : frames.back());
    for (const std::string& path : options.outputs) text += fmt::format("-> {}\n", path);
    return text;
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
    if (!options.dry_run) prepare_folders(requests(options));

    SimulationResult simulated;
    std::optional<FilmedSecond> second;
    {
        const CpuTimer timer(stats.sim_cpu_s);
        const ProgressMode mode = options.common.progress_mode();
        simulated = simulate_shown(*scene, interrupt, mode);
        second = simulate_second(*scenes, simulated.motion, interrupt, mode);
    }
    const Motion& motion = simulated.motion;
    if (second) stats.add_second(*second);
    stats.add_verdict(*scene, motion, options.common.quiet);
    Stats::warn_of_unrest(simulated.report, options.common.quiet);
    const std::vector<std::int64_t> frames =
        wanted_frames(options, frame_count(scene->film, motion.duration));
    check_outputs(requests(options), frames, options.common.overwrite);
    if (options.dry_run) {
        write_standard_output(plan_text(options, *scene, motion, frames));
        return kExitDone;
    }

    Painter painter(*scene, motion,
                    {scene->film.width_px, scene->film.height_px, second ? &second->run : nullptr});
    if (options.common.verbose) say("carom: {}\n", painter.renderer());
    Filming filming(options, interrupt, frames);
    filming.open(*scene);
    filming.film(painter, scene->film);
    stats.frames = static_cast<std::int64_t>(frames.size());
    filming.add_to(stats);
    stats.add_painter(painter);

    if (!options.common.stats_path.empty())
        write_text_file(options.common.stats_path, stats_json(stats, &simulated));
    if (!options.common.quiet) {
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - stats.start;
        say("carom: {} frames in {:.1f} s ({:.0f} frames/s)\n", stats.frames, wall.count(),
            static_cast<double>(stats.frames) / wall.count());
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
