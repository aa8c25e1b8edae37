#include "sim/pipe_halves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

/// Whether a ball can touch both edges: where the wall goes less than half around, one that is
/// larger than the pipe, else one that is too large for the opening.
bool can_span(const PipeShape& pipe, double radius) {
    if (pipe.is_tube()) return false;
    const double half = 0.5 * pipe.angle;
    const double room = half > 0.5 * std::numbers::pi ? std::sin(half) : 1;
    return radius > room * pipe.radius;
}

/// The half on one side of the middle.
PipeShape half_of(const PipeShape& pipe, double side) {
    const Vec3 axis = (pipe.to - pipe.from).normalized();
    PipeShape half = pipe;
    half.angle = 0.5 * pipe.angle;
    half.opening = Eigen::AngleAxisd(side * 0.25 * pipe.angle, axis) * pipe.opening;
    return half;
}

}  // namespace

HalvedScene with_pipe_halves(const Scene& scene) {
    HalvedScene halved;
    const auto is_split = [&scene](const Surface& surface) {
        const auto* pipe = std::get_if<PipeShape>(&surface.shape);
        return pipe != nullptr &&
               std::any_of(scene.balls.begin(), scene.balls.end(),
                           [&](const Ball& ball) { return can_span(*pipe, ball.radius); });
    };
    if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(), is_split)) return halved;
    halved.scene = scene;
    halved.scene.surfaces.clear();
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& surface = scene.surfaces[i];
        const bool split = is_split(surface);
        for (const double side : split ? std::vector{-1.0, 1.0} : std::vector{0.0}) {
            Surface& part = halved.scene.surfaces.emplace_back(surface);
            if (split) part.shape = half_of(std::get<PipeShape>(surface.shape), side);
            halved.whole.push_back(static_cast<int>(i));
        }
    }
    return halved;
}

void make_whole(Motion& motion, const Scene& scene, const std::vector<int>& whole) {
    motion.surface_names.clear();
    for (const Surface& surface : scene.surfaces) motion.surface_names.push_back(surface.name);
    for (Event& event : motion.events)
        if (event.other.is_surface)
            event.other.index = whole[static_cast<std::size_t>(event.other.index)];
}

}  // namespace carom
