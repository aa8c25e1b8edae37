#include "cli/film_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cli/progress.h"
#include "cli/standard_error.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/output_file.h"
#include "report/filming.h"
#include "scene/film_clock.h"

namespace carom {

std::vector<OutputRequest> requests(const RenderOptions& options) {
    std::vector<OutputRequest> result;
    for (const std::string& path : options.outputs) result.push_back({path, options.format});
    return result;
}

void Filming::open_layers(const Scene& scene, const Motion& motion, const SecondRun* second) {
    if (!options_.layers.wanted()) return;
    const std::vector<OutputRequest> outputs = requests(options_);
    layers_ = std::make_unique<LayerFiles>(
        scene, motion,
        LayerSettings{scene.film.width_px, scene.film.height_px, options_.layers.kinds(), second},
        layer_index_path(frames_for_layers(outputs), source_.frames, !options_.chunk.empty()),
        options_.common.existing(), Durability::kUnsynced);
    frame_count_ = frame_count(scene.film, motion.duration);
}

void Filming::write_layers(std::int64_t frame, const Film& film) {
    const std::vector<OutputRequest> outputs = requests(options_);
    layers_->write(sequence_path(frames_for_layers(outputs).path, frame), frame,
                   instants_of_frame(film, frame, frame_count_));
}

void Filming::film(Painter& painter) {
    // PNGs are whole or not there; half a film must be closed to be one, and layers want an index.
    std::optional<KeptWork> kept;
    if (has_film() || layers_) kept.emplace(interrupt_, [this] { keep_partial(); });
    try {
        draw_all(painter, kept ? &*kept : nullptr);
    } catch (const Failure&) {
        if (!interrupt_.requested()) throw;  // else it is the simulation that has stopped
    }
    if (done_ < source_.frames.size()) {
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

void Filming::draw_all(Painter& painter, KeptWork* kept) {
    const Film& film = source_.scene.film;
    Progress progress(options_.common.progress_mode(), interrupt_, kFilming, source_.frames.size(),
                      1 / film.fps.per_second());
    FilmingHooks hooks;
    hooks.stops = [this] { return interrupt_.requested(); };
    if (growing_ != nullptr)
        hooks.await = [&](double t) {
            growing_->wait_for(needed_for_picture(source_.scene, t),
                               [&] { progress.update(static_cast<double>(done_)); });
        };
    if (kept != nullptr) hooks.run_drawing = [kept](const auto& draw) { kept->step(draw); };
    FrameRanges::Iterator frame = source_.frames.begin();
    hooks.written = [&](std::int64_t done) {
        if (layers_) {
            kept->step([&] { write_layers(*frame, film); });
            layers_->add_to_index();
        }
        ++frame;
        done_ = done;
        progress.update(static_cast<double>(done));
    };
    film_frames(painter, film, source_.frames, sinks_, hooks);
}

/// Keeps what is playable and says how far it got. Who limits the time wants no parts of films.
void Filming::keep_partial() const {
    interrupt_.reached(fmt::format("after {} of {} frames", done_, source_.frames.size()));
    interrupt_.say();
    for (const auto& sink : sinks_) {
        if (interrupt_.timed_out()) break;
        if (const std::string kept = sink->keep_partial(); !kept.empty())
            say("carom: kept {}\n", readable(kept));
    }
    if (layers_) layers_->finish();
}

}  // namespace carom
