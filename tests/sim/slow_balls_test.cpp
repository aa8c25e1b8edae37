// Motion has no lowest speed, and rest no slip: slow balls between two surfaces (method exact).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "curved_scenes.h"

namespace carom::testing {
namespace {

constexpr double kRoot2 = 1.4142135623730951;

/// A groove along y of two planes at right angles, and the ball's place in it.
Scene groove(double restitution, double friction, double gravity = kGravity) {
    Scene scene = exact_scene(restitution, friction, gravity);
    use_pair(scene, 1);
    add_plane(scene, Vec3(1, 0, 1));
    add_plane(scene, Vec3(-1, 0, 1));
    return scene;
}

Vec3 in_groove(double y, double radius = 0.1) { return {0, y, kRoot2 * radius}; }

/// Rolling along the groove: the contacts are at radius / sqrt 2 from its axis.
Vec3 rolling_spin(double v, double radius = 0.1) { return {-v * kRoot2 / radius, 0, 0}; }

/// An end wall without friction, which a ball of radius 0.1 meets at y.
void add_end_wall(Scene& scene, double y) {
    add_plane(scene, -Vec3::UnitY(), -(y + 0.1));
    scene.surfaces.back().material = 0;
    scene.materials[0].friction = 0;
}

TEST(SlowBalls, GoOnComeBackAndPassTheirSpeedOn) {
    double worst = 0;
    for (const double v : {1e-7, 1e-6, 4e-5, 1e-3, 3e-3, 0.2}) {
        // To the wall in 1 s, back in 1 s, and on to the other ball in 1 s.
        Scene scene = groove(1, 0);
        add_end_wall(scene, v);
        add_ball(scene, in_groove(0), Vec3(0, v, 0));
        add_ball(scene, in_groove(-0.2 - v));
        const SimulationResult r = run(scene, 5);
        EXPECT_EQ(r.report.steps, 0);
        ASSERT_EQ(impacts_of(r.motion).size(), 2u) << v;
        const auto y = [&](std::size_t ball, double t) {
            return r.motion.balls[ball].at(t).position.y();
        };
        worst = std::max({worst, std::abs(y(0, 0.5) - 0.5 * v), std::abs(y(0, 2)),
                          std::abs(y(0, 5) + v), std::abs(y(1, 2.5) + 0.2 + v),
                          std::abs(y(1, 5) + 0.2 + 3 * v)});
        EXPECT_LE(relative_error(r.motion.balls[1].at(5).velocity.y(), -v), 1e-9);
        EXPECT_LE(r.motion.balls[0].at(5).velocity.norm(), 1e-9 * v);
    }
    std::printf("places off by %.2g m (1e-12)\n", worst);
    EXPECT_LE(worst, 1e-12);
}

TEST(SlowBalls, SeparateAsSlowlyAsTheirRowsSay) {
    for (const double e : {0.0, 0.5, 0.9})
        for (const double v : {1e-6, 2e-3}) {
            Scene scene = groove(1, 0);
            scene.pairs.front().restitution = e;
            add_ball(scene, in_groove(-0.2 - v), Vec3(0, v, 0));
            add_ball(scene, in_groove(0));
            const SimulationResult r = run(scene, 3);
            const std::vector<Event> impacts = impacts_of(r.motion);
            ASSERT_EQ(impacts.size(), 1u);
            EXPECT_NEAR(impacts[0].separation_speed, e * v, 1e-15);
            const double first = r.motion.balls[0].at(3).velocity.y();
            const double second = r.motion.balls[1].at(3).velocity.y();
            EXPECT_NEAR(first, 0.5 * (1 - e) * v, 1e-9 * v) << "e " << e;
            EXPECT_NEAR(second, 0.5 * (1 + e) * v, 1e-9 * v) << "e " << e;
        }
}

// Along the groove rolling has k' = k R^2 / d^2, d = R / sqrt 2. The wall turns v, not the spin;
// friction then makes both one again: v' = -v (1 - k') / (1 + k').
TEST(SlowBalls, RollOnAndComeBackRolling) {
    double off = 0, slip = 0;
    for (const double v : {1e-6, 5e-5, 3e-3})
        for (const double k : {kSolid, 0.1}) {
            Scene scene = groove(1, 0.3);
            add_end_wall(scene, v);
            Ball& ball = add_ball(scene, in_groove(0), Vec3(0, v, 0));
            ball.spin = rolling_spin(v);
            ball.inertia_factor = k;
            const SimulationResult r = run(scene, 20);
            const double after = -v * (1 - 2 * k) / (1 + 2 * k);
            const BallState before = r.motion.balls[0].at(0.9), end = r.motion.balls[0].at(20);
            off = std::max({off, std::abs(before.velocity.y() / v - 1),
                            std::abs((end.velocity.y() - after) / v)});
            slip = std::max(slip, std::abs(end.velocity.y() + end.spin.x() * 0.1 / kRoot2) / v);
        }
    std::printf("speeds off by %.2g, slip %.2g of the speed (1e-9)\n", off, slip);
    EXPECT_LE(off, 1e-9);
    EXPECT_LE(slip, 1e-9);
}

// Whatever the size and gravity, a ball that rolls along a floor and a wall goes on.
TEST(SlowBalls, RollAlongTwoWallsOfAnySize) {
    double worst = 0;
    for (const double radius : {1e-4, 0.1, 3.0})
        for (const double gravity : {0.1, 9.81})
            for (const double part : {1e-6, 1e-4}) {
                const double v = part * std::sqrt(gravity * radius);
                Scene scene = groove(0.5, 0.3, gravity);
                Ball& ball = add_ball(scene, in_groove(0, radius), Vec3(0, v, 0), radius);
                ball.spin = rolling_spin(v, radius);
                const SimulationResult r = run(scene, 50);
                const BallState end = r.motion.balls[0].at(50);
                EXPECT_TRUE(r.motion.events.empty());
                worst = std::max({worst, std::abs(end.position.y() / (50 * v) - 1),
                                  (end.spin - ball.spin).norm() / ball.spin.norm()});
            }
    std::printf("way and spin within %.2g (1e-9)\n", worst);
    EXPECT_LE(worst, 1e-9);
}

// ---- Ends of bouncing series
// ----------------------------------------------------------------------

/// A drop of h that bounces until t = sqrt(2 h / g) (1 + e) / (1 - e).
double series_end(double h, double e) { return std::sqrt(2 * h / kGravity) * (1 + e) / (1 - e); }

TEST(SlowBalls, RestInAGrooveBeginsAtTheEndOfItsBounces) {
    double worst = 0;
    for (const double e : {0.0, 0.3, 0.5, 0.9})
        for (const double friction : {0.0, 0.4}) {
            Scene scene = groove(e, friction);
            add_ball(scene, in_groove(0) + Vec3(0, 0, 0.5));
            const double end = series_end(0.5, e);
            const SimulationResult r = run(scene, end + 1);
            const std::vector<Event> rests = events_of(r.motion, EventKind::kRest);
            ASSERT_EQ(rests.size(), 2u) << "e " << e;
            for (const Event& row : rests) worst = std::max(worst, std::abs(row.time - end));
            EXPECT_EQ(r.motion.balls[0].at(end + 1).velocity.norm(), 0);
            EXPECT_EQ(r.report.steps, 0);
        }
    std::printf("rows within %.2g s (1e-12)\n", worst);
    EXPECT_LE(worst, 1e-12);
}

// Hops so low that they are summed from the start: what presses on both sides together is
// m (g t - v_z), sqrt 2 times as much on the planes.
TEST(SlowBalls, BouncesInAGrooveCarryTheirFriction) {
    double worst = 0;
    for (const double e : {0.3, 0.6, 0.9})
        for (const double mu : {0.1, 0.3}) {
            const double v0 = 20, v_z = 1e-6, t = 1;
            Scene scene = groove(e, mu);
            add_ball(scene, in_groove(0), Vec3(0, v0, v_z));
            const SimulationResult r = run(scene, t);
            EXPECT_EQ(r.report.steps, 0);
            EXPECT_EQ(r.report.impacts, 0);
            const BallState end = r.motion.balls[0].at(t);
            const double lost = kRoot2 * mu * (kGravity * t - v_z);
            worst = std::max({worst, std::abs(end.velocity.y() - (v0 - lost)),
                              std::abs(-0.1 * end.spin.x() - lost / kRoot2 / kSolid)});
        }
    std::printf("speeds within %.2g m/s (1e-12)\n", worst);
    EXPECT_LE(worst, 1e-12);
}

// The lower ball is so heavy that it is a floor.
TEST(SlowBalls, RestOnABallBeginsAtTheEndOfItsBounces) {
    for (const double e : {0.3, 0.7}) {
        Scene scene = exact_scene(e, 0, kGravity);
        use_pair(scene, e);
        add_plane(scene);
        add_ball(scene, Vec3(0, 0, 0.1)).mass = 1e15;
        add_ball(scene, Vec3(0, 0, 0.3 + 0.2));
        const double end = series_end(0.2, e);
        const SimulationResult r = run(scene, end + 0.2);
        const std::vector<Event> rests = events_of(r.motion, EventKind::kRest);
        ASSERT_EQ(rests.size(), 1u) << e;
        std::printf("e %g: the row is %.2g s off (1e-12)\n", e, rests[0].time - end);
        EXPECT_NEAR(rests[0].time, end, 1e-12);
    }
}

// ---- Single balls among islands
// -----------------------------------------------------------------------

// A ball that rolls between a floor and a wall hits one that lies on the floor alone: that one
// needs no step.
TEST(SlowBalls, ALoneBallThatIsHitTakesNoStep) {
    for (const double v : {1e-4, 1.0}) {
        Scene scene = exact_scene(0.9, 0, kGravity);
        use_pair(scene, 0.9);
        add_plane(scene);
        add_plane(scene, Vec3::UnitX());
        add_ball(scene, Vec3(0.1, 0, 0.1), Vec3(0, v, 0));
        add_ball(scene, Vec3(0.2, std::sqrt(0.03) + v, 0.1));
        const SimulationResult r = run(scene, 2);
        const std::vector<Event> impacts = impacts_of(r.motion);
        ASSERT_FALSE(impacts.empty());
        EXPECT_NEAR(impacts[0].time, 1, 1e-9);
        EXPECT_EQ(r.report.steps, 0);
        // Along the line of centres, 30 degrees off; the wall holds the first one.
        const Vec3 n(0.5, std::sqrt(0.75), 0);
        const Vec3 second = r.motion.balls[1].at(2).velocity;
        EXPECT_LE((second - second.dot(n) * n).norm(), 1e-12 * v);
        EXPECT_GT(second.norm(), 0.5 * v);
    }
}

// ---- Rest
// ------------------------------------------------------------------------------------------

// Balls that ODE brings to rest do not slip on what they touch.
TEST(SlowBalls, RestHasNoSlip) {
    Scene scene = exact_scene(0.5, 0.3, kGravity);
    use_pair(scene, 0.5, 0.3);
    add_plane(scene);
    for (const double side : {-1.0, 1.0}) {
        add_plane(scene, side * Vec3::UnitX(), -0.25);
        add_plane(scene, side * Vec3::UnitY(), -0.25);
    }
    for (int i = 0; i < 8; ++i)
        add_ball(scene, Vec3(-0.12 + 0.24 * (i % 2) + 0.01 * std::sin(7.0 * i),
                             -0.12 + 0.24 * (i / 2 % 2), 0.3 + 0.23 * (i / 4)))
            .spin = Vec3(1, 2, 3);
    const SimulationResult r = run(scene, 6);
    int resting = 0;
    double slip = 0;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const BallState s = r.motion.balls[i].at(6);
        if (s.velocity.norm() > 0) continue;
        ++resting;
        for (const Surface& surface : scene.surfaces) {
            const auto& plane = std::get<PlaneShape>(surface.shape);
            const double gap = plane.normal.dot(s.position) - plane.offset_m - 0.1;
            if (gap > 1e-9) continue;
            slip = std::max(slip, slip_of(scene.balls[i], s, plane.normal).norm());
        }
    }
    std::printf("%d rest, slip %.2g m/s (1e-15)\n", resting, slip);
    EXPECT_GT(resting, 3);
    EXPECT_LE(slip, 1e-15);
}

TEST(SlowBalls, DurationRestSaysWhatItWaitsFor) {
    Scene scene = exact_scene(0.5, 0.3, kGravity);
    add_plane(scene);
    add_ball(scene, Vec3(0, 0, 0.1));
    Ball& rolling = add_ball(scene, Vec3(3, 0, 0.1), Vec3(0.5, 0, 0));
    rolling.spin = Vec3(0, 5, 0);
    scene.simulation.duration.reset();
    scene.simulation.max_duration = 4;
    for (const Method method : {Method::kExact, Method::kFixed}) {
        scene.simulation.method = method;
        const SimulationResult r = simulate(scene);
        EXPECT_EQ(r.motion.duration, 4);
        const std::string does = method == Method::kExact ? "rolls on plane0" : "moves";
        EXPECT_EQ(r.report.unrest,
                  "duration: rest ends at max_duration, 4 s: ball1 " + does + " at 0.5 m/s");
    }
    scene.balls[1].velocity.setZero();
    scene.balls[1].spin.setZero();
    scene.simulation.method = Method::kExact;
    EXPECT_EQ(simulate(scene).report.unrest, "");
}

}  // namespace
}  // namespace carom::testing
