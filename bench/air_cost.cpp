// What air costs: ten bounces of a ball in a vacuum, with drag, and with drag, lift and spin that
// decays, in CPU time of the whole method `exact`; beside the error of the tenth peak where there
// is a closed form. Prints a table; each number is the best of a few series of runs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "clock.h"
#include "scene/scene.h"
#include "sim/simulate.h"

namespace {

using namespace carom;

constexpr double kDrop = 0.305, kRestitution = 0.9, kG = 9.81;
constexpr int kBounces = 10, kRuns = 2000, kSeries = 5;

/// A table tennis ball.
Scene bouncing(bool air, double drag) {
    Scene scene;
    scene.materials.resize(1);
    scene.pairs.push_back({{0, 0}, kRestitution, 0.0, {}});
    Surface floor;
    floor.name = "floor";
    floor.shape = PlaneShape{};
    scene.surfaces.push_back(floor);
    Ball ball;
    ball.name = "a";
    ball.radius = 0.02;
    ball.mass = 0.0027;
    ball.position = Vec3(0, 0, ball.radius + kDrop);
    ball.flight.drag = {Drag::Over::kNothing, drag, nullptr};
    scene.balls.push_back(ball);
    if (air) scene.air = Air{.buoyancy = false};
    return scene;
}

void measure(const std::string& name, Scene scene, double exact_peak) {
    scene.simulation.duration = 4;
    const SimulationResult once = simulate(scene);
    scene.simulation.duration =
        0.5 * (once.motion.events.at(kBounces - 1).time + once.motion.events.at(kBounces).time);
    double best = 1e300;
    for (int series = 0; series < kSeries; ++series) {
        const double start = bench::cpu_seconds();
        for (int i = 0; i < kRuns; ++i) simulate(scene);
        best = std::min(best, (bench::cpu_seconds() - start) / kRuns);
    }
    fmt::print("{:34} {:7.2f} us a run, {:5.2f} us a bounce, {:3} pieces   ", name, 1e6 * best,
               1e6 * best / kBounces, simulate(scene).motion.balls[0].pieces().size());
    if (exact_peak > 0)
        fmt::print("peak 10 off by {:.1e} m",
                   std::abs(once.motion.peaks[0].at(kBounces - 1).height - exact_peak));
    fmt::print("\n");
}

}  // namespace

int main() {
    measure("vacuum", bouncing(false, 0), kDrop * std::pow(kRestitution, 2 * kBounces));
    measure("air of which nothing acts", bouncing(true, 0), 0);
    measure("drag 0.45", bouncing(true, 0.45), 0.0279241229903422);
    Scene sphere = bouncing(true, 0);
    sphere.balls[0].flight.drag = {};
    measure("drag of a smooth sphere", sphere, 0);
    Scene oblique = bouncing(true, 0.45);
    oblique.balls[0].velocity = Vec3(2, 0, 0);
    oblique.balls[0].spin = Vec3(0, -100, 0);
    oblique.balls[0].flight.lift.over = Lift::Over::kTennis;
    oblique.balls[0].flight.spin_decay_s = 10;
    measure("oblique, drag, lift, spin decays", oblique, 0);
    return 0;
}
