// Balls that meet balls: pairs, chains, racks, collapse. Every ball's velocity is checked: energy
// and momentum alone accept wrong answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "exact_scenes.h"

namespace carom::testing {
namespace {

/// Balls on the x axis with gaps between them, all of one material pair.
struct Line {
    std::vector<double> masses;
    std::vector<double> speeds;
    double gap = 0;
    double restitution = 1;
    double radius = 0.1;
};

Scene line_scene(const Line& line) {
    Scene scene = exact_scene(1, 0, 0);
    use_pair(scene, line.restitution);
    double x = 0;
    for (std::size_t i = 0; i < line.masses.size(); ++i) {
        add_ball(scene, Vec3(x, 0, 0), Vec3(line.speeds[i], 0, 0), line.radius).mass =
            line.masses[i];
        x += 2 * line.radius + line.gap;
    }
    return scene;
}

std::vector<double> speeds_at(const Motion& motion, double t) {
    std::vector<double> result;
    for (const Trajectory& ball : motion.balls) result.push_back(ball.at(t).velocity.x());
    return result;
}

double worst_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = a.size() == b.size() ? 0 : INFINITY;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

// ---- Two balls
// ------------------------------------------------------------------------------------

TEST(ExactCluster, HeadOn) {
    for (const double m2 : {1e-3, 0.5, 3.0, 1e6})
        for (const double e : {0.0, 0.3, 0.5, 1.0}) {
            Scene scene = line_scene({{1, m2}, {2, -1}, 0.4, e});
            const SimulationResult result = run(scene, 1);
            const double impulse = (1 + e) * 3 * m2 / (1 + m2);
            const std::vector<double> v = speeds_at(result.motion, 1);
            EXPECT_LE(relative_error(v[0], 2 - impulse), 1e-12);
            EXPECT_LE(relative_error(v[1], -1 + impulse / m2), 1e-9);
            ASSERT_EQ(impacts_of(result.motion).size(), 1u);
            EXPECT_LE(relative_error(impacts_of(result.motion)[0].impulse, impulse), 1e-12);
        }
    Scene scene = line_scene({{1, 3}, {2, -1}, 0.4, 0.5});
    EXPECT_LE(worst_difference(speeds_at(run(scene, 1).motion, 1), {-1.375, 0.125}), 1e-15);
}

TEST(ExactCluster, Oblique) {
    for (const double degrees : {5.0, 30.0, 80.0})
        for (const double e : {1.0, 0.9, 0.2}) {
            const double a = degrees * M_PI / 180;
            Scene scene = exact_scene(1, 0, 0);
            use_pair(scene, e);
            // The cue comes along x; the impact line stands at the angle a to it.
            add_ball(scene, Vec3(-0.2 * std::cos(a) - 0.5, -0.2 * std::sin(a), 0), Vec3(1, 0, 0));
            add_ball(scene, Vec3::Zero());
            const SimulationResult result = run(scene, 2);
            const Vec3 line(std::cos(a), std::sin(a), 0);
            const double target = 0.5 * (1 + e) * std::cos(a);
            EXPECT_LE((result.motion.balls[1].at(2).velocity - target * line).norm(), 1e-12);
            EXPECT_LE(
                (result.motion.balls[0].at(2).velocity - (Vec3(1, 0, 0) - target * line)).norm(),
                1e-12);
        }
}

TEST(ExactCluster, VeryDifferentRadii) {
    Scene scene = exact_scene(1, 0, 0);
    use_pair(scene, 0.5);
    add_ball(scene, Vec3(-1.5, 0, 0), Vec3(2, 0, 0), 1).mass = 1;
    add_ball(scene, Vec3(0.1, 0, 0), Vec3(-1, 0, 0), 1e-4).mass = 3;
    const SimulationResult result = run(scene, 1);
    EXPECT_LE(worst_difference(speeds_at(result.motion, 1), {-1.375, 0.125}), 1e-12);
    const std::vector<Event> impacts = impacts_of(result.motion);
    ASSERT_EQ(impacts.size(), 1u);
    EXPECT_LE(relative_error(impacts[0].time, (1.6 - 1.0001) / 3), 1e-12);
}

TEST(ExactCluster, GrazingIsDecidedBySign) {
    for (const double offset : {-1e-9, 0.0, 1e-9})
        for (const double speed : {1.0 / 64, 1.0, 1024.0}) {
            Scene scene = exact_scene(1, 0, 0);
            // Radii that are exact in binary, so that 0 is 0.
            add_ball(scene, Vec3(-4, 0.25 + offset, 0), Vec3(speed, 0, 0), 0.125);
            add_ball(scene, Vec3(0, 0, 0), Vec3::Zero(), 0.125);
            const SimulationResult result = run(scene, 8 / speed);
            EXPECT_EQ(impacts_of(result.motion).size(), offset < 0 ? 1u : 0u)
                << offset << " at " << speed;
        }
}

// ---- Chains
// ---------------------------------------------------------------------------------------

TEST(ExactCluster, CradlePassesOn) {
    for (const double gap : {0.0, 1e-9, 1e-6, 0.01})
        for (std::size_t in = 1; in <= 4; ++in) {
            std::vector<double> before(5, 0), after(5, 0);
            for (std::size_t i = 0; i < in; ++i) before[i] = after[4 - i] = 1;
            Scene scene = line_scene({std::vector<double>(5, 1.0), before, gap, 1});
            const SimulationResult result = run(scene, 1);
            EXPECT_LE(worst_difference(speeds_at(result.motion, 1), after), 1e-12)
                << in << " in, gap " << gap;
        }
}

TEST(ExactCluster, LossyCradle) {
    for (const double e : {0.5, 0.8, 0.95})
        for (const double gap : {1e-6, 1e-3}) {
            Scene scene = line_scene({std::vector<double>(5, 1.0), {1, 0, 0, 0, 0}, gap, e});
            const SimulationResult result = run(scene, 20 * gap);
            // The last ball as the first wave leaves it.
            const std::vector<Event> impacts = impacts_of(result.motion);
            const auto last = std::find_if(impacts.begin(), impacts.end(),
                                           [](const Event& i) { return i.other.index == 4; });
            ASSERT_NE(last, impacts.end());
            EXPECT_LE(relative_error(result.motion.balls[4].at(last->time).velocity.x(),
                                     std::pow((1 + e) / 2, 4)),
                      1e-9);
        }
}

TEST(ExactCluster, LossyCradleWithoutGaps) {
    for (const double e : {0.5, 0.7, 0.9}) {
        Scene scene = line_scene({std::vector<double>(5, 1.0), {1, 0, 0, 0, 0}, 0, e});
        const SimulationResult result = run(scene, 1);
        const std::vector<double> v = speeds_at(result.motion, 1);
        EXPECT_LE(relative_error(v[4], std::pow((1 + e) / 2, 4)), 1e-9) << "e " << e;
        double sum = 0;
        for (std::size_t i = 0; i < 5; ++i) {
            sum += v[i];
            if (i > 0) {
                EXPECT_GE(v[i], v[i - 1] - 1e-12);
            }
        }
        EXPECT_NEAR(sum, 1, 1e-14);
    }
}

TEST(ExactCluster, NearlyInelasticCradleEnds) {
    for (const double e : {0.0, 1e-3, 0.1, 0.3})
        for (const std::size_t balls : {3u, 5u, 12u}) {
            std::vector<double> v(balls, 0);
            v[0] = 1;
            Scene scene = line_scene({std::vector<double>(balls, 1.0), v, 0, e});
            const SimulationResult result = run(scene, 1);
            const std::vector<double> after = speeds_at(result.motion, 1);
            double sum = 0;
            for (std::size_t i = 0; i < balls; ++i) {
                sum += after[i];
                if (i > 0) {
                    EXPECT_GE(after[i], after[i - 1] - 1e-12);
                }
                if (e == 0) {
                    EXPECT_NEAR(after[i], 1.0 / double(balls), 1e-9);
                }
            }
            EXPECT_NEAR(sum, 1, 1e-13) << "e " << e << ", " << balls << " balls";
        }
}

TEST(ExactCluster, UnequalMassesInAChain) {
    const std::vector<double> masses = {3, 1, 7, 0.5};
    Scene scene = line_scene({masses, {2, 0, 0, -1}, 1e-3, 1});
    const SimulationResult result = run(scene, 10);
    const std::vector<double> v = speeds_at(result.motion, 10);
    double p = 0, energy = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        p += masses[i] * v[i];
        energy += masses[i] * v[i] * v[i];
        if (i > 0) {
            EXPECT_GE(v[i], v[i - 1]);
        }
    }
    EXPECT_NEAR(p, 5.5, 1e-12);
    EXPECT_NEAR(energy, 12.5, 1e-12);
}

TEST(ExactCluster, GalileanCannon) {
    for (const auto& [ratio, expected] :
         {std::pair{3.0, 2.0}, {10.0, 2.636363636363636}, {1000.0, 2.996003996003996}}) {
        Scene scene = exact_scene(1, 0, kGravity);
        use_pair(scene, 1);
        add_plane(scene);
        add_ball(scene, Vec3(0, 0, 1.1)).mass = ratio;
        add_ball(scene, Vec3(0, 0, 1.3)).mass = 1;
        const double at = std::sqrt(2 / kGravity);
        const SimulationResult result = run(scene, at + 0.01);
        const double v = std::sqrt(2 * kGravity);
        const double top = result.motion.balls[1].at(at + 0.01).velocity.z() + kGravity * 0.01;
        EXPECT_LE(relative_error(top, expected * v), 1e-9);
    }
    Scene scene = exact_scene(1, 0, kGravity);
    use_pair(scene, 1);
    add_plane(scene);
    for (int i = 0; i < 3; ++i)
        add_ball(scene, Vec3(0, 0, 1.1 + 0.2 * i)).mass = 6.0 / (i == 2 ? 6 : 1 + 2 * i);
    const double at = std::sqrt(2 / kGravity);
    const SimulationResult result = run(scene, at + 0.01);
    const double v = std::sqrt(2 * kGravity);
    const double expected[] = {0, 0, 3};
    const double after = impacts_of(result.motion).at(0).time;
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(result.motion.balls[i].at(after).velocity.z(), expected[i] * v, 1e-9);
    }
}

