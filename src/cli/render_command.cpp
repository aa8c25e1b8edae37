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
#include "cli/film_run.h"
#include "cli/interrupt.h"
#include "cli/kept_work.h"
#include "cli/layer_options.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/resume.h"
#include "cli/shown_simulation.h"
#include "cli/sound_output.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/film_format.h"
#include "media/output_file.h"
#include "render/painter.h"
#include "report/filming.h"
#include "report/growing_motion.h"
#include "report/impact_sound.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

FrameRanges wanted_frames(const RenderOptions& options, const Film& film, double duration) {
    const std::int64_t count = frame_count(film, duration);
    FrameRanges frames = FrameRanges::all(count);
    if (!options.frames.empty()) frames = parse_frames(options.frames, count);
    if (!options.chunk.empty()) frames = parse_chunk(options.chunk, count);
    require_drawable(frames, film);
    return frames;
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
    for (const std::string& path : options.sounds) text += fmt::format("-> {}\n", readable(path));
    const FilmNeeds needs = film_needs(requests(options), scene, options.encoding, frames.size());
    return text + needs_text(needs) + "\n";
}

/// Refuses files that exist, and what has no room.
void check_files(const RenderOptions& options, const Scene& scene, const FrameRanges& frames,
                 std::int64_t drawn) {
    const std::vector<OutputRequest> outputs = requests(options);
    check_outputs(outputs, frames, options.replaces());
    if (options.layers.wanted())
        require_new_layers(options.layers, frames_for_layers(outputs), frames,
                           !options.chunk.empty(), options.common.overwrite);
    require_room(outputs, scene, options.encoding, drawn);
}

