// What surfaces cost the method `exact`, in CPU time of the whole method: an impact of a ball on a
// floor among 0 to 1,000 surfaces that it never comes near to, and a peg board of 120 pegs on which
// 300 balls fall for 3 s. Prints a table; each number is the best of a few runs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "best_of.h"
#include "scene/scene.h"
#include "sim/simulate.h"

namespace {

using namespace carom;
using bench::best_of;
using bench::Measured;

void add_surface(Scene& scene, const SurfaceShape& shape) {
    Surface surface;
    surface.name = fmt::format("surface{}", scene.surfaces.size());
    surface.shape = shape;
    scene.surfaces.push_back(surface);
}

void add_ball(Scene& scene, const Vec3& position, double radius) {
    Ball ball;
    ball.name = fmt::format("ball{}", scene.balls.size());
    ball.position = position;
    ball.radius = radius;
    scene.balls.push_back(ball);
}

/// A ball that bounces for ever on a floor, in the middle of so many capsules around it.
Scene far_capsules(int count) {
    Scene scene;
    scene.materials.resize(1);
    add_surface(scene, PlaneShape{});
    for (int i = 0; i < count; ++i) {
        const double turn = 2.399963 * i, distance = 10 + 0.05 * i;  // golden angle
        const Vec3 at(distance * std::cos(turn), distance * std::sin(turn), 0.5 * (i % 7));
        add_surface(scene, CapsuleShape{at, at + Vec3::UnitZ(), 0.1});
    }
    add_ball(scene, Vec3(0, 0, 1.9), 0.1);
    scene.simulation.duration = 20'000 * 2 * std::sqrt(2 * 1.8 / 9.81);
    return scene;
}

void far_surfaces() {
    double alone = 0;
    for (const int count : {0, 10, 100, 1000}) {
        const Measured m = best_of(far_capsules(count), count > 100 ? 3 : 7);
        const double cost = 1e6 * m.seconds / static_cast<double>(m.result.report.impacts);
        if (count == 0) alone = cost;
        fmt::print("impact among {:5} far capsules {:8.3f} us   {:5.2f} times that among none\n",
                   count, cost, cost / alone);
    }
}

/// 12 by 10 pegs, staggered, between two panes; the balls start in rows above them.
Scene peg_board(bool spheres, double friction) {
    constexpr double kPeg = 0.01, kBall = 0.012, kSpacing = 0.1, kDepth = 0.03;
    Scene scene;
    scene.materials.resize(1);
    scene.pairs.push_back({{0, 0}, 0.6, friction, {}});
    add_surface(scene, PlaneShape{});
    add_surface(scene, PlaneShape{Vec3::UnitX(), 0});
    add_surface(scene, PlaneShape{-Vec3::UnitX(), -12 * kSpacing});
    add_surface(scene, PlaneShape{Vec3::UnitY(), 0});
    add_surface(scene, PlaneShape{-Vec3::UnitY(), -kDepth});
    for (int i = 0; i < 120; ++i) {
        const int row = i / 12, column = i % 12;
        const double x = kSpacing * (column + (row % 2 == 0 ? 0.25 : 0.75));
        const Vec3 at(x, 0, 0.3 + kSpacing * row), middle(x, 0.5 * kDepth, at.z());
        if (spheres)
            add_surface(scene, SphereShape{middle, kPeg});
        else
            add_surface(scene, CapsuleShape{at, at + kDepth * Vec3::UnitY(), kPeg});
    }
    for (int i = 0; i < 300; ++i) {
        const int row = i / 30, column = i % 30;
        add_ball(scene,
                 Vec3(0.02 + 0.04 * column + 1e-3 * (row % 5), 0.5 * kDepth, 1.4 + 0.05 * row),
                 kBall);
    }
    scene.simulation.duration = 3;
    return scene;
}

void peg_boards() {
    for (const bool spheres : {false, true})
        for (const double friction : {0.0, 0.2}) {
            const Measured m = best_of(peg_board(spheres, friction), 1);
            fmt::print(
                "peg board of 120 {} and 300 balls, friction {:3.1f}: {:6.3f} s for 3 s   ({} "
                "impacts, {} pieces, {} steps)\n",
                spheres ? "spheres " : "capsules", friction, m.seconds, m.result.report.impacts,
                m.result.report.integrated, m.result.report.steps);
        }
}

}  // namespace

int main() {
    far_surfaces();
    peg_boards();
    return 0;
}
