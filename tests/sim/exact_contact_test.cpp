// Friction at impacts, and lasting contacts with flat surfaces, against Coulomb in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "exact_scenes.h"
#include "sim/law/flat_contact.h"

namespace carom::testing {
namespace {

/// A ball that comes down on z = 0 with v_n, and v_t towards an azimuth.
Scene oblique(double v_n, double v_t, double azimuth_deg, double e, double mu, double k) {
    Scene scene = exact_scene(e, mu, 0);
    add_plane(scene);
    const double b = azimuth_deg * M_PI / 180;
    Ball& ball = add_ball(scene, Vec3(0, 0, 0.6), Vec3(v_t * std::cos(b), v_t * std::sin(b), -v_n));
    ball.inertia_factor = k;
    return scene;
}

TEST(ExactContact, BounceWithFriction) {
    double worst = 0;
    for (const double k : {kSolid, kShell, 0.1})
        for (const double mu : {0.0, 0.01, 0.05, 0.0952, 0.0953, 0.3, 2.0})
            for (const double azimuth : {0.0, 37.0, 45.0, 90.0, 135.0, 211.0, 300.0})
                for (const auto& [v_n, v_t] : {std::pair{5.0, 3.0}, {1.0, 0.2}, {0.3, 40.0}}) {
                    const double e = 0.8;
                    Scene scene = oblique(v_n, v_t, azimuth, e, mu, k);
                    const SimulationResult result = run(scene, 2);
                    const BallState after = result.motion.balls[0].at(2);
                    const double grip = v_t / ((1 + 1 / k) * (1 + e) * v_n);
                    const double v = mu >= grip ? v_t / (1 + k) : v_t - mu * (1 + e) * v_n;
                    const double rw = mu >= grip ? v_t / (1 + k) : mu * (1 + e) * v_n / k;
                    const double b = azimuth * M_PI / 180;
                    const Vec3 along(std::cos(b), std::sin(b), 0);
                    const Vec3 spin = rw / 0.1 * Vec3::UnitZ().cross(along);
                    const double scale = v_n + v_t;
                    worst = std::max(
                        worst,
                        (after.velocity - v * along - e * v_n * Vec3::UnitZ()).norm() / scale);
                    worst = std::max(worst, 0.1 * (after.spin - spin).norm() / scale);
                }
    std::printf("bounces with friction within %.3g\n", worst);
    EXPECT_LE(worst, 1e-12);
}

TEST(ExactContact, HardCase13) {
    Scene grips = oblique(5, 3, 0, 0.8, 0.3, kSolid);
    EXPECT_NEAR(run(grips, 2).motion.balls[0].at(2).velocity.x(), 15.0 / 7, 1e-14);
    Scene slips = oblique(5, 3, 0, 0.8, 0.05, kSolid);
    const BallState after = run(slips, 2).motion.balls[0].at(2);
    EXPECT_NEAR(after.velocity.x(), 2.55, 1e-14);
    EXPECT_NEAR(0.1 * after.spin.y(), 1.125, 1e-14);
}

TEST(ExactContact, SlideToRoll) {
    for (const double v0 : {0.1, 7.0})
        for (const double mu : {0.05, 0.2, 1.0})
            for (const double k : {kSolid, kShell}) {
                Scene scene = exact_scene(0.5, mu, kGravity);
                add_plane(scene);
                add_ball(scene, Vec3(0, 0, 0.1), Vec3(v0, 0, 0)).inertia_factor = k;
                const double at = v0 / ((1 + 1 / k) * mu * kGravity);
                const SimulationResult result = run(scene, 3 * at);
                const std::vector<Event> rolls = events_of(result.motion, EventKind::kRoll);
                ASSERT_EQ(rolls.size(), 1u);
                EXPECT_LE(relative_error(rolls[0].time, at), 1e-12);
                const BallState then = result.motion.balls[0].at(rolls[0].time);
                EXPECT_LE(relative_error(then.position.x(), v0 * at - mu * kGravity * at * at / 2),
                          1e-12);
                EXPECT_LE(relative_error(then.velocity.x(), v0 / (1 + k)), 1e-12);
                EXPECT_LE(relative_error(0.1 * then.spin.y(), v0 / (1 + k)), 1e-12);
                // It goes on so.
                const BallState later = result.motion.balls[0].at(3 * at);
                EXPECT_LE(relative_error(later.velocity.x(), v0 / (1 + k)), 1e-12);
                EXPECT_EQ(result.motion.events.size(), 1u);
            }
    Scene scene = exact_scene(0.5, 0.2, kGravity);
    add_plane(scene);
    add_ball(scene, Vec3(0, 0, 0.1), Vec3(7, 0, 0));
    const std::vector<Event> rolls = events_of(run(scene, 2).motion, EventKind::kRoll);
    ASSERT_EQ(rolls.size(), 1u);
    EXPECT_NEAR(rolls[0].time, 1.019367992, 5e-10);
    EXPECT_NEAR(rolls[0].point.x(), 6.116207951, 5e-10);
}

TEST(ExactContact, DownASlope) {
    for (const double degrees : {5.0, 30.0, 60.0})
        for (const double azimuth : {0.0, 75.0})
            for (const double k : {kSolid, kShell})
                for (const double mu : {0.0, 0.1, 0.6, 1.5}) {
                    const Vec3 n = incline(degrees, azimuth);
                    const double a = degrees * M_PI / 180;
                    Scene scene = exact_scene(0.5, mu, kGravity);
                    add_plane(scene, n);
                    add_ball(scene, 0.1 * n).inertia_factor = k;
                    const SimulationResult result = run(scene, 2);
                    const bool rolls = mu * std::cos(a) * (1 + 1 / k) >= std::sin(a);
                    const double rate = rolls && mu > 0
                                            ? kGravity * std::sin(a) / (1 + k)
                                            : kGravity * (std::sin(a) - mu * std::cos(a));
                    const BallState end = result.motion.balls[0].at(2);
                    EXPECT_LE(relative_error(end.velocity.norm(), 2 * rate), 1e-12);
                    EXPECT_LE(relative_error((end.position - 0.1 * n).norm(), 2 * rate), 1e-12);
                    EXPECT_NEAR(end.position.dot(n), 0.1, 1e-12);
                    // Contacts that exist at time 0 give no row.
                    EXPECT_TRUE(result.motion.events.empty());
                }
}

TEST(ExactContact, UphillAndBack) {
    const Vec3 n = incline(20);
    const Vec3 up = -(Vec3(0, 0, -1) + n.z() * n).normalized();
    Scene scene = exact_scene(0.5, 0.5, kGravity);
    add_plane(scene, n);
    // Rolling from the start.
    Ball& ball = add_ball(scene, 0.1 * n, 2 * up);
    ball.spin = n.cross(ball.velocity) / 0.1;
    const double rate = kGravity * std::sin(20 * M_PI / 180) / 1.4;
    const SimulationResult result = run(scene, 4 / rate);
    const BallState back = result.motion.balls[0].at(4 / rate);
    EXPECT_LE((back.position - 0.1 * n).norm(), 1e-11);
    EXPECT_LE((back.velocity + 2 * up).norm(), 1e-11);
    // Sliding uphill at first: it loses its slip, rolls up, turns, and rolls back.
    scene.balls[0].spin.setZero();
    const SimulationResult slides = run(scene, 4);
    EXPECT_EQ(events_of(slides.motion, EventKind::kRoll).size(), 1u);
    const BallState later = slides.motion.balls[0].at(4);
    EXPECT_LE((later.spin - n.cross(later.velocity) / 0.1).norm(), 1e-10);
}

TEST(ExactContact, LeavesABoxAtItsEdge) {
    Scene scene = exact_scene(0.5, 0, kGravity);
    Surface table;
    table.name = "table";
    table.shape = BoxShape{Vec3(0, 0, -0.5), Vec3(2, 2, 1), Quat::Identity()};
    table.material = 2;
    scene.surfaces.push_back(table);
    add_ball(scene, Vec3(0, 0, 0.1), Vec3(2, 0, 0));  // v^2 = 4 > g R
    const SimulationResult result = run(scene, 1);
    const std::vector<Event> leaves = events_of(result.motion, EventKind::kLeave);
    ASSERT_EQ(leaves.size(), 1u);
    EXPECT_NEAR(leaves[0].time, 0.5, 1e-12);
    const BallState end = result.motion.balls[0].at(1);
    EXPECT_NEAR(end.position.x(), 2, 1e-12);
    EXPECT_NEAR(end.position.z(), 0.1 - kGravity / 2 * 0.25, 1e-12);
}

// ---- The closed form by itself
// --------------------------------------------------------------------

FlatContact level(double mu, double k = kSolid) {
    return {Vec3::UnitZ(), 0.1, k, mu, Vec3(0, 0, -kGravity)};
}

TEST(FlatContact, Kinds) {
    const auto kind = [](const FlatContact& c, const Velocities& v) {
        return flat_motion(c, v, 1e-13).value().kind;
    };
    EXPECT_EQ(kind(level(0), {}), EventKind::kRest);
    EXPECT_EQ(kind(level(0.3), {}), EventKind::kRest);
    EXPECT_EQ(kind(level(0), {Vec3(1, 0, 0), Vec3::Zero()}), EventKind::kSlide);
    EXPECT_EQ(kind(level(0.3), {Vec3(1, 0, 0), Vec3::Zero()}), EventKind::kSlide);
    EXPECT_EQ(kind(level(0.3), {Vec3(1, 0, 0), Vec3(0, 10, 0)}), EventKind::kRoll);
    // Spin about the normal does not keep it from resting.
    EXPECT_EQ(kind(level(0.3), {Vec3::Zero(), Vec3(0, 0, 5)}), EventKind::kRest);
    // Spin alone makes it slide.
    EXPECT_EQ(kind(level(0.3), {Vec3::Zero(), Vec3(0, 10, 0)}), EventKind::kSlide);
}

TEST(FlatContact, SlipThatTurnsHasNoClosedForm) {
    FlatContact slope = level(0.3);
    slope.gravity = Vec3(1, 0, -9);
    EXPECT_TRUE(flat_motion(slope, {Vec3(2, 0, 0), Vec3::Zero()}, 1e-13).has_value());
    EXPECT_TRUE(flat_motion(slope, {Vec3(-2, 0, 0), Vec3::Zero()}, 1e-13).has_value());
    EXPECT_FALSE(flat_motion(slope, {Vec3(0, 2, 0), Vec3::Zero()}, 1e-13).has_value());
    slope.friction = 0;
    EXPECT_TRUE(flat_motion(slope, {Vec3(0, 2, 0), Vec3::Zero()}, 1e-13).has_value());
}

}  // namespace
}  // namespace carom::testing
