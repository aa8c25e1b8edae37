// What each feature of a picture costs: CPU milliseconds a frame, with and without it, and what is
// paid once. The same scene throughout; the median over the frames of a film, the driver's threads
// counted in. usage: frame_cost [FRAMES]
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/check.h"
#include "render/painter.h"
#include "render/runs/second_run.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {
namespace {

/// What a scene has besides three plain balls over a plain floor.
struct Feature {
    const char* name;
    const char* effect = "";  ///< of Painter::effects() that must be on
    const char* floor = "{style: plain}";
    const char* ball = "plain";
    const char* body = "";
    const char* camera = "";
    const char* overlay = "";
    const char* film = "";
    const char* background = "sky";
    bool against = false;  ///< shows the motion of a coarse step beside it, as ghosts
};

constexpr const char* kBox =
    "  - {name: box, box: {position: [0.3, 1, 0.2], size: [1, 0.4, 0.4]}, material: ground}\n";
constexpr const char* kTurning = ", orbit_deg_per_s: 5";
constexpr const char* kEverything =
    "ruler: true, clock: true, labels: true, trail: true, title: true, peaks: true, velocity: "
    "true, "
    "plot: true";

std::vector<Feature> features() {
    return {
        {.name = "plain scene"},
        {.name = "markings (basketball)", .effect = "markings", .ball = "basketball"},
        {.name = "box to pass behind", .effect = "occlusion", .body = kBox},
        {.name = "checker", .floor = "{style: checker}"},
        {.name = "wood", .floor = "{style: wood}"},
        {.name = "court", .floor = "{style: court}"},
        {.name = "reflection", .effect = "reflection", .floor = "{reflection: 0.5}"},
        {.name = "ruler", .effect = "ruler", .overlay = "ruler: true"},
        {.name = "clock", .effect = "clock", .overlay = "clock: true"},
        {.name = "labels", .effect = "labels", .overlay = "labels: true"},
        {.name = "trail", .effect = "trail", .overlay = "trail: true"},
        {.name = "fading trail", .effect = "trail", .overlay = "trail: {seconds: 0.5}"},
        {.name = "title", .effect = "title", .overlay = "title: true"},
        {.name = "caption", .effect = "caption", .overlay = "caption: \"A line of text\""},
        {.name = "peaks", .effect = "peaks", .overlay = "peaks: true"},
        {.name = "velocity arrows", .effect = "velocity", .overlay = "velocity: true"},
        {.name = "plot", .effect = "plot", .overlay = "plot: true"},
        {.name = "all of the overlay", .effect = "plot", .overlay = kEverything},
        {.name = "ghosts of a second run", .effect = "against", .against = true},
        {.name = "motion blur, 90 degrees", .effect = "motion_blur", .film = ", shutter_deg: 90"},
        {.name = "motion blur, 180 degrees", .effect = "motion_blur", .film = ", shutter_deg: 180"},
        {.name = "transparent", .effect = "transparent", .background = "transparent"},
        {.name = "moving camera", .camera = kTurning},
        {.name = "moving camera, box", .effect = "occlusion", .body = kBox, .camera = kTurning},
        {.name = "moving camera, overlay",
         .effect = "plot",
         .camera = kTurning,
         .overlay = kEverything},
    };
}

std::string scene_text(const Feature& feature) {
    return fmt::format(
        "carom: 1\ntitle: What a frame costs\nsimulation: {{duration: 2.0}}\n"
        "materials: {{ground: {{friction: 1}}, rubber: {{restitution: 0.85, friction: 0.5}}}}\n"
        "looks:\n  floor: {}\n"
        "  ball: {{style: {}, color: \"#cf6526\", second_color: \"#1b1614\"}}\n"
        "surfaces:\n  - {{name: floor, plane: {{}}, material: ground, look: floor}}\n{}"
        "defaults: {{ball: {{radius: 0.12, material: rubber, look: ball}}}}\n"
        "balls:\n  - {{name: left, position: [-0.9, 0, 1.3]}}\n"
        "  - {{name: middle, position: [0, 0, 0.9], velocity: [0.4, 0, 0]}}\n"
        "  - {{name: right, position: [0.9, 0, 1.1], spin: [0, 8, 0]}}\n"
        "camera: {{from: [0, -5, 1.4], to: [0, 0, 0.7], fov_deg: 34{}}}\n"
        "film: {{size: [1280, 720], fps: 60{}}}\nbackground: {}\noverlay: {{{}}}\n",
        feature.floor, feature.ball, feature.body, feature.camera, feature.film, feature.background,
        feature.overlay);
}

struct Cost {
    double once_ms = 0;   ///< until the first frame is there
    double frame_ms = 0;  ///< median of the others
    std::set<std::string> effects;
};

Cost cost_of(const Feature& feature, int frames) {
    const SceneResult read = read_scene(scene_text(feature), feature.name);
    if (!read.scene) throw Bug(fmt::format("{}: the scene is wrong", feature.name));
    const Scene& scene = *read.scene;
    const SimulationResult simulated = simulate(scene);
    std::optional<SecondRun> second;
    if (feature.against) {
        Scene coarse = scene;
        coarse.simulation.method = Method::kFixed;
        coarse.simulation.step = 0.01;
        const Motion motion = simulate(coarse).motion;
        second.emplace();
        second->scene = coarse;
        second->motion = motion;
        second->ended_s = motion.duration;
        second->first_name = "exact";
        second->second_name = "fixed";
    }
    Painter painter(scene, simulated.motion,
                    {.width_px = scene.film.width_px,
                     .height_px = scene.film.height_px,
                     .second = second ? &*second : nullptr});
    Image picture;
    Cost cost;
    std::vector<double> each;
    double before = 0;
    for (int k = 0; k < frames; ++k) {
        painter.paint_next(0.5 + 1.4 * k / frames, picture);
        const double now = painter.draw_cpu_s() + painter.read_cpu_s();
        (k == 0 ? cost.once_ms : each.emplace_back()) = 1000 * (now - before);
        before = now;
    }
    std::nth_element(each.begin(), each.begin() + frames / 2, each.end());
    cost.frame_ms = each[static_cast<std::size_t>(frames / 2)];
    const auto effects = painter.effects();
    for (const auto& [name, effect] : effects)
        if (effect.on) cost.effects.insert(name);
    if (*feature.effect != '\0' && cost.effects.count(feature.effect) == 0)
        throw Bug(fmt::format("{}: the effect {} is off", feature.name, feature.effect));
    return cost;
}

int run(int frames) {
    fmt::print("{:<24}{:>12}{:>10}{:>10}  effects\n", "feature", "ms a frame", "more", "once, ms");
    cost_of(Feature{.name = "warm-up"}, frames);
    std::optional<Cost> plain;
    for (const Feature& feature : features()) {
        const Cost cost = cost_of(feature, frames);
        if (!plain) plain = cost;
        std::vector<std::string> added;
        std::set_difference(cost.effects.begin(), cost.effects.end(), plain->effects.begin(),
                            plain->effects.end(), std::back_inserter(added));
        fmt::print("{:<24}{:>12.2f}{:>+10.2f}{:>10.0f}  {}\n", feature.name, cost.frame_ms,
                   cost.frame_ms - plain->frame_ms, cost.once_ms, fmt::join(added, ", "));
    }
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 60;
    if (frames < 3) {
        fmt::print(stderr, "usage: frame_cost [FRAMES], at least 3\n");
        return 2;
    }
    return carom::run(frames);
}
