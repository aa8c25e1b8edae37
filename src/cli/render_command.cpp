// carom render: from a scene to a film or to PNG frames.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "cli/against.h"
#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/cpu_timer.h"
#include "cli/encoding_options.h"
#include "cli/exit_codes.h"
#include "cli/film_limits.h"
#include "cli/film_plan.h"
#include "cli/interrupt.h"
#include "cli/kept_work.h"
#include "cli/layer_options.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/shown_simulation.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/film_format.h"
#include "media/output_file.h"
#include "render/painter.h"
#include "report/filming.h"
#include "scene/film_clock.h"

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
    LayerOptions layers;
};

FrameRanges wanted_frames(const RenderOptions& options, const Film& film, double duration) {
    const std::int64_t count = frame_count(film, duration);
    FrameRanges frames = FrameRanges::all(count);
    if (!options.frames.empty()) frames = parse_frames(options.frames, count);
    if (!options.chunk.empty()) frames = parse_chunk(options.chunk, count);
    require_drawable(frames, film);
    return frames;
}

std::vector<OutputRequest> requests(const RenderOptions& options) {
    std::vector<OutputRequest> result;
    for (const std::string& path : options.outputs) result.push_back({path, options.format});
    return result;
}

/// A film on its way into all its outputs.
class Filming {
  public:
    Filming(const RenderOptions& options, const Interrupt& interrupt, const FrameRanges& frames)
        : options_(options), interrupt_(interrupt), frames_(frames) {}

    void open(const Scene& scene) {
        EncodingOptions encoding = options_.encoding;
        encoding.existing = options_.common.existing();
        for (const OutputRequest& output : requests(options_))
            sinks_.push_back(open_output(output, scene, encoding));
    }

    /// Layers beside the frames, where they are wanted; all must outlive it.
    void open_layers(const Scene& scene, const Motion& motion, const SecondRun* second);

    /// Draws and writes all frames; throws Interrupted when it has kept what is playable.
    void film(Painter& painter, const Film& film);

    void add_to(Stats& stats) const {
        for (const auto& sink : sinks_) stats.add_sink(sink->times());
        if (layers_) stats.layers_cpu_s = layers_->cpu_s();
    }

  private:
    bool has_film() const;
    void draw_all(Painter& painter, const Film& film, KeptWork* kept);
    void keep_partial() const;
    void write_layers(std::int64_t frame, const Film& film);

    const RenderOptions& options_;
    const Interrupt& interrupt_;
    const FrameRanges& frames_;
    std::vector<std::unique_ptr<FrameSink>> sinks_;
    std::unique_ptr<LayerFiles> layers_;  ///< null: none are wanted
    std::int64_t frame_count_ = 0;        ///< of the whole film
    std::int64_t done_ = 0;
};

void Filming::open_layers(const Scene& scene, const Motion& motion, const SecondRun* second) {
    if (!options_.layers.wanted()) return;
    const std::vector<OutputRequest> outputs = requests(options_);
    layers_ = std::make_unique<LayerFiles>(
        scene, motion,
        LayerSettings{scene.film.width_px, scene.film.height_px, options_.layers.kinds(), second},
        layer_index_path(frames_for_layers(outputs), frames_, !options_.chunk.empty()),
        options_.common.existing(), Durability::kUnsynced);
    frame_count_ = frame_count(scene.film, motion.duration);
}

void Filming::write_layers(std::int64_t frame, const Film& film) {
    const std::vector<OutputRequest> outputs = requests(options_);
    layers_->write(sequence_path(frames_for_layers(outputs).path, frame), frame,
                   instants_of_frame(film, frame, frame_count_));
}

void Filming::film(Painter& painter, const Film& film) {
    // PNGs are whole or not there; half a film must be closed to be one, and layers want an index.
    std::optional<KeptWork> kept;
    if (has_film() || layers_) kept.emplace(interrupt_, [this] { keep_partial(); });
    draw_all(painter, film, kept ? &*kept : nullptr);
    if (done_ < frames_.size()) {
        keep_partial();
        throw Interrupted{};
    }
    for (const auto& sink : sinks_) sink->finish();
    if (layers_) layers_->finish();
}

