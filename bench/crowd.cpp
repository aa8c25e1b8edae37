#include "crowd.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "scene/reader.h"

namespace carom {

Scene crowd_scene(const Crowd& crowd) {
    const int side = std::max(1, static_cast<int>(std::ceil(std::sqrt(crowd.balls))));
    const int rows = (crowd.balls + side - 1) / side;
    const double pitch = 2.4 / side;
    const std::string text = fmt::format(
        "carom: 1\nsimulation: {{duration: 2}}\n"
        "looks: {{floor: {{style: checker}}, ball: {{style: striped, color: \"#c8102e\"}}}}\n"
        "surfaces: [{{name: floor, plane: {{}}, look: floor}}]\n"
        "balls: [{{name: a, radius: {}, look: ball, position: [{}, {}, {}],\n"
        "         repeat: {{count: [{}, {}, 1], spacing: {}}}}}]\n"
        "camera: {{from: [0, -4, 1.7], to: [0, 0, 0.2], fov_deg: 36{}}}\n"
        "film: {{size: [{}, {}], fps: {}, shutter_deg: {}}}\n",
        0.3 * pitch, -1.2 + 0.5 * pitch, -0.5 * pitch * rows, 0.35 * pitch + 0.05, side, rows,
        pitch, crowd.moving_camera ? ", orbit_deg_per_s: 20" : "", crowd.width_px, crowd.height_px,
        crowd.fps, crowd.shutter_deg);
    const SceneResult read = read_scene(text, "crowd");
    if (!read.scene) throw Bug("the scene is wrong");
    Scene scene = *read.scene;
    scene.balls.resize(static_cast<std::size_t>(crowd.balls));
    return scene;
}

Motion crowd_motion(const Scene& scene, double speed) {
    Motion motion;
    motion.duration = 2;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const double turn = 2.399963 * static_cast<double>(i);
        Piece piece;
        piece.position = scene.balls[i].position;
        piece.velocity = speed * Vec3(std::cos(turn), std::sin(turn), 0);
        piece.spin = 6 * Vec3(std::sin(turn), std::cos(turn), 0);
        Trajectory path;
        path.append(piece);
        motion.balls.push_back(path);
        motion.ball_names.push_back(scene.balls[i].name);
        motion.peaks.emplace_back();
    }
    return motion;
}

}  // namespace carom
