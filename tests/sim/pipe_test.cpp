// One ball in, on and around a pipe (method exact), against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "curved_scenes.h"
#include "geometry/nearest.h"
#include "wandering.h"

namespace carom::testing {
namespace {

constexpr double kPipeR = 0.5, kPipeBall = 0.1;
constexpr double kPipeLength = kPipeR - kPipeBall;
constexpr double kTube = 7;  ///< rad: all around

Scene with_pipe(double angle, double restitution, double friction) {
    Scene scene = exact_scene(restitution, friction, kGravity);
    add_surface(scene, "pipe",
                PipeShape{Vec3(-2, 0, 0), Vec3(2, 0, 0), kPipeR, Vec3::UnitZ(), angle});
    return scene;
}

/// Across a level half pipe a smooth ball swings as a pendulum, while it goes along it uniformly.
TEST(Pipe, ABallSwingsInAHalfPipe) {
    for (const double a : {0.1, 0.8, 1.5}) {
        Scene scene = with_pipe(std::numbers::pi, 0, 0);
        const Vec3 start(-1.5, kPipeLength * std::sin(a), -kPipeLength * std::cos(a));
        add_ball(scene, start, Vec3(0.4, 0, 0));
        const double half =
            2 * std::sqrt(kPipeLength / kGravity) * std::comp_ellint_1(std::sin(a / 2));
        const SimulationResult r = run(scene, 4 * half);
        double worst = 0;
        for (int i = 1; i <= 4; ++i) {
            const Vec3 expected(start.x() + 0.4 * i * half, (i % 2 == 0 ? 1 : -1) * start.y(),
                                start.z());
            worst = std::max(worst, (r.motion.balls[0].at(i * half).position - expected).norm());
        }
        std::printf("from %.1f rad: four swings off by %.2g m\n", a, worst);
        EXPECT_LT(worst, 1e-11);
    }
}

/// In an upright tube a rolling ball does not fall through: it goes up and down as
/// z'' + k/(1+k) b'^2 (z - z0) = 0, with b' its constant rate around the axis (J. I. Neimark, N. A.
/// Fufaev, "Dynamics of Nonholonomic Systems", 1972, ch. II).
TEST(Pipe, ABallRollsUpAndDownInAnUprightTube) {
    Scene scene = exact_scene(0, 1e12, kGravity);
    add_surface(scene, "tube",
                PipeShape{Vec3(0, 0, -9), Vec3(0, 0, 2), kPipeR, Vec3::UnitX(), kTube});
    const double v = 6, turn = v / kPipeLength, rate = turn * std::sqrt(kSolid / (1 + kSolid));
    const Vec3 n(-1, 0, 0);
    add_ball(scene, Vec3(kPipeLength, 0, 0), Vec3(0, v, 0)).spin =
        n.cross(Vec3(0, v, 0)) / kPipeBall;
    const SimulationResult r = run(scene, 3);
    // From rest at the top: (1 + k) z'' = -g at the start.
    const double depth = kGravity / (1 + kSolid) / (rate * rate);
    double worst = 0;
    for (int i = 0; i <= 300; ++i) {
        const double t = 0.01 * i;
        const Vec3 expected(kPipeLength * std::cos(turn * t), kPipeLength * std::sin(turn * t),
                            -depth * (1 - std::cos(rate * t)));
        worst = std::max(worst, (r.motion.balls[0].at(t).position - expected).norm());
    }
    std::printf("goes down by %.3f m and up again; off by %.2g m\n", 2 * depth, worst);
    EXPECT_LT(worst, 1e-10);
}

/// v -> v - (1 + e) (v.n) n on the wall from both sides, on an edge, on an end and at a corner.
TEST(Pipe, BallsAreReflectedFromAllItsSides) {
    const double e = 0.6;
    const auto expect = [&](const Vec3& met, const Vec3& n, const Vec3& v) {
        Scene scene = with_pipe(std::numbers::pi, e, 0);
        scene.simulation.gravity.setZero();
        add_ball(scene, met - 0.1 * v, v);
        const SimulationResult r = run(scene, 0.11);
        const std::vector<Event> impacts = impacts_of(r.motion);
        ASSERT_EQ(impacts.size(), 1u) << n.transpose();
        EXPECT_NEAR(impacts[0].time, 0.1, 1e-15) << n.transpose();
        EXPECT_LT((impacts[0].normal - n).norm(), 1e-14) << n.transpose();
        EXPECT_LT((r.motion.balls[0].at(0.11).velocity - (v - (1 + e) * v.dot(n) * n)).norm(),
                  1e-13);
    };
    const Vec3 out(0, 0.6, -0.8), down(0, 0, -2), back(-2, 0, 0);
    expect(kPipeLength * out, -out, 2 * out);
    expect((kPipeR + kPipeBall) * out, out, Vec3(1, -1.6, 1.2));
    expect(Vec3(0.3, kPipeR, 0) + kPipeBall * Vec3(0, 0.6, 0.8), Vec3(0, 0.6, 0.8),
           down);  // an edge
    expect(Vec3(0.3, -kPipeR, 0) + kPipeBall * Vec3(0, 0.6, 0.8), Vec3(0, 0.6, 0.8), down);
    expect(Vec3(2, 0, 0) + kPipeR * out + kPipeBall * Vec3(0.8, 0.36, -0.48),
           Vec3(0.8, 0.36, -0.48),
           back);  // an end
    expect(Vec3(2, 0, 0) + kPipeR * out + kPipeBall * Vec3(0.8, -0.36, 0.48),
           Vec3(0.8, -0.36, 0.48), back);
    expect(Vec3(2, kPipeR, 0) + kPipeBall * Vec3(2, 1, 2) / 3, Vec3(2, 1, 2) / 3,
           down);  // a corner
}

/// Out of the end of a sloping pipe, rolling: over the arc in which it ends.
TEST(Pipe, ABallRollsOutOfItsEnd) {
    const double slope = 0.2;
    const Vec3 axis(std::cos(slope), 0, -std::sin(slope)), up(std::sin(slope), 0, std::cos(slope));
    Scene scene = exact_scene(0, 0.6, kGravity);
    add_surface(scene, "pipe", PipeShape{-axis, Vec3::Zero(), kPipeR, Vec3::UnitZ(), 2.5});
    add_ball(scene, -0.8 * axis - kPipeLength * up);
    const double a = kGravity * std::sin(slope) / (1 + kSolid), t = std::sqrt(2 * 0.8 / a);
    const SimulationResult r = run(scene, t + 0.5);
    const BallState end = r.motion.balls[0].at(t);
    EXPECT_LT((end.position + kPipeLength * up).norm(), kBound);
    EXPECT_NEAR(end.velocity.dot(axis), a * t, kBound);
    // v^2 = g r cos where it leaves the edge, or at once if it is faster.
    const double v2 = a * t * a * t;
    ASSERT_GT(v2, kGravity * kPipeBall * std::cos(slope));
    const Event leave = only(r.motion, EventKind::kLeave);
    EXPECT_NEAR(leave.time, t, 1e-12);
}

/// A ball too large for a half pipe rests on both edges, 3-4-5 above them, and slides along them.
TEST(Pipe, ALargeBallLiesOnBothEdges) {
    Scene scene = with_pipe(std::numbers::pi, 0.4, 0.3);
    const double radius = kPipeR / 0.8;  // the centre is 0.6 of the radius above the edges
    add_ball(scene, Vec3(0, 0.02, 0.6 * radius + 0.05), Vec3::Zero(), radius);
    const SimulationResult r = run(scene, 6);
    EXPECT_LT((r.motion.balls[0].at(6).position.tail<2>() - Vec2(0, 0.6 * radius)).norm(), 1e-9);
    for (const Event& event : r.motion.events) EXPECT_EQ(event.other.index, 0);
    EXPECT_EQ(r.motion.surface_names, std::vector<std::string>{"pipe"});
    Scene smooth = with_pipe(std::numbers::pi, 0.4, 0);
    add_ball(smooth, Vec3(-1, 0, 0.6 * radius), Vec3(0.5, 0, 0), radius);
    const BallState slid = run(smooth, 2).motion.balls[0].at(2);
    EXPECT_LT((slid.position - Vec3(0, 0, 0.6 * radius)).norm(), 1e-11);
}

/// In a long tube without loss.
TEST(Pipe, NoBallLeavesATubeThroughItsWall) {
    Scene scene = with_pipe(kTube, 1, 0);
    add_ball(scene, Vec3(0, 0.1, 0.05), Vec3(0.3, 1.7, 0.4));
    const auto [drift, farthest] =
        wandering(scene, [](const Vec3& p) { return p.tail<2>().norm(); });
    EXPECT_LT(drift, 1e-11);
    EXPECT_LT(farthest, kPipeLength + 1e-12);
}

}  // namespace
}  // namespace carom::testing