bool Filming::has_film() const {
    const std::vector<OutputRequest> all = requests(options_);
    return std::any_of(all.begin(), all.end(),
                       [](const OutputRequest& output) { return output.is_film(); });
}

void Filming::draw_all(Painter& painter, const Film& film, KeptWork* kept) {
    Progress progress(options_.common.progress_mode(), interrupt_, "frames", frames_.size());
    FilmingHooks hooks;
    hooks.stops = [this] { return interrupt_.requested(); };
    if (kept != nullptr) hooks.run_drawing = [kept](const auto& draw) { kept->step(draw); };
    FrameRanges::Iterator frame = frames_.begin();
    hooks.written = [&](std::int64_t done) {
        if (layers_) {
            kept->step([&] { write_layers(*frame, film); });
            layers_->add_to_index();
        }
        ++frame;
        done_ = done;
        progress.update(static_cast<double>(done));
    };
    film_frames(painter, film, frames_, sinks_, hooks);
}

/// Keeps what is playable and says how far it got.
void Filming::keep_partial() const {
    interrupt_.reached(fmt::format("after {} of {} frames", done_, frames_.size()));
    interrupt_.say();
    for (const auto& sink : sinks_)
        if (const std::string kept = sink->keep_partial(); !kept.empty())
            say("carom: kept {}\n", readable(kept));
    if (layers_) layers_->finish();
}

std::string plan_text(const RenderOptions& options, const Scene& scene, const Motion& motion,
                      const FrameRanges& frames) {
    std::string text =
        fmt::format("{}: {} balls, {} surfaces, {} s of motion\n", readable(scene.file),
                    scene.balls.size(), scene.surfaces.size(), motion.duration);
    const std::string places =
        frames.empty() ? "" : fmt::format(", frame {} to {}", frames.front(), frames.back());
    text += fmt::format("{} frames of {}x{} at {} frames/s{}\n", frames.size(), scene.film.width_px,
                        scene.film.height_px, scene.film.fps.per_second(), places);
    for (const std::string& path : options.outputs) text += fmt::format("-> {}\n", readable(path));
    const FilmNeeds needs = film_needs(requests(options), scene, options.encoding, frames.size());
    return text + needs_text(needs) + "\n";
}

/// Refuses files that exist, and what has no room.
void check_files(const RenderOptions& options, const Scene& scene, const FrameRanges& frames) {
    const std::vector<OutputRequest> outputs = requests(options);
    check_outputs(outputs, frames, options.common.overwrite);
    if (options.layers.wanted())
        require_new_layers(options.layers, frames_for_layers(outputs), frames,
                           !options.chunk.empty(), options.common.overwrite);
    require_room(outputs, scene, options.encoding, frames.size());
}

/// What can be refused before simulating, when the scene says how long it lasts. True if nothing is
/// left to do: a chunk without frames.
bool is_done_early(const RenderOptions& options, const Scene& scene) {
    if (!scene.simulation.duration) return false;
    const FrameRanges frames = wanted_frames(options, scene.film, *scene.simulation.duration);
    check_files(options, scene, frames);
    return frames.empty() && !options.dry_run;
}

int nothing_to_do(const RenderOptions& options) {
    if (!options.common.quiet)
        fmt::print(stderr, "carom: chunk {} has no frames: nothing is written\n", options.chunk);
    return kExitDone;
}

/// The second run's scene may be named by the scene itself, which has to be read to know.
void require_second_untouched(const RenderOptions& options, const std::string& second_scene) {
    check_output_names(requests(options), {{"--stats", options.common.stats_path}},
                       {{"against", second_scene}});
}