/// What can be refused before simulating, when the scene says how long it lasts. True if nothing is
/// left to do: a chunk without frames.
bool is_done_early(const RenderOptions& options, const Scene& scene) {
    if (!scene.simulation.duration) return false;
    const FrameRanges frames = wanted_frames(options, scene.film, *scene.simulation.duration);
    // Which of them --resume draws is not known yet.
    check_files(options, scene, frames, options.resume ? 0 : frames.size());
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

/// Draws and writes the source's frames. `growing` is null where the motion is there.
void film(const RenderOptions& options, const Interrupt& interrupt, const FilmSource& source,
          const Motion& motion, GrowingMotion* growing, const SecondRun* second, Stats& stats) {
    const Film& film = source.scene.film;
    require_one_picture(options.layers, second);
    if (growing != nullptr) growing->wait_for(needed_for_picture(source.scene, film.start));
    Painter painter(source.scene, motion, {film.width_px, film.height_px, second});
    if (options.common.verbose) say("carom: {}\n", painter.renderer());
    Filming filming(options, interrupt, source, growing);
    filming.open();
    filming.open_layers(source.scene, motion, second);
    filming.film(painter);
    filming.add_to(stats);
    stats.add_painter(painter);
}

/// What the simulation has to say, on standard error.
void say_findings(const RenderOptions& options, const Scene& scene, const SimulationResult& result,
                  Stats& stats) {
    stats.add_warnings(result.report, options.common.quiet);
    stats.add_verdict(scene, result.motion, options.common.quiet);
    Stats::warn_of_unrest(result.report, options.common.quiet);
}

void say_end(const Stats& stats, const RenderOptions& options) {
    if (options.outputs.empty()) return;
    if (stats.frames == 0) {
        say("carom: all {} frames are there\n", stats.frames_kept);
        return;
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - stats.start;
    const std::string kept =
        stats.frames_kept > 0 ? fmt::format(", {} were there", stats.frames_kept) : "";
    say("carom: {} frames in {:.1f} s ({:.0f} frames/s){}\n", stats.frames, wall.count(),
        static_cast<double>(stats.frames) / wall.count(), kept);
}

/// Why frames are drawn when the motion is known to its end; "" where they need not wait.
std::string why_drawn_at_end(const RenderOptions& options, const FilmScenes& scenes) {
    if (options.dry_run) return "nothing is drawn";
    if (!options.sounds.empty() || has_sound_track(scenes.scene, requests(options)))
        return "the loudest impact gives the level of all sound";
    if (options.layers.wanted()) return "layers are written with the frames";
    return why_whole_motion(scenes.scene, scenes.second.has_value());
}

void check_sounds_of(const RenderOptions& options) {
    check_sounds(options.sounds, options.outputs, options.scene, options.common.overwrite);
    const bool part = !options.frames.empty() || !options.chunk.empty() || options.resume;
    if (part && !options.sounds.empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("-o {}: sound is made of the whole film: leave out --frames, "
                                  "--chunk and --resume",
                                  options.sounds.front()));
}

/// Writes what goes to files of its own, and returns what goes into films.
std::optional<FramesSound> make_sounds(const RenderOptions& options, const FilmSource& source,
                                       const Motion& motion) {
    const bool in_films = has_sound_track(source.scene, requests(options));
    if (options.sounds.empty() && !in_films) return std::nullopt;
    SoundSamples sound = impact_sound(source.scene, motion);
    write_sounds(options.sounds, sound, options.common.existing());
    if (!in_films) return std::nullopt;
    return sound_of_frames(std::move(sound), source.scene.film, source.frames);
}

/// Refuses what no scene could make right.
void check_request(const RenderOptions& options) {
    check_sounds_of(options);
    check_output_names(requests(options), {{"--stats", options.common.stats_path}},
                       {{"SCENE", options.scene}, {"--against", options.against.scene}});
    require_stats_writable(options.common);
    if (options.resume) require_resumable(requests(options));
    if (!options.layers.wanted()) return;
    if (options.resume)
        throw Failure(FailureKind::kInput,
                      "--resume looks at pictures, not at the layers beside them: draw what is "
                      "missing with --frames and -y");
    const std::vector<OutputRequest> outputs = requests(options);
    frames_for_layers(outputs);
    require_layer_libraries(options.layers.kinds());
}

/// Refuses what this scene cannot be made into.
void check_scenes(const RenderOptions& options, const FilmScenes& scenes) {
    check_films(requests(options), scenes.scene, options.encoding);
    check_sound_tracks(scenes.scene, requests(options), options.sound, options.common.quiet);
    if (scenes.second) require_second_untouched(options, scenes.second->file);
}

/// What --stats says is of the whole motion.
GrowingMotion::Keep kept_motion(const RenderOptions& options) {
    return options.common.stats_path.empty() ? GrowingMotion::Keep::kNeeded
                                             : GrowingMotion::Keep::kAll;
}

/// Waits for the motion's end where it is asked for or there: a film of the first frames does
/// without the rest.
void end_growing(const RenderOptions& options, const Scene& scene, GrowingMotion& growing,
                 SimulationResult& simulated, Stats& stats) {
    if (options.common.stats_path.empty() && !growing.is_whole()) return;
    simulated = growing.finish();
    stats.sim_cpu_s += growing.cpu_s();
    say_findings(options, scene, simulated, stats);
}

int render(const RenderOptions& options, const Interrupt& interrupt) {
    Stats stats;
    check_request(options);
    std::optional<FilmScenes> scenes;
    {
        const CpuTimer timer(stats.scene_cpu_s);
        scenes = load_film_scenes(options.scene, options.common, options.against);
    }
    if (!scenes) return kExitInvalidScene;
    const Scene* scene = &scenes->scene;
    check_scenes(options, *scenes);
    if (is_done_early(options, *scene)) return nothing_to_do(options);
    if (!options.dry_run) prepare_folders(requests(options));

    const std::string why_whole = why_drawn_at_end(options, *scenes);
    stats.effects["early_start"] = {why_whole.empty(),
                                    why_whole.empty() ? "frames need no later motion" : why_whole};
    SimulationResult simulated;
    std::optional<FilmedSecond> second;
    std::optional<GrowingMotion> growing;
    if (why_whole.empty()) {
        growing.emplace(*scene, kept_motion(options), interrupt.token());
    } else {
        const CpuTimer timer(stats.sim_cpu_s);
        const ProgressMode mode = options.common.progress_mode();
        simulated = simulate_shown(*scene, interrupt, mode);
        second = simulate_second(*scenes, simulated.motion, interrupt, mode);
        say_findings(options, *scene, simulated, stats);
    }
    const Motion& motion = growing ? growing->motion() : simulated.motion;
    if (second) stats.add_second(*second);
    FilmSource source{*scene, scenes->second ? &*scenes->second : nullptr, scenes->view,
                      wanted_frames(options, scene->film, motion.duration),
                      frame_count(scene->film, motion.duration)};
    const FrameRanges wanted = source.frames;
    if (options.resume)
        source.frames = missing_frames(requests(options), source, options.encoding, interrupt);
    check_files(options, *scene, wanted, source.frames.size());
    if (options.dry_run) {
        write_standard_output(plan_text(options, *scene, motion, source.frames));
        return kExitDone;
    }
    if (wanted.empty()) return nothing_to_do(options);
    if (options.resume) remove_leftovers(requests(options), wanted);

    const std::optional<FramesSound> sound = make_sounds(options, source, motion);
    if (sound) source.sound = &*sound;
    stats.frames = options.outputs.empty() ? 0 : source.frames.size();
    stats.frames_kept = options.resume ? wanted.size() - stats.frames : 0;
    if (stats.frames > 0)
        film(options, interrupt, source, motion, growing ? &*growing : nullptr,
             second ? &second->run : nullptr, stats);
    if (growing) end_growing(options, *scene, *growing, simulated, stats);
    if (!options.common.stats_path.empty())
        write_stats(options.common, stats_json(stats, &simulated));
    if (!options.common.quiet) say_end(stats, options);
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
        "  carom render scene.yaml -o film.mp4 -o film.wav\n"
        "  carom render scene.yaml -o film.webm --set background=transparent --quality high\n");
    add_scene_argument(*command, options->scene);
    command
        ->add_option(
            "-o,--output", options->outputs,
            fmt::format("A film, whose name ends in {}, a name with %05d.png for PNG frames, a "
                        "folder (with / at its end if its name has a dot), - for standard output, "
                        "or a name with .wav for the sound of the impacts (repeatable: all from "
                        "the same drawing)",
                        film_extensions()))
        ->required()
        ->type_name("OUT")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--format", options->format, "Format of -o -")
        ->check(CLI::IsMember(formats))
        ->type_name(fmt::format("{}", fmt::join(formats, "|")))
        ->capture_default_str();
    command->add_flag("--sound", options->sound,
                      "Put the sound of the impacts into the films, as film.sound: true does; an "
                      "output that holds none is refused (default: as the scene says)");
    auto* frames = command
                       ->add_option("--frames", options->frames,
                                    "Frames to draw, e.g. 0-9,20-40:2,100- (default: all)")
                       ->type_name("RANGES");
    command
        ->add_option(
            "--chunk", options->chunk,
            "Part I of N equal ones of the frames, or auto in an array of Slurm, Grid Engine or "
            "AWS Batch (default: all)")
        ->type_name("I/N")
        ->excludes(frames);
    command->add_flag("--resume", options->resume,
                      "Of PNG frames, draw those that are missing, damaged or made from another "
                      "scene, other settings or by another version, and keep the others");
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
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] {
            options->sounds = take_sounds(options->outputs);
            if (options->sound) options->common.set.push_back("film.sound=true");
            return render(*options, interrupt);
        };
    });
}

}  // namespace carom
