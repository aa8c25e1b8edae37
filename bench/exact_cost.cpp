// What the method `exact` costs, in CPU time of the whole method, scene in and motion out:
// one bounce, the same bounces by `fixed` at an error of 1e-4, a gas of 10 to 10,000 balls, and a
// ball that lies still for an hour. Prints a table; each number is the best of a few runs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "best_of.h"
#include "scene/scene.h"
#include "sim/simulate.h"

namespace {

using namespace carom;
using bench::best_of;
using bench::Measured;

/// Materials: [0] the default one, [1] with this restitution against it.
Scene scene_with(double restitution, double gravity, Method method) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].name = "ball";
    scene.materials[1].virtual_body = {-2 * std::log(restitution) / 4, 1};
    scene.simulation.gravity = Vec3(0, 0, -gravity);
    scene.simulation.method = method;
    return scene;
}

void add_plane(Scene& scene, const Vec3& normal, double offset) {
    Surface plane;
    plane.name = fmt::format("plane{}", scene.surfaces.size());
    plane.shape = PlaneShape{normal, offset};
    scene.surfaces.push_back(plane);
}

void add_ball(Scene& scene, const Vec3& position, const Vec3& velocity) {
    Ball ball;
    ball.name = fmt::format("ball{}", scene.balls.size());
    ball.position = position;
    ball.velocity = velocity;
    ball.material = 1;
    scene.balls.push_back(ball);
}

Scene drop(double restitution, Method method) {
    Scene scene = scene_with(restitution, 9.81, method);
    add_plane(scene, Vec3::UnitZ(), 0);
    add_ball(scene, Vec3(0, 0, 1.9), Vec3::Zero());
    return scene;
}

void one_bounce() {
    Scene scene = drop(1, Method::kExact);
    scene.simulation.duration = 100'000 * 2 * std::sqrt(2 * 1.8 / 9.81);
    const Measured m = best_of(scene, 5);
    const auto impacts = static_cast<double>(m.result.report.impacts);
    double worst = 0;
    for (const Peak& p : m.result.motion.peaks[0])
        worst = std::max(worst, std::abs(p.height / 1.8 - 1));
    fmt::print("one bounce of one ball, exact   {:8.3f} us   ({:.0f} bounces, worst peak {:.1e})\n",
               1e6 * m.seconds / impacts, impacts, worst);
}

/// The worst of the first six peaks against e^(2n) h0, as in the table of plain ODE.
double six_peaks(const Motion& motion, double e) {
    double worst = motion.peaks[0].size() < 6 ? 1 : 0;
    for (std::size_t n = 0; n < std::min<std::size_t>(6, motion.peaks[0].size()); ++n) {
        const double expected = std::pow(e, 2 * static_cast<double>(n + 1)) * 1.8;
        worst = std::max(worst, std::abs(motion.peaks[0][n].height / expected - 1));
    }
    return worst;
}

void against_fixed() {
    const double e = 0.85, duration = 6;
    Scene exact = drop(e, Method::kExact);
    exact.simulation.duration = duration;
    const Measured ours = best_of(exact, 2000);
    fmt::print("drop of 1.8 m, e = 0.85, 6 s: exact    {:10.6f} s   six peaks within {:.1e}\n",
               ours.seconds, six_peaks(ours.result.motion, e));
    for (const double step : {1e-3, 1e-4, 3e-5, 1e-5, 3e-6}) {
        Scene fixed = drop(e, Method::kFixed);
        fixed.simulation.duration = duration;
        fixed.simulation.step = step;
        const Measured m = best_of(fixed, 1);
        const double error = six_peaks(m.result.motion, e);
        fmt::print(
            "                              fixed {:.0e} {:8.4f} s   six peaks within {:.1e}: "
            "{:.0f} times the cost of exact\n",
            step, m.seconds, error, m.seconds / ours.seconds);
        if (error <= 1e-4) break;
    }
}

/// The same density at every size: what differs is only the number of balls.
Scene gas(int balls) {
    Scene scene = scene_with(1, 0, Method::kExact);
    const int side = static_cast<int>(std::ceil(std::cbrt(balls)));
    const double spacing = 0.4 * std::cbrt(balls / std::pow(side, 3)),
                 length = 0.4 * std::cbrt(balls);
    for (int axis = 0; axis < 3; ++axis) {
        add_plane(scene, Vec3::Unit(axis), 0);
        add_plane(scene, -Vec3::Unit(axis), -length);
    }
    std::mt19937 random(1);
    std::uniform_real_distribution<double> speed(-1, 1);
    for (int i = 0; i < balls; ++i) {
        const Vec3 cell(i % side, i / side % side, i / side / side);
        const double x = speed(random), y = speed(random), z = speed(random);
        add_ball(scene, spacing * (cell + Vec3::Constant(0.5)), Vec3(x, y, z));
    }
    return scene;
}

void gases() {
    double at_ten = 0;
    for (const int balls : {10, 100, 1000, 10'000}) {
        Scene scene = gas(balls);
        // At least 100 impacts a ball.
        scene.simulation.duration = std::max(20'000.0 / balls, 30.0);
        const Measured m = best_of(scene, balls < 1000 ? 5 : 3);
        const double cost = 1e6 * m.seconds / static_cast<double>(m.result.report.impacts);
        if (at_ten == 0) at_ten = cost;
        double before = 0, after = 0;
        for (std::size_t i = 0; i < scene.balls.size(); ++i) {
            before += scene.balls[i].velocity.squaredNorm();
            after += m.result.motion.balls[i].at(m.result.motion.duration).velocity.squaredNorm();
        }
        fmt::print(
            "gas of {:6} balls   {:8.3f} us an impact   {:5.2f} times that of 10   ({} impacts, "
            "{:.0f} a ball, energy {:+.1e})\n",
            balls, cost, cost / at_ten, m.result.report.impacts,
            2.0 * static_cast<double>(m.result.report.impacts) / balls, after / before - 1);
    }
}

void still_hour() {
    Scene scene = scene_with(0.5, 9.81, Method::kExact);
    add_plane(scene, Vec3::UnitZ(), 0);
    add_ball(scene, Vec3(0, 0, 0.1), Vec3::Zero());
    scene.simulation.duration = 3600;
    const Measured m = best_of(scene, 5);
    fmt::print("a still hour        {:8.4f} ms   ({} events)\n", 1e3 * m.seconds,
               m.result.motion.events.size());
}

}  // namespace

int main() {
    one_bounce();
    against_fixed();
    gases();
    still_hour();
    return 0;
}
