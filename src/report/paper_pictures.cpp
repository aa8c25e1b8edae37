#include "report/paper_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/failure.h"
#include "media/frame_sink.h"
#include "media/threaded_sink.h"
#include "render/painter.h"
#include "report/embedded_scenes.h"
#include "report/filming.h"
#include "scene/film_clock.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {

PaperRun run_paper_scene(const std::string& name, const std::stop_token& stop) {
    SceneResult read = read_scene(embedded_scene(name), "scenes/" + name + ".yaml");
    for (const Diagnostic& d : read.diagnostics.items())
        if (d.severity == Severity::kError) throw Bug("a scene inside the program: " + d.text());
    PaperRun run{std::move(*read.scene), {}};
    // The heights of Figure 8 are to be exact, whatever the scene's default.
    run.scene.simulation.method = Method::kExact;
    run.motion = simulate(run.scene, stop).motion;
    return run;
}

void film_motion(const PaperRun& run, const std::string& path, Existing existing,
                 const std::stop_token& stop) {
    const Film& film = run.scene.film;
    FilmOptions options;
    options.width_px = film.width_px;
    options.height_px = film.height_px;
    options.fps_numerator = film.fps.numerator;
    options.fps_denominator = film.fps.denominator;
    options.title = run.scene.title;
    options.existing = existing;
    std::vector<std::unique_ptr<FrameSink>> sinks;
    sinks.push_back(make_threaded_sink(make_film_writer(path, options), 1));
    Painter painter(run.scene, run.motion, {film.width_px, film.height_px});
    const FrameRanges frames = FrameRanges::all(frame_count(film, run.motion.duration));
    FilmingHooks hooks;
    hooks.stops = [&stop] { return stop.stop_requested(); };
    if (film_frames(painter, film, frames, sinks, hooks) < frames.size()) {
        sinks.front()->keep_partial();
        throw Failure(FailureKind::kRun, "interrupted while filming " + path);
    }
    sinks.front()->finish();
}

Image figure8_picture(const PaperRun& run) {
    constexpr double kBetween_s = 0.1;
    std::vector<double> instants;
    CAROM_CHECK(run.motion.events.empty(), ==, false);
    const double impact = run.motion.events.front().time;
    for (double k = 0; k * kBetween_s <= impact; ++k) instants.push_back(k * kBetween_s);
    const Film& film = run.scene.film;
    Painter painter(run.scene, run.motion, {film.width_px, film.height_px});
    Image picture;
    painter.paint_strobe(instants, picture);
    return picture;
}

Image figure9_montage(PaperRun run) {
    constexpr std::array kInstants = {0.0, 0.3, 0.6, 0.9, 1.4, 3.0};  // s
    constexpr int kColumns = 3, kRows = 2, kWidth = 480, kHeight = 270, kGap = 4;
    static_assert(kInstants.size() == kColumns * kRows);
    run.scene.overlay.labels.reset();  // too small to read at this size
    Painter painter(run.scene, run.motion, {kWidth, kHeight});
    Image montage(kColumns * kWidth + (kColumns - 1) * kGap, kRows * kHeight + (kRows - 1) * kGap);
    std::fill(montage.bgra.begin(), montage.bgra.end(), std::uint8_t{255});
    Image picture;
    for (int i = 0; i < kColumns * kRows; ++i) {
        painter.paint(kInstants[static_cast<std::size_t>(i)], picture);
        const int x = i % kColumns * (kWidth + kGap), y = i / kColumns * (kHeight + kGap);
        for (int row = 0; row < kHeight; ++row)
            std::copy_n(picture.row(row), picture.stride_bytes(), montage.row(y + row) + 4 * x);
    }
    return montage;
}

}  // namespace carom
