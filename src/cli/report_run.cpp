#include "cli/report_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include "cli/against.h"
#include "cli/outputs.h"
#include "cli/shown_simulation.h"
#include "cli/standard_error.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "core/readable.h"
#include "core/temporary_folder.h"
#include "media/png.h"
#include "render/painter.h"
#include "report/filming.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad())
        throw Failure(FailureKind::kOutput, fmt::format("reading {} back failed", path));
    return bytes;
}

/// The film of the whole motion, as `carom render` makes it.
std::string filmed(const FilmScenes& scenes, const Motion& motion, Painter& painter,
                   const CommonOptions& options, const Interrupt& interrupt) {
    const Film& film = scenes.scene.film;
    const TemporaryFolder folder(FailureKind::kOutput);
    const OutputRequest output{folder.file("film.mp4"), "mp4"};
    const std::int64_t count = frame_count(film, motion.duration);
    const FilmSource source{scenes.scene, scenes.second ? &*scenes.second : nullptr, scenes.view,
                            FrameRanges::all(count), count};
    std::vector<std::unique_ptr<FrameSink>> sinks;
    sinks.push_back(open_output(output, source, {}));
    Progress progress(options.progress_mode(), interrupt, kFilming, count,
                      1 / film.fps.per_second());
    FilmingHooks hooks;
    hooks.stops = [&] { return interrupt.requested(); };
    hooks.written = [&](std::int64_t done) { progress.update(static_cast<double>(done)); };
    film_frames(painter, film, source.frames, sinks, hooks);
    interrupt.check();
    sinks.front()->finish();
    return bytes_of(output.path);
}

/// Instants over the part of the motion in which balls still rise to half of the highest top: later
/// ones would cover each other.
std::vector<double> strobe_instants(const Motion& motion, double start) {
    constexpr int kInstants = 16;
    constexpr double kLively = 0.5;
    double highest = 0, end = 0;
    for (const std::vector<Peak>& peaks : motion.peaks)
        for (const Peak& peak : peaks) highest = std::max(highest, peak.height);
    for (const std::vector<Peak>& peaks : motion.peaks)
        for (const Peak& peak : peaks)
            if (peak.height >= kLively * highest) end = std::max(end, peak.time);
    if (!(end > start)) end = motion.duration;
    if (!(end > start)) return {end};
    std::vector<double> instants;
    for (int k = 0; k < kInstants; ++k)
        instants.push_back(start + (end - start) * k / (kInstants - 1));
    return instants;
}

void draw(const FilmScenes& scenes, const SimulationResult& result, const SecondRun* second,
          const CommonOptions& options, const ReportWishes& wishes, const Interrupt& interrupt,
          ReportParts& parts) {
    const Film& film = scenes.scene.film;
    Painter painter(scenes.scene, result.motion, {film.width_px, film.height_px, second});
    if (wishes.film) parts.film_mp4 = filmed(scenes, result.motion, painter, options, interrupt);
    const std::vector<double> instants = strobe_instants(result.motion, film.start);
    Image picture;
    painter.paint_strobe(instants, picture);
    parts.strobe_png = encode_png(picture, PngEffort::kSmall);
    parts.strobe_caption =
        instants.size() == 1
            ? fmt::format("{:.4g} s", instants.front())
            : fmt::format("{:.4g} to {:.4g} s, one every {:.4g} s", instants.front(),
                          instants.back(), instants[1] - instants[0]);
    parts.renderer = painter.renderer();
    for (const auto& [name, effect] : painter.effects())
        parts.effects[name] = {effect.on, effect.why};
}

AccuracyReport measured(const Scene& scene, const ReportWishes& wishes,
                        const CommonOptions& options, const Interrupt& interrupt) {
    AccuracyOptions measure;
    measure.budget_s = wishes.budget_s;
    return measure_accuracy(scene, measure, interrupt.token(), [&](const std::string& what) {
        interrupt.reached("while measuring " + what);
        if (!options.quiet) say("carom: {}\n", readable_message(what));
    });
}

}  // namespace

std::optional<ReportedRun> run_for_report(const std::string& path, const CommonOptions& options,
                                          const ReportWishes& wishes, const Interrupt& interrupt) {
    std::optional<FilmScenes> scenes = load_film_scenes(path, options, {});
    if (!scenes) return std::nullopt;
    Scene& scene = scenes->scene;
    // An MP4 has no transparency; what would be transparent is the sky.
    scene.background = Background::kSky;
    if (scenes->second) scenes->second->background = Background::kSky;
    if (Film& film = scene.film; wishes.width_px > 0 && film.width_px > wishes.width_px) {
        film.height_px = std::max(1, film.height_px * wishes.width_px / film.width_px);
        film.width_px = wishes.width_px;
    }
    if (wishes.accuracy && scene.balls.empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("{} has no balls: there is no motion to measure", path));
    if (wishes.film) check_films({{"film.mp4", "mp4"}}, scene, {});

    ReportedRun run;
    run.result = simulate_shown(scene, interrupt, options.progress_mode());
    std::optional<FilmedSecond> second =
        simulate_second(*scenes, run.result.motion, interrupt, options.progress_mode());
    Stats stats;
    stats.add_warnings(run.result.report, options.quiet);
    stats.add_verdict(scene, run.result.motion, options.quiet);
    Stats::warn_of_unrest(run.result.report, options.quiet);

    run.parts.scene_text = scenes->text;
    run.parts.effects = run.result.report.effects;
    run.parts.versions = library_versions();
    draw(*scenes, run.result, second ? &second->run : nullptr, options, wishes, interrupt,
         run.parts);
    if (wishes.accuracy) run.parts.accuracy = measured(scene, wishes, options, interrupt);
    if (second && same_surfaces(scene, second->run.scene)) run.ghosts = std::move(second->run);
    run.scene = std::move(scene);
    return run;
}

}  // namespace carom
