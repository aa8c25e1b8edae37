#include "sweep/runs/run_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "core/failure.h"
#include "media/frame_sink.h"
#include "media/output_folder.h"
#include "media/png.h"
#include "media/text_file.h"
#include "motion/csv.h"
#include "render/gl/offscreen.h"
#include "report/filming.h"
#include "report/layer_files.h"
#include "report/provenance.h"
#include "report/run_json.h"
#include "report/scene_film.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

void write_rows(const std::string& path, const std::function<void(const TextSink&)>& write) {
    std::string text;
    write([&text](std::string_view part) { text += part; });
    write_text_file(path, text, Durability::kUnsynced);
}

std::string stats_text(const SimulationResult& simulated) {
    nlohmann::ordered_json json = {{"steps", simulated.report.steps},
                                   {"impacts", simulated.report.impacts}};
    json["effects"] = effects_json(simulated.report.effects);
    json["motion_hash"] = fmt::format("{:016x}", simulated.motion.hash());
    json["balls"] = peaks_json(simulated.motion);
    return json.dump(2) + "\n";
}

/// A key a line, entries of lists of bodies likewise.
std::string scene_text(const Node& root) {
    std::string text;
    for (const Node& section : root.children) {
        const bool bodies = section.kind == Node::Kind::kList && !section.children.empty() &&
                            section.children.front().kind == Node::Kind::kMap;
        if (!bodies) {
            text += section.key + ": " + flow_text(section) + "\n";
            continue;
        }
        text += section.key + ":\n";
        for (const Node& body : section.children) text += "  - " + flow_text(body) + "\n";
    }
    return text;
}

/// One thread: others work on other runs, and a film is the same however many there are.
FilmOptions film_options(const SweepOutputs& outputs, const Scene& scene) {
    FilmOptions film = film_options_of(scene);
    film.quality = outputs.quality;
    if (outputs.quality == "medium") film.quality.reset();  // which not all kinds of films have
    film.threads = 1;
    film.comment = made_from(scene);
    return film;
}

std::string film_path(const std::string& folder, const SweepOutputs& outputs) {
    return folder + "/film." + outputs.film;
}

/// Film, frames and layers in one go, then stills.
class RunPictures {
  public:
    RunPictures(const RunContents& run, const std::string& folder,
                const std::shared_ptr<DrawingContexts>& contexts, const std::stop_token& stop)
        : run_(run), folder_(folder), stop_(stop) {
        PainterOptions options;
        options.width_px = run.scene.film.width_px;
        options.height_px = run.scene.film.height_px;
        options.contexts = contexts;
        const SweepOutputs& out = run.outputs;
        if (out.frames || !out.film.empty() || out.stills)
            painter_.emplace(run.scene, run.simulated.motion, options);
    }

    void write() {
        const SweepOutputs& out = run_.outputs;
        if (out.frames || !out.layers.empty()) prepare_folder(folder_ + "/frames");
        if (out.frames || !out.film.empty()) write_frames();
        if (!out.layers.empty()) write_layers();
        if (out.stills) write_stills();
    }

  private:
    double duration() const { return run_.simulated.motion.duration; }

    void write_frames() {
        const Scene& scene = run_.scene;
        std::vector<std::unique_ptr<FrameSink>> sinks;
        if (run_.outputs.frames)
            sinks.push_back(make_png_sequence(
                folder_ + "/frames", 1, Existing::kReplace, [&scene](std::int64_t number) {
                    return picture_notes(scene, frame_time(scene.film, number));
                }));
        if (!run_.outputs.film.empty())
            sinks.push_back(make_film_writer(film_path(folder_, run_.outputs),
                                             film_options(run_.outputs, scene)));
        FilmingHooks hooks;
        hooks.stops = [this] { return stop_.stop_requested(); };
        film_frames(*painter_, scene.film, FrameRanges::all(frame_count(scene.film, duration())),
                    sinks, hooks);
        if (stop_.stop_requested()) return;
        for (const auto& sink : sinks) sink->finish();
    }

    void write_layers() {
        const Film& film = run_.scene.film;
        LayerFiles layers(run_.scene, run_.simulated.motion,
                          {film.width_px, film.height_px, run_.outputs.layers, nullptr},
                          folder_ + "/frames/layers.json", Existing::kReplace,
                          Durability::kUnsynced);
        const std::int64_t count = frame_count(film, duration());
        for (std::int64_t frame = 0; frame < count && !stop_.stop_requested(); ++frame) {
            layers.write(sequence_path(folder_ + "/frames", frame), frame,
                         instants_of_frame(film, frame, count));
            layers.add_to_index();
        }
        layers.finish();
    }

    void write_stills() {
        const std::vector<double>& own = run_.outputs.still_times;
        const std::vector<double>& times = own.empty() ? run_.scene.film.stills : own;
        Image picture;
        for (std::size_t i = 0; i < times.size() && !stop_.stop_requested(); ++i) {
            if (times[i] > duration())
                throw Failure(
                    FailureKind::kRun,
                    fmt::format("no still at {} s: the motion ends at {} s", times[i], duration()));
            painter_->paint(times[i], picture);
            write_png(fmt::format("{}/still_{:03}.png", folder_, i), picture, PngEffort::kSmall,
                      Durability::kUnsynced, Existing::kReplace,
                      picture_notes(run_.scene, times[i]));
        }
    }

    const RunContents& run_;
    const std::string& folder_;
    const std::stop_token& stop_;
    std::optional<Painter> painter_;
};

}  // namespace

std::shared_ptr<DrawingContexts> make_contexts() { return std::make_shared<DrawingContexts>(); }

void write_run_files(const RunContents& run, const std::string& folder,
                     const std::shared_ptr<DrawingContexts>& contexts,
                     const std::stop_token& stop) {
    const SweepOutputs& out = run.outputs;
    const Motion& motion = run.simulated.motion;
    const FrameRate& fps = run.scene.film.fps;
    if (out.scene)
        write_text_file(folder + "/scene.yaml", scene_text(run.root), Durability::kUnsynced);
    if (out.motion)
        write_rows(folder + "/motion.csv", [&](const TextSink& sink) {
            write_motion_csv(motion, fps.numerator, fps.denominator, sink);
        });
    if (out.events)
        write_rows(folder + "/events.csv",
                   [&](const TextSink& sink) { write_events_csv(motion, sink); });
    if (out.stats)
        write_text_file(folder + "/stats.json", stats_text(run.simulated), Durability::kUnsynced);
    if (out.pictures()) RunPictures(run, folder, contexts, stop).write();
}

void require_run_files(const SweepOutputs& outputs, const Scene& scene) {
    if (!outputs.film.empty()) require_film(film_path(".", outputs), film_options(outputs, scene));
    if (!outputs.layers.empty()) require_layer_libraries(outputs.layers);
}

}  // namespace carom
