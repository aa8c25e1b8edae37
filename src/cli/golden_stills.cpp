#include "cli/golden_stills.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "cli/against.h"
#include "cli/interrupt.h"
#include "cli/short_lived.h"
#include "cli/shown_simulation.h"
#include "core/failure.h"
#include "golden/golden_name.h"
#include "render/gl/offscreen.h"
#include "render/painter.h"

namespace carom {

namespace fs = std::filesystem;

void GoldenNames::add_scene(const std::string& scene) {
    const auto [first, fresh] = scenes_.emplace(scene_stem(scene), scene);
    std::error_code error;
    if (fresh || first->second == scene || fs::equivalent(first->second, scene, error)) return;
    throw Failure(FailureKind::kInput,
                  fmt::format("{} and {} have one name: the goldens of both would be {}-t*.png",
                              first->second, scene, scene_stem(scene)));
}

void GoldenNames::add_time(const std::string& golden, double time) {
    const auto [first, fresh] = times_.emplace(golden, time);
    if (fresh || first->second == time) return;
    throw Failure(FailureKind::kInput, fmt::format("the stills at {} s and {} s have one name, "
                                                   "{}: names have 6 decimals",
                                                   first->second, time, golden));
}

GoldenStills::GoldenStills(const GoldenOptions& options, const Interrupt& interrupt)
    : options_(options), interrupt_(interrupt) {
    for (const std::string& scene : options.scenes) names_.add_scene(scene);
    if (options.scenes.empty()) return;
    const std::string stem = scene_stem(options.scenes.front());
    for (const double time : options.times)
        names_.add_time(golden_path(options.folder, still_name(stem, time)), time);
}

bool GoldenStills::for_each(const std::string& path, const Use& use) {
    const GoldenOptions& options = options_;
    const std::optional<FilmScenes> scenes = load_film_scenes(path, options.common, {});
    if (!scenes) return false;
    const Scene* scene = &scenes->scene;
    const std::vector<double>& times = options.times.empty() ? scene->film.stills : options.times;
    if (times.empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("{}: no stills: name them with film.stills or --time", path));
    const auto name_at = [&path](double time) { return still_name(scene_stem(path), time); };
    for (const double time : times)
        names_.add_time(golden_path(options.folder, name_at(time)), time);
    const ProgressMode mode = options.common.progress_mode();
    const SimulationResult simulated = simulate_shown(*scene, interrupt_, mode);
    const std::optional<FilmedSecond> second =
        simulate_second(*scenes, simulated.motion, interrupt_, mode);
    interrupt_.reached(fmt::format("after {} stills", done_.size()));
    PainterOptions painting;
    painting.width_px = scene->film.width_px;
    painting.height_px = scene->film.height_px;
    painting.second = second ? &second->run : nullptr;
    painting.few_pictures =
        draws_sooner_than_it_compiles(painting.width_px, painting.height_px, times.size());
    if (!contexts_) {
        if (painting.few_pictures) prefer_quick_compile();
        contexts_ = std::make_shared<DrawingContexts>();
    }
    painting.contexts = contexts_;
    Painter painter(*scene, simulated.motion, painting);
    Image picture;
    for (const double time : times) {
        if (!(time >= 0 && time <= simulated.motion.duration))
            throw Failure(FailureKind::kInput,
                          fmt::format("{}: no instant {} s: the motion ends at {} s", path, time,
                                      simulated.motion.duration));
        painter.paint(time, picture);
        interrupt_.check();
        const std::string name = name_at(time);
        use({name, path, time, options.folder, golden_path(options.folder, name),
             painter.renderer()},
            picture);
        done_.push_back(name);
        interrupt_.reached(fmt::format("after {} stills", done_.size()));
    }
    return true;
}

}  // namespace carom