int render(const RenderOptions& options, const Interrupt& interrupt) {
    Stats stats;
    check_output_names(requests(options), {{"--stats", options.common.stats_path}},
                       {{"SCENE", options.scene}, {"--against", options.against.scene}});
    require_stats_writable(options.common);
    if (options.layers.wanted()) {
        const std::vector<OutputRequest> outputs = requests(options);
        frames_for_layers(outputs);
        require_layer_libraries(options.layers.kinds());
    }

    std::optional<FilmScenes> scenes;
    {
        const CpuTimer timer(stats.scene_cpu_s);
        scenes = load_film_scenes(options.scene, options.common, options.against);
    }
    if (!scenes) return kExitInvalidScene;
    const Scene* scene = &scenes->scene;
    check_films(requests(options), *scene, options.encoding);
    if (scenes->second) require_second_untouched(options, scenes->second->file);
    if (is_done_early(options, *scene)) return nothing_to_do(options);
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
    stats.add_warnings(simulated.report, options.common.quiet);
    stats.add_verdict(*scene, motion, options.common.quiet);
    Stats::warn_of_unrest(simulated.report, options.common.quiet);
    const FrameRanges frames = wanted_frames(options, scene->film, motion.duration);
    check_files(options, *scene, frames);
    if (options.dry_run) {
        write_standard_output(plan_text(options, *scene, motion, frames));
        return kExitDone;
    }
    if (frames.empty()) return nothing_to_do(options);

    require_one_picture(options.layers, second ? &second->run : nullptr);
    Painter painter(*scene, motion,
                    {scene->film.width_px, scene->film.height_px, second ? &second->run : nullptr});
    if (options.common.verbose) say("carom: {}\n", painter.renderer());
    Filming filming(options, interrupt, frames);
    filming.open(*scene);
    filming.open_layers(*scene, motion, second ? &second->run : nullptr);
    filming.film(painter, scene->film);
    stats.frames = frames.size();
    filming.add_to(stats);
    stats.add_painter(painter);

    if (!options.common.stats_path.empty())
        write_stats(options.common, stats_json(stats, &simulated));
    if (!options.common.quiet) {
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - stats.start;
        say("carom: {} frames in {:.1f} s ({:.0f} frames/s)\n", stats.frames, wall.count(),
            static_cast<double>(stats.frames) / wall.count());
    }
    return kExitDone;
}

}  // namespace

void add_render_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("render", "Film a scene, or draw its frames as PNGs");
    auto options = std::make_shared<RenderOptions>();
    const std::vector<std::string> formats = stream_formats();
    command->footer(
        "  carom render scene.yaml -o film.mp4\n"
        "  carom render scene.yaml -o frame_%05d.png --frames 0-99 --size 640x360\n"
        "  carom render scene.yaml -o - --format mkv | ffplay -\n"
        "  carom render scene.yaml -o film.webm --set background=transparent --quality high\n");
    command->add_option("scene", options->scene, "Scene file, - for standard input")
        ->required()
        ->type_name("SCENE");
    command
        ->add_option(
            "-o,--output", options->outputs,
            fmt::format("A film, whose name ends in {}, a name with %05d.png for PNG frames, a "
                        "folder (with / at its end if its name has a dot), or - for standard "
                        "output (repeatable: all from the same drawing)",
                        film_extensions()))
        ->required()
        ->type_name("OUT")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--format", options->format, "Format of -o -")
        ->check(CLI::IsMember(formats))
        ->type_name(fmt::format("{}", fmt::join(formats, "|")))
        ->capture_default_str();
    auto* frames = command
                       ->add_option("--frames", options->frames,
                                    "Frames to draw, e.g. 0-9,20-40:2,100- (default: all)")
                       ->type_name("RANGES");
    command
        ->add_option(
            "--chunk", options->chunk,
            "Part I of N equal ones of the frames, or auto in a Slurm array (default: all)")
        ->type_name("I/N")
        ->excludes(frames);
    command->add_flag("--dry-run", options->dry_run, "Say what would be filmed, draw nothing");
    command
        ->add_option("--fps", options->common.fps,
                     "Frames per second, e.g. 30000/1001 (default: the scene's film.fps)")
        ->type_name("N");
    add_encoding_options(*command, options->encoding);
    add_layer_option(*command, options->layers);
    add_against_options(*command, options->against);
    add_scene_options(*command, options->common);
    add_picture_options(*command, options->common);
    add_backend_option(*command);
    add_output_options(*command, options->common);
    add_talk_options(*command, options->common);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return render(*options, interrupt); };
    });
}

}  // namespace carom