TEST(ExactCluster, DigitsOfPi) {
    const std::size_t counts[] = {3, 31, 314, 3141, 31415};
    for (int k = 0; k <= 4; ++k) {
        Scene scene = exact_scene(1, 0, 0);
        add_plane(scene, Vec3::UnitX());
        add_ball(scene, Vec3(1, 0, 0)).mass = 1;
        add_ball(scene, Vec3(2, 0, 0), Vec3(-1, 0, 0)).mass = std::pow(100, k);
        const SimulationResult result = run(scene, 100);
        EXPECT_EQ(impacts_of(result.motion).size(), counts[k]) << "M = 100^" << k;
        EXPECT_EQ(result.motion.events.size(), counts[k]);
    }
}

// ---- Collapse
// -------------------------------------------------------------------------------------

TEST(ExactCluster, ThreeBallsCollapse) {
    for (const double e : {0.0, 0.01, 0.03, 0.05, 0.07, 0.0718}) {
        Scene scene = line_scene({{1, 1, 1}, {1, 0, -1}, 0.3, e});
        scene.balls[2].position.x() += 0.05;
        const SimulationResult result = run(scene, 50);
        const std::vector<double> v = speeds_at(result.motion, 50);
        EXPECT_NEAR(v[0] + v[1] + v[2], 0, 1e-13) << "e " << e;
        EXPECT_NEAR(v[0], v[1], 1e-9) << "e " << e;
        EXPECT_NEAR(v[1], v[2], 1e-9) << "e " << e;
        EXPECT_GE(impacts_of(result.motion).size(), 3u);
    }
}

