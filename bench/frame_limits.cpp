// What a frame may cost at most: CPU milliseconds of drawing and reading it, the driver's threads
// counted in, beside the limit; of motion blur, also how far the picture is from the mean of many
// instants. usage: frame_limits [FRAMES [PART-OF-A-ROW]]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/check.h"
#include "crowd.h"
#include "render/blend/srgb.h"
#include "render/painter.h"
#include "render/view/exposure.h"
#include "scene/film_clock.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {
namespace {

struct Filmed {
    Scene scene;
    Motion motion;
};

Filmed filmed(Scene scene) {
    Motion motion = simulate(scene).motion;
    return {std::move(scene), std::move(motion)};
}

Filmed from_file(const std::string& name, const std::vector<Override>& overrides) {
    const SceneResult read = read_scene_file(CAROM_SOURCE_DIR "/scenes/" + name, overrides);
    if (!read.scene) throw Bug(name + ": the scene is wrong");
    return filmed(*read.scene);
}

/// Five balls over a floor, with shadows.
Filmed five_balls(const std::string& floor, const std::string& balls, const std::string& camera,
                  const std::string& overlay) {
    const auto preset = [&](const char* name) {
        return balls.empty() ? fmt::format("preset: {}", name) : balls;
    };
    const std::string text = fmt::format(
        "carom: 1\nsimulation: {{duration: 3.0}}\n"
        "materials: {{steel: {{restitution: 1}}, rubber: {{restitution: 0.85}}}}\n"
        "looks: {{floor: {{style: {}}}, ball: {{color: \"#c8102e\"}}}}\n"
        "surfaces: [{{name: floor, plane: {{}}, material: steel, look: floor}}]\n"
        "balls:\n"
        "  - {{name: a, {}, drop_height: 1.5, at: [-1.2, 0.3], spin: [0, 0, 2]}}\n"
        "  - {{name: b, {}, drop_height: 1.4, at: [-0.6, 0.3], spin: [0, 0, -2]}}\n"
        "  - {{name: c, {}, drop_height: 1.3, at: [0, 0.3], spin: [0, 0, 2]}}\n"
        "  - {{name: d, {}, drop_height: 1.2, at: [0.6, 0.3], spin: [0, 0, -6]}}\n"
        "  - {{name: e, {}, drop_height: 1.1, at: [1.2, 0.3], spin: [0, 0, 9]}}\n"
        "camera: {{from: [0, -5.6, 1.8], to: [0, 0, 0.70], fov_deg: 27{}}}\n"
        "film: {{fps: 60}}\noverlay: {{{}}}\n",
        floor, preset("basketball"), preset("volleyball"), preset("football"), preset("tennis"),
        preset("table_tennis"), camera, overlay);
    const SceneResult read = read_scene(text, "five balls");
    if (!read.scene) throw Bug("the scene is wrong");
    return filmed(*read.scene);
}

Filmed crowd(int balls) {
    constexpr double kSpeed = 0.5;
    const Scene scene = crowd_scene({.balls = balls});
    return {scene, crowd_motion(scene, kSpeed)};
}

/// Median of the frames, the first left out.
double frame_ms(const Filmed& film, int width_px, int height_px, int frames) {
    Painter painter(film.scene, film.motion, {.width_px = width_px, .height_px = height_px});
    Image picture;
    std::vector<double> each;
    double before = 0;
    for (int k = 0; k <= frames; ++k) {
        painter.paint_next(frame_time(film.scene.film, 20 + k), picture);
        const double now = painter.draw_cpu_s() + painter.read_cpu_s();
        if (k > 0) each.push_back(1000 * (now - before));
        before = now;
    }
    std::nth_element(each.begin(), each.begin() + frames / 2, each.end());
    return each[static_cast<std::size_t>(frames / 2)];
}

/// The largest difference of a blurred picture, in codes of 255, from the mean of many instants.
int blur_error(const Filmed& film, int width_px, int height_px, std::int64_t frame) {
    constexpr int kMany = 512;
    const double t = frame_time(film.scene.film, frame);
    const PainterOptions size{.width_px = width_px, .height_px = height_px};
    Image picture, one;
    Painter(film.scene, film.motion, size).paint(t, picture);
    Scene sharp = film.scene;
    sharp.film.shutter_deg = 0;
    Painter painter(sharp, film.motion, size);
    std::vector<double> sum(picture.bgra.size());
    for (const double instant :
         exposure_instants(Exposure(film.scene.film, film.motion.duration, t), kMany)) {
        painter.paint(instant, one);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += srgb_decoding()[one.bgra[i]];
    }
    // Writing stays sharp in the picture, but a label goes with its ball in the mean: such pixels
    // are left out by having no overlay in the scene.
    int largest = 0;
    for (std::size_t i = 0; i < sum.size(); ++i)
        largest =
            std::max(largest, std::abs(int{srgb_encoder()(sum[i] / kMany)} - int{picture.bgra[i]}));
    return largest;
}

int run(int frames, const std::string& part) {
    const std::string all = "ruler: true, clock: true, labels: true";
    const std::string turning = ", orbit_deg_per_s: 20";
    const auto row = [&](const std::string& what, const Filmed& film, int width, int height,
                         int limit) {
        if (what.find(part) == std::string::npos) return;
        fmt::print("{:<46}{:>5}x{:<5}{:>9.2f}{:>8}\n", what, width, height,
                   frame_ms(film, width, height, frames), limit);
        std::fflush(stdout);
    };
    fmt::print("{:<46}{:>11}{:>9}{:>8}\n", "", "size", "CPU ms", "limit");
    row("Figure 9, all looks, shadows, overlay", from_file("figure9.yaml", {}), 1920, 1080, 4);
    row("five plain balls, no overlay",
        five_balls("plain", "radius: 0.12, material: rubber", "", ""), 1920, 1080, 2);
    for (const char* floor : {"plain", "checker"}) {
        const Filmed film = five_balls(floor, "", turning, all);
        const std::string what = fmt::format("moving camera, five balls, {} floor, overlay", floor);
        row(what, film, 1920, 1080, 14);
        row(what, film, 1280, 720, 6);
    }
    row("100 striped balls", crowd(100), 1280, 720, 6);
    row("1,000 striped balls", crowd(1000), 1280, 720, 25);
    row("10,000 striped balls", crowd(10000), 1280, 720, 150);
    const std::vector<Override> open = {{"film.shutter_deg", "180"}};
    row("motion blur 180 degrees, gallery/motion_blur", from_file("gallery/motion_blur.yaml", open),
        1280, 720, 12);

    if (!part.empty()) return EXIT_SUCCESS;
    std::vector<Override> no_overlay = open;
    no_overlay.insert(
        no_overlay.end(),
        {{"overlay.clock", "false"}, {"overlay.labels", "false"}, {"overlay.caption", "\"\""}});
    const Filmed blurred = from_file("gallery/motion_blur.yaml", no_overlay);
    int largest = 0;
    for (const std::int64_t frame : {6, 11, 12, 24, 40})
        largest = std::max(largest, blur_error(blurred, 1280, 720, frame));
    fmt::print("{:<46}{:>5}x{:<5}{:>9}{:>8}\n", "its largest difference from 512 instants, of 255",
               1280, 720, largest, 8);
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 40;
    if (frames < 3) {
        fmt::print(stderr, "usage: frame_limits [FRAMES [PART-OF-A-ROW]], at least 3 frames\n");
        return 2;
    }
    return carom::run(frames, argc > 2 ? argv[2] : "");
}
