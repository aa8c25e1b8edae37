// Balls that touch something at time 0 and approach it: an impact at once (method exact).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "curved_scenes.h"

namespace carom::testing {
namespace {

/// Of speeds relative to the one at the start.
constexpr double kSpeedBound = 1e-14;

std::vector<Event> rows_at_start(const Motion& motion) {
    std::vector<Event> rows;
    for (const Event& e : motion.events)
        if (e.time == 0) rows.push_back(e);
    return rows;
}

TEST(ExactStart, AnApproachIsAnImpact) {
    double worst = 0;
    for (const double e : {0.0, 0.1, 0.5, 0.9, 1.0})
        for (const double v : {1e-3, 2.0, 300.0})
            for (const double radius : {1e-3, 0.1, 5.0}) {
                Scene scene = exact_scene(e, 0, kGravity);
                add_plane(scene);
                add_ball(scene, Vec3(0, 0, radius), Vec3(0, 0, -v), radius);
                const double next = 2 * e * v / kGravity;
                const SimulationResult r = run(scene, 1.5 * next + 1e-3);
                const std::vector<Event> rows = rows_at_start(r.motion);
                ASSERT_EQ(rows.size(), 1u) << "e " << e << ", v " << v;
                EXPECT_EQ(rows[0].kind, EventKind::kImpact);
                EXPECT_EQ(rows[0].approach_speed, v);
                EXPECT_LE(relative_error(rows[0].separation_speed, e * v), kSpeedBound);
                EXPECT_LE(relative_error(rows[0].impulse, (1 + e) * v), kSpeedBound);
                const BallState top = r.motion.balls[0].at(0.5 * next);
                worst = std::max(worst, std::abs(top.velocity.z()) / v);
                EXPECT_NEAR(top.position.z(), radius + e * e * v * v / (2 * kGravity),
                            1e-13 * (radius + v * v));
                if (e == 0) continue;
                const std::vector<Event> impacts = impacts_of(r.motion);
                ASSERT_GE(impacts.size(), 2u);
                EXPECT_LE(relative_error(impacts[1].time, next), 1e-12);
            }
    std::printf("speeds at the top up to %.2g v (%g)\n", worst, kSpeedBound);
    EXPECT_LE(worst, kSpeedBound);
}

// As H13 has it, on slopes and with spin. The slip s = v - R w x n loses (1 + 1/k) f by an impulse
// f per mass, at most mu (1 + e) v_n.
TEST(ExactStart, OnSlopesWithFrictionAndSpin) {
    double worst = 0;
    int gripped = 0, slipped = 0;
    for (const double degrees : {0.0, 25.0, 60.0})
        for (const double azimuth : {0.0, 37.0, 211.0})
            for (const double mu : {0.05, 0.6})
                for (const double k : {kSolid, kShell}) {
                    const double e = 0.7, v_n = 1.5, radius = 0.08;
                    const Vec3 n = incline(degrees, azimuth);
                    const Vec3 t = n.cross(Vec3(0.3, 0.8, 0.1)).normalized();
                    Scene scene = exact_scene(e, mu, kGravity);
                    add_plane(scene, n);
                    Ball& ball = add_ball(scene, radius * n, 2 * t - v_n * n, radius);
                    ball.inertia_factor = k;
                    ball.spin = Vec3(4, -7, 9);
                    const Vec3 slip = slip_of(ball, {{}, ball.velocity, {}, ball.spin}, n);
                    const double limit = mu * (1 + e) * v_n, grip = slip.norm() / (1 + 1 / k);
                    (grip < limit ? gripped : slipped) += 1;
                    const Vec3 f = -std::min(limit, grip) * slip.normalized();
                    const SimulationResult r = run(scene, 0.01);
                    const BallState after = r.motion.balls[0].at(0);
                    worst = std::max(
                        {worst, (after.velocity - (2 * t + e * v_n * n + f)).norm(),
                         radius * (after.spin - (ball.spin - n.cross(f) / (k * radius))).norm()});
                    ASSERT_EQ(rows_at_start(r.motion).size(), 1u);
                    EXPECT_LE(
                        relative_error(rows_at_start(r.motion)[0].tangential_impulse, f.norm()),
                        1e-13);
                }
    std::printf("%d grip, %d slip; velocities within %.2g m/s (1e-14)\n", gripped, slipped, worst);
    EXPECT_GT(gripped, 0);
    EXPECT_GT(slipped, 0);
    EXPECT_LE(worst, 1e-14);
}

TEST(ExactStart, SeveralContactsAreMetAtOnce) {
    for (const double e : {0.3, 1.0}) {
        // Three walls at right angles: each takes its own part of the velocity.
        Scene corner = exact_scene(e, 0, kGravity);
        add_plane(corner);
        add_plane(corner, Vec3::UnitX());
        add_plane(corner, -Vec3::UnitY(), -1);
        add_ball(corner, Vec3(0.1, 0.9, 0.1), Vec3(-3, 2, -1));
        const Motion in_corner = run(corner, 0.01).motion;
        EXPECT_LE((in_corner.balls[0].at(0).velocity - e * Vec3(3, -2, 1)).norm(), 1e-14);
        EXPECT_EQ(rows_at_start(in_corner).size(), 3u);
        // Two of them lie still, one is met: what lasts gives no row.
        corner.balls[0].velocity = Vec3(-3, 0, 0);
        const Motion along = run(corner, 0.01).motion;
        EXPECT_LE((along.balls[0].at(0).velocity - Vec3(3 * e, 0, 0)).norm(), 1e-14);
        EXPECT_EQ(along.balls[0].at(0.01).position.z(), 0.1);
        ASSERT_EQ(along.events.size(), 1u);
        EXPECT_EQ(along.events[0].kind, EventKind::kImpact);
        // H11 from the start.
        Scene groove = exact_scene(e, 0, kGravity);
        add_plane(groove, Vec3(1, 0, 1));
        add_plane(groove, Vec3(-1, 0, 1));
        add_ball(groove, Vec3(0, 0, 0.1 * std::sqrt(2.0)), Vec3(0, 0.5, -2));
        const Motion in_groove = run(groove, 0.01).motion;
        EXPECT_LE((in_groove.balls[0].at(0).velocity - Vec3(0, 0.5, 2 * e)).norm(), 1e-14);
        EXPECT_EQ(rows_at_start(in_groove).size(), 2u);
    }
}

// Equal balls, e = 1: the upper one's speed goes down to the floor and comes back to it.
TEST(ExactStart, OnABallOnTheFloor) {
    for (const double v : {1e-4, 3.0}) {
        Scene scene = exact_scene(1, 0, kGravity);
        use_pair(scene, 1);
        add_plane(scene);
        add_ball(scene, Vec3(0, 0, 0.1));
        add_ball(scene, Vec3(0, 0, 0.3), Vec3(0, 0, -v));
        const Motion motion = run(scene, 1e-6).motion;
        EXPECT_LE(relative_error(motion.balls[1].at(0).velocity.z(), v), 1e-14);
        EXPECT_LE(motion.balls[0].at(0).velocity.norm(), 1e-14 * v);
        EXPECT_EQ(events_of(motion, EventKind::kImpact).size(), 2u);
    }
}

TEST(ExactStart, OverlapWithinTheContractIsTouching) {
    for (const double depth : {-0.0, 5e-11, 9e-11}) {
        Scene scene = exact_scene(0.5, 0, kGravity);
        add_plane(scene);
        add_ball(scene, Vec3(0, 0, 0.1 - depth), Vec3(0, 0, -2));
        const Motion motion = run(scene, 0.1).motion;
        EXPECT_NEAR(motion.balls[0].at(0.1).position.z(), 0.1 + 0.1 - kGravity * 0.005, 1e-15);
        ASSERT_EQ(motion.events.size(), 1u);
        EXPECT_EQ(motion.events[0].time, 0);
    }
}

/// What rounding or few digits leave across a slope is no bounce: its hop would be below 1e-12 R.
TEST(ExactStart, AnApproachBelowTheLastHopIsContact) {
    for (const double v : {0.0, 1e-17, 1e-9, 1e-6}) {
        Scene scene = exact_scene(0.5, 0, kGravity);
        add_plane(scene);
        add_ball(scene, Vec3(0, 0, 0.1), Vec3(1, 0, -v));
        const Motion motion = run(scene, 1).motion;
        EXPECT_TRUE(motion.events.empty()) << v;
        EXPECT_EQ(motion.balls[0].at(1).position, Vec3(1, 0, 0.1));
    }
}

}  // namespace
}  // namespace carom::testing
