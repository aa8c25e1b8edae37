// What the method `exact` costs for one ball on one contact without a closed form, in CPU time per
// second of that contact: smooth on a sphere, smooth on a capsule, rolling along a capsule, and
// with a slip that turns on a slope. Prints a table; each number is the best of a few runs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "clock.h"
#include "scene/scene.h"
#include "sim/simulate.h"

namespace {

using namespace carom;
using bench::cpu_seconds;

Scene scene_with(const SurfaceShape& shape, double friction, const Vec3& position,
                 const Vec3& velocity) {
    Scene scene;
    scene.simulation.method = Method::kExact;
    scene.materials.resize(2);
    scene.materials[1].name = "grip";
    if (friction > 0) scene.materials[1].friction = std::sqrt(friction);
    Surface surface;
    surface.name = "surface";
    surface.shape = shape;
    surface.material = 1;
    scene.surfaces.push_back(surface);
    Ball ball;
    ball.name = "ball";
    ball.material = 1;
    ball.position = position;
    ball.velocity = velocity;
    scene.balls.push_back(ball);
    return scene;
}

/// `duration` [s]: as long as the contact lasts, or less.
void measure(const char* name, Scene scene, double duration) {
    scene.simulation.duration = duration;
    double best = 1e300;
    std::size_t pieces = 0, leaves = 0;
    double spent = 0;
    for (int i = 0; i < 3 || (spent < 0.2 && i < 200); ++i) {
        const double start = cpu_seconds();
        const SimulationResult r = simulate(scene);
        const double seconds = cpu_seconds() - start;
        spent += seconds;
        best = std::min(best, seconds);
        pieces = r.motion.balls[0].pieces().size();
        leaves = static_cast<std::size_t>(
            std::count_if(r.motion.events.begin(), r.motion.events.end(),
                          [](const Event& e) { return e.kind == EventKind::kLeave; }));
    }
    fmt::print("{:<40} {:10.4f} ms a second   {:8.0f} pieces a second   ({} departures)\n", name,
               1e3 * best / duration, static_cast<double>(pieces) / duration, leaves);
}

}  // namespace

int main() {
    const double a = 1 * M_PI / 180;
    measure("smooth on a sphere",
            scene_with(SphereShape{Vec3::Zero(), 0.9}, 0, Vec3(std::sin(a), 0, std::cos(a)),
                       Vec3::Zero()),
            1.45);
    measure("smooth on a capsule, obliquely",
            scene_with(CapsuleShape{Vec3(-1, 0, 0), Vec3(9, 0, 0), 0.9}, 0,
                       Vec3(0, std::sin(a), std::cos(a)), Vec3(2, 0, 0)),
            1.45);
    measure("rolling along a capsule, obliquely",
            scene_with(CapsuleShape{Vec3(-1, 0, 0), Vec3(9, 0, 0), 0.9}, 0.6,
                       Vec3(0, std::sin(a), std::cos(a)), Vec3(2, 0, 0)),
            1.3);
    measure("rolling down the top of a capsule",
            scene_with(CapsuleShape{Vec3(0, 0, 0), Vec3(40, 0, -4), 0.05}, 0.6,
                       Vec3(1, 0, -0.1) + 0.15 * Vec3(0.1, 0, 1).normalized(), Vec3::Zero()),
            4);
    const Vec3 n(std::sin(10 * a), 0, std::cos(10 * a));
    measure("slip that turns on a slope", scene_with(PlaneShape{n, 0}, 0.3, 0.1 * n, Vec3(0, 3, 0)),
            0.3);
    return 0;
}
