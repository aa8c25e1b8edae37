#include <carom/film.h>
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "api/painting.h"
#include "media/film_format.h"
#include "media/frame_sink.h"
#include "media/threaded_sink.h"
#include "report/filming.h"
#include "report/impact_sound.h"
#include "report/provenance.h"
#include "report/scene_film.h"
#include "scene/film_clock.h"

namespace carom::v1 {

PainterOptions painter_options(const Scene& scene, const Motion& motion) {
    const carom::Scene& inner = scene.impl().scene;
    if (inner.against)
        throw Error(
            "this scene shows a second run (against), which `carom render` draws and the "
            "library does not: take the key away");
    if (motion.balls() != scene.balls() || motion.surfaces() != scene.surfaces())
        throw Error("this is the motion of another scene");
    PainterOptions options;
    options.width_px = inner.film.width_px;
    options.height_px = inner.film.height_px;
    return options;
}

namespace {

constexpr int kWaitingFrames = 1;  // between drawing and encoding, as the program has

carom::FilmOptions film_options(const carom::Scene& scene, const FilmOptions& options) {
    carom::FilmOptions film = carom::film_options_of(scene);
    film.codec = options.codec;
    if (!options.quality.empty()) film.quality = options.quality;
    film.crf = options.crf;
    film.threads = options.threads;
    film.sound.wanted = scene.film.sound;
    film.comment = made_from(scene);
    film.existing = existing_of(options.overwrite);
    return film;
}

std::unique_ptr<FrameSink> make_sink(const carom::Scene& scene, const carom::Motion& motion,
                                     const std::string& path, const FilmOptions& options) {
    if (find_film_format(path) == nullptr) {
        if (!options.codec.empty() || !options.quality.empty() || options.crf)
            throw Error(path + " is no film: codec, quality and crf mean nothing to PNG frames");
        return make_png_sequence(path, options.threads, existing_of(options.overwrite),
                                 [&scene](std::int64_t number) {
                                     return picture_notes(scene, frame_time(scene.film, number));
                                 });
    }
    carom::FilmOptions film = film_options(scene, options);
    require_writable(path, options.overwrite);
    require_film(path, film);
    SoundSamples sound;
    if (scene.film.sound && film_format(path).sound != nullptr) {
        sound = impact_sound(scene, motion);
        film.sound.samples = &sound;
    }
    return make_threaded_sink(make_film_writer(path, film), kWaitingFrames);
}

}  // namespace

std::int64_t film(const Scene& scene, const Motion& motion, const std::string& path,
                  const FilmOptions& options, const Control& control) {
    return translated(control, [&] {
        const carom::Scene& inner = scene.impl().scene;
        const PainterOptions painting = painter_options(scene, motion);
        std::vector<std::unique_ptr<FrameSink>> sinks;
        sinks.push_back(make_sink(inner, motion.impl().motion, path, options));
        Painter painter(inner, motion.impl().motion, painting);
        const FrameRanges frames = FrameRanges::all(frame_count(inner.film, motion.duration()));
        FilmingHooks hooks;
        hooks.stops = [&control] { return control.stop.stop_requested(); };
        hooks.written = [&control](std::int64_t done) {
            if (control.progress) control.progress(static_cast<double>(done));
        };
        const std::int64_t done = film_frames(painter, inner.film, frames, sinks, hooks);
        if (done < frames.size())
            throw Stopped(fmt::format("stopped after {} of {} frames", done, frames.size()));
        sinks.front()->finish();
        return done;
    });
}

}  // namespace carom::v1
