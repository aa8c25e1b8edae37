// Coulomb's friction: closed forms of hard-cases H13, H14, H15, H16, H28.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"

namespace carom {
namespace {

using namespace testing;

constexpr double kFrictionRadius = 0.1;

Vec3 along(double azimuth_deg) {
    const double a = azimuth_deg * M_PI / 180;
    return {std::cos(a), std::sin(a), 0};
}

/// A ball that meets the floor at v_n = 5, v_t = 3; the state after it.
BallState bounce_with_friction(double mu, double k, double azimuth_deg, Solver solver) {
    Scene scene = scene_of(0.8, mu, 0, 1e-3);
    scene.simulation.solver = solver;
    add_plane(scene);
    Vec3 velocity = 3 * along(azimuth_deg);
    velocity.z() = -5;
    add_ball(scene, {0, 0, kFrictionRadius + 0.5}, velocity).inertia_factor = k;
    const auto result = run(scene, 0.15);
    EXPECT_EQ(result.report.impacts, 1);
    return result.motion.balls[0].at(0.15);
}

/// Speed along the azimuth and what is across it; R w' likewise. For a roll along d, w = z x d.
void expect_bounce(const BallState& state, double azimuth_deg, double speed, double surface_speed,
                   double bound) {
    const Vec3 d = along(azimuth_deg);
    const Vec3 expected = speed * d + Vec3(0, 0, 4);
    EXPECT_LT((state.velocity - expected).norm(), bound) << state.velocity.transpose();
    const Vec3 spin = surface_speed / kFrictionRadius * Vec3::UnitZ().cross(d);
    EXPECT_LT((state.spin - spin).norm() * kFrictionRadius, bound) << state.spin.transpose();
}

const double kAzimuths[] = {0, 30, 37, 45, 60, 90, 135, 211, 300};

TEST(Friction, H13AndH15ABounceThatGripsAtEveryAzimuth) {
    for (double k : {kSolid, kShell}) {
        // Just above the bound v_t / ((1 + 1/k) (1 + e) v_n), 0.0952381 for the solid ball.
        const double mu = 1.001 * 3 / ((1 + 1 / k) * 1.8 * 5);
        for (double azimuth : kAzimuths) {
            const double speed = 3 / (1 + k);
            expect_bounce(bounce_with_friction(mu, k, azimuth, Solver::kWorld), azimuth, speed,
                          speed, 1e-13);
        }
    }
}

TEST(Friction, H13AndH15ABounceThatSlidesAtEveryAzimuth) {
    // v_t' = 3 - mu (1 + e) v_n, R w' = mu (1 + e) v_n / k
    expect_bounce(bounce_with_friction(0.05, kSolid, 0, Solver::kWorld), 0, 2.55, 1.125, 1e-13);
    for (double k : {kSolid, kShell})
        for (double mu : {0.02, 0.05})
            for (double azimuth : kAzimuths)
                expect_bounce(bounce_with_friction(mu, k, azimuth, Solver::kWorld), azimuth,
                              3 - mu * 9, mu * 9 / k, 1e-13);
}

// The iterative solver gets there too: without coupling its over-relaxation ends at 0.3^20.
TEST(Friction, H13WithQuickStep) {
    for (double azimuth : kAzimuths) {
        expect_bounce(bounce_with_friction(0.05, kSolid, azimuth, Solver::kQuick), azimuth, 2.55,
                      1.125, 1e-8);
        expect_bounce(bounce_with_friction(0.5, kSolid, azimuth, Solver::kQuick), azimuth, 15.0 / 7,
                      15.0 / 7, 1e-8);
    }
}

// Spin alone moves a ball: a bounce with backspin and no tangential speed.
TEST(Friction, SpinAboutTheNormalStays) {
    Scene scene = scene_of(0.8, 0.5, 0, 1e-3);
    add_plane(scene);
    add_ball(scene, {0, 0, kFrictionRadius + 0.1}, {3, 0, -5}).spin = Vec3(0, 0, 17);
    const auto result = run(scene, 0.1);
    const BallState end = result.motion.balls[0].at(0.1);
    EXPECT_NEAR(end.spin.z(), 17, 1e-13);
    EXPECT_NEAR(end.velocity.x(), 15.0 / 7, 1e-13);
}

TEST(Friction, H14SlidesThenRolls) {
    const double step = 1.0 / 4000;
    for (double azimuth : {0.0, 45.0, 211.0}) {
        Scene scene = scene_of(0.5, 0.2, kGravity, step);
        add_plane(scene);
        add_ball(scene, {0, 0, kFrictionRadius}, 7 * along(azimuth));
        const auto result = run(scene, 2);
        const auto rolls = events_of(result.motion, EventKind::kRoll);
        ASSERT_EQ(rolls.size(), 1u);
        ASSERT_EQ(result.motion.events.size(), 1u);  // no row for the slide that begins at 0
        const BallState at_roll = result.motion.balls[0].at(rolls[0].time);
        fmt::print("rolls at {:.6f} s (1.019368), {:.6f} m (6.116208), v = {:.6f} (5)\n",
                   rolls[0].time, at_roll.position.head<2>().norm(),
                   result.motion.balls[0].at(2).velocity.norm());
        EXPECT_NEAR(rolls[0].time, 1.019367992, 2 * step);
        EXPECT_NEAR(at_roll.position.head<2>().norm(), 6.116207951, 2 * step * 7);
        const BallState end = result.motion.balls[0].at(2);
        EXPECT_LT((end.velocity - 5 * along(azimuth)).norm(), 1e-9);
        EXPECT_NEAR(end.spin.norm() * kFrictionRadius, 5, 1e-9);
        EXPECT_LE(result.motion.balls[0].pieces().size(), 8u);
    }
}

TEST(Friction, H16RollsOrSlidesDownAnIncline) {
    struct Row {
        double mu, k, acceleration;
    };
    const double s = std::sin(M_PI / 6), c = std::cos(M_PI / 6);
    for (const Row& row : {Row{0.6, kSolid, 3.503571429}, Row{0.6, kShell, 2.943},
                           Row{0.1, kSolid, kGravity * (s - 0.1 * c)}}) {
        for (double azimuth : {0.0, 45.0, 211.0}) {
            const double step = 1.0 / 4000;
            Scene scene = scene_of(0.5, row.mu, kGravity, step);
            const Vec3 normal = incline(30, azimuth);
            add_plane(scene, normal);
            add_ball(scene, kFrictionRadius * normal).inertia_factor = row.k;
            const auto result = run(scene, 1);
            const Trajectory& ball = result.motion.balls[0];
            const double moved = (ball.at(1).position - ball.at(0).position).norm();
            // semi-implicit Euler: a (t^2 + t h) / 2
            EXPECT_NEAR(moved, 0.5 * row.acceleration * (1 + step), 1e-9);
            EXPECT_NEAR(ball.at(0.5).position.dot(normal), kFrictionRadius, 1e-10);
            const double acceleration =
                (ball.at(0.9).velocity - ball.at(0.1).velocity).norm() / 0.8;
            if (azimuth == 45)
                fmt::print("mu {}, k {:.3f}: {:.9f} m/s^2 (closed form {:.9f}), {} pieces\n",
                           row.mu, row.k, acceleration, row.acceleration, ball.pieces().size());
            EXPECT_NEAR(acceleration, row.acceleration, 1e-9);
            EXPECT_TRUE(result.motion.events.empty());
            EXPECT_LE(ball.pieces().size(), 8u);
        }
    }
}

// H28: slip across a slope turns. Reference: the equation of the slip, ds/dt = g_t - mu g_n
// (1 + 1/k) s/|s|, in steps of 1e-6 s.
TEST(Friction, H28SlipAcrossAnInclineTurns) {
    const double mu = 0.3, time = 0.25, step = 1.0 / 4000;
    Scene scene = scene_of(0.5, mu, kGravity, step);
    const Vec3 normal = incline(10);
    add_plane(scene, normal);
    add_ball(scene, kFrictionRadius * normal, {0, 3, 0});
    const auto result = run(scene, time);

    const double g_n = kGravity * normal.z();
    const Vec3 g_t = Vec3(0, 0, -kGravity) + g_n * normal;
    Vec3 slip(0, 3, 0), velocity(0, 3, 0);
    const int n = 250000;
    for (int i = 0; i < n; ++i) {
        const Vec3 unit = slip.normalized();
        slip += time / n * (g_t - mu * g_n * (1 + 1 / kSolid) * unit);
        velocity += time / n * (g_t - mu * g_n * unit);
    }
    const Vec3 found = result.motion.balls[0].at(time).velocity;
    const double turned = std::atan2(slip.head<1>().norm(), slip.y()) * 180 / M_PI;
    fmt::print("slip turned by {:.1f} deg (17); velocity off by {:.1e} m/s (bound {:.1e})\n",
               turned, (found - velocity).norm(), kGravity * step);
    EXPECT_NEAR(turned, 17, 1);
    EXPECT_LT((found - velocity).norm(), kGravity * step);
    EXPECT_LT((found - velocity).norm(), 0.01 * (velocity - Vec3(0, 3, 0)).norm());
}

// A ball at rest on a slope with friction is held back by no more than the cone allows, and one
// that slides for good decelerates with mu g in any direction: a pyramid would give mu g sqrt 2.
TEST(Friction, IsAConeNotAPyramid) {
    double slowest = 1e9, fastest = 0;
    for (double azimuth : kAzimuths) {
        Scene scene = scene_of(0.5, 0.2, kGravity, 1e-3);
        add_plane(scene);
        add_ball(scene, {0, 0, kFrictionRadius}, 7 * along(azimuth));
        const auto result = run(scene, 0.5);
        const double lost = 7 - result.motion.balls[0].at(0.4).velocity.norm();
        slowest = std::min(slowest, lost);
        fastest = std::max(fastest, lost);
    }
    fmt::print("lost speed over all azimuths: {:.12f} ... {:.12f} m/s\n", slowest, fastest);
    EXPECT_LT(fastest - slowest, 1e-9);
    EXPECT_NEAR(slowest, 0.2 * kGravity * (0.4 + 0.5e-3), 1e-3);
}

}  // namespace
}  // namespace carom
