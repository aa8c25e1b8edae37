#include <carom/film.h>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "api/painting.h"
#include "media/film_format.h"
#include "media/frame_sink.h"
#include "media/threaded_sink.h"
#include "report/filming.h"
#include "report/impact_sound.h"
#include "report/layer_files.h"
#include "report/provenance.h"
#include "report/scene_film.h"
#include "scene/film_clock.h"

namespace carom::v1 {

PainterOptions painter_options(const Scene& scene, const std::optional<SecondRun>& second) {
    const carom::Scene& inner = scene.impl().scene;
    PainterOptions options;
    options.width_px = inner.film.width_px;
    options.height_px = inner.film.height_px;
    options.second = second ? &*second : nullptr;
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

/// What the PNG of a frame says, as `carom render` has it.
PngNotes frame_notes(const carom::Scene& scene, const SecondRun* second, std::int64_t number) {
    PngNotes notes = picture_notes(scene, frame_time(scene.film, number));
    if (second != nullptr)
        notes.texts.emplace_back("Against", second_text(second->scene, second->view));
    return notes;
}

std::unique_ptr<FrameSink> make_sink(const carom::Scene& scene, const carom::Motion& motion,
                                     const SecondRun* second, const std::string& path,
                                     const FilmOptions& options) {
    if (find_film_format(path) == nullptr) {
        if (!options.codec.empty() || !options.quality.empty() || options.crf)
            throw Error(path + " is no film: codec, quality and crf mean nothing to PNG frames");
        return make_png_sequence(
            path, options.threads, existing_of(options.overwrite),
            [&scene, second](std::int64_t number) { return frame_notes(scene, second, number); });
    }
    if (!options.layers.empty()) throw Error(path + ": layers are files beside PNG frames");
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

/// Of the frames of `path`; none where none are wanted.
std::unique_ptr<LayerFiles> make_layers(const carom::Scene& scene, const carom::Motion& motion,
                                        const std::optional<SecondRun>& second,
                                        const std::string& path, const FilmOptions& options) {
    const std::vector<LayerKind> kinds = layer_kinds_of(options.layers, second);
    if (kinds.empty()) return nullptr;
    const auto index = std::filesystem::path(sequence_folder(path)) / "layers.json";
    require_writable(index.string(), options.overwrite);
    return std::make_unique<LayerFiles>(scene, motion,
                                        LayerSettings{scene.film.width_px, scene.film.height_px,
                                                      kinds, second ? &*second : nullptr},
                                        index.string(), existing_of(options.overwrite),
                                        Durability::kSynced);
}

}  // namespace

std::int64_t film(const Scene& scene, const Motion& motion, const std::string& path,
                  const FilmOptions& options, const Control& control) {
    return translated(control, [&] {
        const carom::Scene& inner = scene.impl().scene;
        const carom::Motion& moves = motion.impl().motion;
        require_own_motion(scene, motion);
        const std::optional<SecondRun> second =
            run_to_show(scene, motion, options.against, control);
        std::vector<std::unique_ptr<FrameSink>> sinks;
        sinks.push_back(make_sink(inner, moves, second ? &*second : nullptr, path, options));
        const std::unique_ptr<LayerFiles> layers = make_layers(inner, moves, second, path, options);
        Painter painter(inner, moves, painter_options(scene, second));
        const FrameRanges frames = FrameRanges::all(frame_count(inner.film, motion.duration()));
        FilmingHooks hooks;
        hooks.stops = [&control] { return control.stop.stop_requested(); };
        hooks.written = [&](std::int64_t done) {
            if (layers) {
                layers->write(sequence_path(path, done - 1), done - 1,
                              instants_of_frame(inner.film, done - 1, frames.size()));
                layers->add_to_index();
            }
            if (control.progress) control.progress(static_cast<double>(done));
        };
        const std::int64_t done = film_frames(painter, inner.film, frames, sinks, hooks);
        if (layers) layers->finish();
        if (done < frames.size())
            throw Stopped(fmt::format("stopped after {} of {} frames", done, frames.size()));
        sinks.front()->finish();
        return done;
    });
}

}  // namespace carom::v1