TEST(ExactCluster, TwoBallsCollapseOnAWall) {
    for (const double e : {0.0, 0.02, 0.05, 0.1, 0.15, 0.17}) {
        Scene scene = exact_scene(e, 0, 0);
        use_pair(scene, e);
        add_plane(scene, Vec3::UnitX());
        add_ball(scene, Vec3(0.5, 0, 0), Vec3(-1, 0, 0));
        add_ball(scene, Vec3(1.0, 0, 0), Vec3(-1.5, 0, 0));
        const SimulationResult result = run(scene, 50);
        const std::vector<double> v = speeds_at(result.motion, 50);
        EXPECT_NEAR(v[0], 0, 1e-9) << "e " << e;
        EXPECT_NEAR(v[1], 0, 1e-9) << "e " << e;
        EXPECT_NEAR(result.motion.balls[0].at(50).position.x(), 0.1, 1e-9) << "e " << e;
        EXPECT_NEAR(result.motion.balls[1].at(50).position.x(), 0.3, 1e-9) << "e " << e;
    }
}

TEST(ExactCluster, NoCollapseAboveTheThreshold) {
    for (const double e : {0.18, 0.3, 0.8}) {
        Scene scene = exact_scene(e, 0, 0);
        use_pair(scene, e);
        add_plane(scene, Vec3::UnitX());
        add_ball(scene, Vec3(0.5, 0, 0), Vec3(-1, 0, 0));
        add_ball(scene, Vec3(1.0, 0, 0), Vec3(-1.5, 0, 0));
        const SimulationResult result = run(scene, 1e4);
        const std::vector<double> v = speeds_at(result.motion, 1e4);
        EXPECT_GT(v[1], 0) << "e " << e;
        EXPECT_GE(v[1], v[0]);
    }
}

// ---- Together at one instant
// ------------------------------------------------------------------------

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
        ASSERT_GE(impacts_of(result.motion).size(), 10u);
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
