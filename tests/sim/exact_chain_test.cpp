// Balls that meet balls one after the other: pairs, chains, collapse. Every ball's velocity is
// checked: energy and momentum alone accept wrong answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(ExactChain, HeadOn) {
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

TEST(ExactChain, Oblique) {
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

TEST(ExactChain, VeryDifferentRadii) {
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

TEST(ExactChain, GrazingIsDecidedBySign) {
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

TEST(ExactChain, CradlePassesOn) {
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

TEST(ExactChain, LossyCradle) {
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

TEST(ExactChain, LossyCradleWithoutGaps) {
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

TEST(ExactChain, NearlyInelasticCradleEnds) {
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

TEST(ExactChain, UnequalMassesInAChain) {
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

TEST(ExactChain, GalileanCannon) {
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

TEST(ExactChain, DigitsOfPi) {
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

TEST(ExactChain, ThreeBallsCollapse) {
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

/// The second one is faster.
Scene two_before_a_wall(double e) {
    Scene scene = exact_scene(e, 0, 0);
    use_pair(scene, e);
    add_plane(scene, Vec3::UnitX());
    add_ball(scene, Vec3(0.5, 0, 0), Vec3(-1, 0, 0));
    add_ball(scene, Vec3(1.0, 0, 0), Vec3(-1.5, 0, 0));
    return scene;
}

TEST(ExactChain, TwoBallsCollapseOnAWall) {
    for (const double e : {0.0, 0.02, 0.05, 0.1, 0.15, 0.17}) {
        Scene scene = two_before_a_wall(e);
        const SimulationResult result = run(scene, 50);
        const std::vector<double> v = speeds_at(result.motion, 50);
        EXPECT_NEAR(v[0], 0, 1e-9) << "e " << e;
        EXPECT_NEAR(v[1], 0, 1e-9) << "e " << e;
        EXPECT_NEAR(result.motion.balls[0].at(50).position.x(), 0.1, 1e-9) << "e " << e;
        EXPECT_NEAR(result.motion.balls[1].at(50).position.x(), 0.3, 1e-9) << "e " << e;
    }
}

TEST(ExactChain, NoCollapseAboveTheThreshold) {
    for (const double e : {0.18, 0.3, 0.8}) {
        Scene scene = two_before_a_wall(e);
        const SimulationResult result = run(scene, 1e4);
        const std::vector<double> v = speeds_at(result.motion, 1e4);
        EXPECT_GT(v[1], 0) << "e " << e;
        EXPECT_GE(v[1], v[0]);
    }
}

}  // namespace
}  // namespace carom::testing
