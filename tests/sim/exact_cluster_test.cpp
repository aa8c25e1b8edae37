// Balls that meet at one instant: racks, grooves, touching clusters. Every ball's velocity is
// checked: energy and momentum alone accept wrong answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "exact_scenes.h"

namespace carom::testing {
namespace {

TEST(ExactCluster, CueOnTwoTouchingBalls) {
    for (const double e : {1.0, 0.9, 0.5}) {
        Scene scene = exact_scene(1, 0, 0);
        use_pair(scene, e);
        add_ball(scene, Vec3(-1, 0, 0), Vec3(1, 0, 0));
        const double x = 0.3;
        add_ball(scene, Vec3(x, 0.1, 0));
        add_ball(scene, Vec3(x, -0.1, 0));
        const SimulationResult result = run(scene, 3);
        const double target = (1 + e) * (std::sqrt(3.0) / 2) / 2.5;
        const Vec3 a = result.motion.balls[1].at(3).velocity;
        const Vec3 b = result.motion.balls[2].at(3).velocity;
        const Vec3 cue = result.motion.balls[0].at(3).velocity;
        EXPECT_LE((a - target * Vec3(std::sqrt(3.0) / 2, 0.5, 0)).norm(), 1e-12);
        EXPECT_LE((a - Vec3(b.x(), -b.y(), b.z())).norm(), 1e-12);
        EXPECT_NEAR(cue.x(), 1 - std::sqrt(3.0) * target, 1e-12);
        EXPECT_LE(std::abs(cue.y()), 1e-12);
    }
}

/// A cue ball and a rack of fifteen that touch each other.
Scene rack(double e) {
    Scene scene = exact_scene(1, 0, 0);
    use_pair(scene, e);
    add_ball(scene, Vec3(-1, 0, 0), Vec3(3, 0, 0));
    for (int row = 0; row < 5; ++row)
        for (int i = 0; i <= row; ++i)
            add_ball(scene, Vec3(0.1 * std::sqrt(3.0) * row, 0.1 * (2 * i - row), 0));
    return scene;
}

TEST(ExactCluster, RackStaysMirrorSymmetric) {
    for (const double e : {1.0, 0.95, 0.6}) {
        Scene scene = rack(e);
        const double end = 0.9 / 3 + 1e-3;
        const SimulationResult result = run(scene, end);
        ASSERT_GE(impacts_of(result.motion).size(), 9u);
        double worst = 0;
        std::size_t ball = 1;
        for (int row = 0; row < 5; ++row) {
            for (int i = 0; i <= row; ++i) {
                const auto of = [&](int k) {
                    return result.motion.balls[ball + static_cast<std::size_t>(k)].at(end).velocity;
                };
                const Vec3 a = of(i), b = of(row - i);
                worst = std::max(worst, (a - Vec3(b.x(), -b.y(), b.z())).norm());
            }
            ball += static_cast<std::size_t>(row) + 1;
        }
        std::printf("rack, e = %g: mirror error %.3g, %zu impacts\n", e, worst,
                    impacts_of(result.motion).size());
        EXPECT_LE(worst, 1e-12);
        EXPECT_LE((momentum(scene, result.motion, end) - Vec3(3, 0, 0)).norm(), 1e-12);
        const double energy = kinetic_energy(scene, result.motion, end);
        if (e == 1) {
            EXPECT_NEAR(energy, 4.5, 1e-11);
        }
        EXPECT_LE(energy, 4.5 * (1 + 1e-12));
    }
}

TEST(ExactCluster, DroppedIntoAGroove) {
    for (const double opening : {120.0, 90.0, 40.0})
        for (const double e : {1.0, 0.8, 0.5}) {
            // Normals at half the supplement from the vertical, to both sides.
            const double a = 90 - opening / 2;
            const Vec3 left = incline(a), right = incline(-a);
            Scene scene = exact_scene(e, 0, kGravity);
            add_plane(scene, left);
            add_plane(scene, right);
            const double rest = 0.1 / std::sin(opening / 2 * M_PI / 180);
            add_ball(scene, Vec3(0, 0, rest + 1));
            const double at = std::sqrt(2 / kGravity), v = std::sqrt(2 * kGravity);
            const SimulationResult result = run(scene, at + 0.01);
            const BallState after = result.motion.balls[0].at(at + 0.01);
            EXPECT_LE(relative_error(after.velocity.z() + kGravity * 0.01, e * v), 1e-9) << opening;
            EXPECT_LT(std::abs(after.position.x()), 1e-12);
            EXPECT_EQ(impacts_of(result.motion).size(), 2u);
        }
}

/// However many rounds a cluster takes at one instant, a pair has one impact then.
TEST(ExactCluster, OneRowPerPairAndImpact) {
    for (const double e : {1.0, 0.95, 0.6, 0.2}) {
        Scene scene = rack(e);
        const SimulationResult result = run(scene, 2);
        const std::vector<Event> impacts = impacts_of(result.motion);
        ASSERT_GE(impacts.size(), 9u);
        std::set<std::tuple<double, int, int>> seen;
        double slowest = INFINITY;
        std::vector<Vec3> p;
        for (const Ball& b : scene.balls) p.push_back(b.mass * b.velocity);
        for (const Event& i : impacts) {
            EXPECT_TRUE(seen.insert({i.time, i.ball, i.other.index}).second)
                << "e " << e << ": balls " << i.ball << " and " << i.other.index << " twice at "
                << i.time << " s";
            EXPECT_GE(i.separation_speed, 0);
            EXPECT_GT(i.impulse, 0);
            slowest = std::min(slowest, i.approach_speed);
            p[static_cast<std::size_t>(i.ball)] += i.impulse * i.normal;
            p[static_cast<std::size_t>(i.other.index)] -= i.impulse * i.normal;
        }
        // The rows tell all: their impulses give the momenta at the end.
        double worst = 0;
        for (std::size_t k = 0; k < p.size(); ++k)
            worst = std::max(worst, (result.motion.balls[k].at(2).velocity - p[k]).norm());
        std::printf("e = %g: %zu rows, slowest approach %.3g m/s, momenta within %.3g\n", e,
                    impacts.size(), slowest, worst);
        EXPECT_GT(slowest, 1e-12);
        EXPECT_LE(worst, 1e-9);
    }
}

/// Random clusters of touching balls and one that strikes: no energy from nothing.
TEST(ExactCluster, RandomClustersGainNoEnergy) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    int resolved = 0;
    for (int trial = 0; trial < 150; ++trial) {
        Scene scene = exact_scene(1, 0, 0);
        const double e = trial % 3 == 0 ? 1.0 : unit(random);
        use_pair(scene, e);
        add_ball(scene, Vec3::Zero());
        // Each new ball touches an old one, and overlaps none.
        for (int tries = 0; tries < 200 && scene.balls.size() < 8; ++tries) {
            const Ball& base =
                scene.balls[static_cast<std::size_t>(unit(random) * double(scene.balls.size()))];
            const double radius = 0.05 + 0.1 * unit(random);
            const Vec3 away =
                Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5).normalized();
            const Vec3 at = base.position + (base.radius + radius) * away;
            bool free = true;
            for (const Ball& b : scene.balls)
                free = free && (&b == &base || (b.position - at).norm() > b.radius + radius);
            if (!free) continue;
            const double mass = std::pow(10, 4 * unit(random) - 2);
            add_ball(scene, at, Vec3(unit(random) - 0.5, unit(random) - 0.5, 0), radius).mass =
                mass;
        }
        const double before = kinetic_energy(
            scene,
            [&] {
                Motion start;
                for (const Ball& b : scene.balls) {
                    start.balls.emplace_back();
                    Piece piece;
                    piece.velocity = b.velocity;
                    start.balls.back().append(piece);
                }
                return start;
            }(),
            0);
        Vec3 p0 = Vec3::Zero();
        for (const Ball& b : scene.balls) p0 += b.mass * b.velocity;
        const SimulationResult result = run(scene, 0.2);
        resolved += static_cast<int>(impacts_of(result.motion).size());
        const double after = kinetic_energy(scene, result.motion, 0.2);
        EXPECT_LE(after, before * (1 + 1e-12)) << "trial " << trial << ", e " << e;
        if (e == 1) {
            EXPECT_GE(after, before * (1 - 1e-11)) << "trial " << trial;
        }
        EXPECT_LE((momentum(scene, result.motion, 0.2) - p0).norm(), 1e-11 * (1 + p0.norm()));
    }
    EXPECT_GT(resolved, 300);
}

}  // namespace
}  // namespace carom::testing
