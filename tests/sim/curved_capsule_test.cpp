// One ball on a capsule (method exact): on its shaft as on a sphere and along it uniformly, rolling
// obliquely, over its caps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "curved_scenes.h"

namespace carom::testing {
namespace {

// Smooth, across a level shaft: as on a sphere, while the motion along it is uniform.
TEST(CurvedCapsule, BallSlidesOffShaft) {
    for (const double along : {0.0, 0.5, 2.0}) {
        Scene scene = exact_scene(0, 0, kGravity);
        add_surface(scene, "rail", CapsuleShape{Vec3(-5, 0, 0), Vec3(5, 0, 0), 0.2});
        const double a = 12 * M_PI / 180, D = 0.3;
        add_ball(scene, D * Vec3(0, std::sin(a), std::cos(a)), Vec3(along, 0, 0));
        const SimulationResult r = run(scene, 1.2);
        const Event leave = only(r.motion, EventKind::kLeave);
        const BallState s = r.motion.balls[0].at(leave.time);
        EXPECT_NEAR(leave.normal.z(), 2.0 / 3 * std::cos(a), kBound);
        EXPECT_NEAR(s.position.x(), along * leave.time, kBound);
        EXPECT_NEAR(energy(scene, s), energy(scene, r.motion.balls[0].at(0)), kBound);
    }
}

// Rolling obliquely on a level cylinder: with the angle a from the top, the speed u along the axis
// and the spin w_n about the normal, du/da = -L^2 R w_n, L^2 = k/(1+k), and R dw_n/da = u, so
// u = u0 cos(L (a - a0)) - L R w_n0 sin(L (a - a0)).
TEST(CurvedCapsule, BallRollsObliquelyOnShaft) {
    for (const double w_n : {0.0, 8.0, -8.0}) {
        Scene scene = exact_scene(0, 1e12, kGravity);
        add_surface(scene, "rail", CapsuleShape{Vec3(-5, 0, 0), Vec3(5, 0, 0), 0.2});
        const double a0 = 5 * M_PI / 180, D = 0.3, R = 0.1, u0 = 1.2;
        const double L = std::sqrt(kSolid / (1 + kSolid));
        const Vec3 n(0, std::sin(a0), std::cos(a0)), v(u0, 0, 0);
        add_ball(scene, D * n, v).spin = n.cross(v) / R + w_n * n;
        const SimulationResult r = run(scene, 1.2);
        const Event leave = only(r.motion, EventKind::kLeave);
        const Trajectory& ball = r.motion.balls[0];
        double worst = 0, drift = 0, slip = 0, changed = 0;
        for (int i = 0; i <= 200; ++i) {
            const BallState s = ball.at(leave.time * i / 200 * (1 - 1e-12));
            const Vec3 normal = Vec3(0, s.position.y(), s.position.z()).normalized();
            const double a = std::atan2(normal.y(), normal.z()) - a0;
            const double u = u0 * std::cos(L * a) - L * R * w_n * std::sin(L * a);
            worst = std::max(worst, std::abs(s.velocity.x() - u));
            changed = std::max(changed, std::abs(s.velocity.x() - u0));
            drift = std::max(drift, std::abs(energy(scene, s) / energy(scene, ball.at(0)) - 1));
            slip = std::max(slip, slip_of(scene.balls[0], s, normal).norm());
        }
        std::printf(
            "w_n = %g: u changes by %.3g, off by %.2g m/s; energy off by %.2g, slip %.2g m/s\n",
            w_n, changed, worst, drift, slip);
        EXPECT_GT(changed, 0.02);
        EXPECT_LT(worst, kBound);
        EXPECT_LT(drift, kBound);
        EXPECT_LT(slip, kBound);
    }
}

// Down the top of a sloping shaft, rolling: g sin / (1 + k), then over the cap.
TEST(CurvedCapsule, BallRollsDownShaftOverCap) {
    const double slope = 0.1, R = 0.1, D = 0.25;
    const Vec3 axis(std::cos(slope), 0, -std::sin(slope)), n(std::sin(slope), 0, std::cos(slope));
    Scene scene = exact_scene(0, 1e12, kGravity);
    add_surface(scene, "rail", CapsuleShape{Vec3::Zero(), 0.5 * axis, D - R});
    add_ball(scene, D * n + 0.1 * axis);
    const SimulationResult r = run(scene, 3);
    const double a = kGravity * std::sin(slope) / (1 + kSolid), t = std::sqrt(2 * 0.4 / a);
    const BallState end = r.motion.balls[0].at(t);
    EXPECT_LT((end.position - D * n - 0.5 * axis).norm(), kBound);
    EXPECT_NEAR(end.velocity.dot(axis), a * t, kBound);
    // On the cap (1 + k) v^2 / 2 grows by g D (cos slope - cos).
    const double v2 = a * t * a * t;
    const double expected =
        ((1 + kSolid) * v2 / (kGravity * D) + 2 * std::cos(slope)) / (3 + kSolid);
    const Event leave = only(r.motion, EventKind::kLeave);
    std::printf("cap: leaves at cos = %.12f, off by %.2g\n", leave.normal.z(),
                leave.normal.z() - expected);
    EXPECT_NEAR(leave.normal.z(), expected, kBound);
    EXPECT_GT(leave.time, t);
}

// Up a sloping shaft and back, rolling: as in a field of g sin / (1 + k).
TEST(CurvedCapsule, BallRollsUpShaftAndBack) {
    const double slope = 0.2, R = 0.1, D = 0.15, v0 = 1.5;
    const Vec3 axis(std::cos(slope), 0, std::sin(slope)), n(-std::sin(slope), 0, std::cos(slope));
    Scene scene = exact_scene(0, 0.5, kGravity);
    add_surface(scene, "rail", CapsuleShape{-3 * axis, 3 * axis, D - R});
    const Vec3 v = v0 * axis;
    add_ball(scene, D * n, v).spin = n.cross(v) / R;
    const SimulationResult r = run(scene, 2.5);
    const double a = -kGravity * std::sin(slope) / (1 + kSolid);
    for (const double t : {0.5, -v0 / a, 1.8, 2.5}) {
        const BallState s = r.motion.balls[0].at(t);
        const Vec3 expected = D * n + (v0 * t + 0.5 * a * t * t) * axis;
        EXPECT_LT((s.position - expected).norm(), kBound);
        const Vec3 turn = n.cross(axis) * ((v0 * t + 0.5 * a * t * t) / R);
        const Quat q(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
        EXPECT_LT(2 * (q.conjugate() * s.orientation).vec().norm(), 1e-11);
    }
    EXPECT_TRUE(r.motion.events.empty());
}

// Where friction fails while it rolls obliquely, the slip begins out of the plane of motion.
TEST(CurvedCapsule, ObliqueRollingBeginsToSlide) {
    Scene scene = exact_scene(0, 0.3, kGravity);
    add_surface(scene, "rail", CapsuleShape{Vec3(-5, 0, 0), Vec3(5, 0, 0), 0.2});
    const double a0 = 4 * M_PI / 180, D = 0.3, R = 0.1;
    const Vec3 n(0, std::sin(a0), std::cos(a0)), v(1, 0, 0);
    add_ball(scene, D * n, v).spin = n.cross(v) / R + 6 * n;
    const SimulationResult r = run(scene, 1.5);
    const Event slide = only(r.motion, EventKind::kSlide),
                leave = only(r.motion, EventKind::kLeave);
    ASSERT_GT(slide.time, 0.05);
    ASSERT_GT(leave.time, slide.time + 0.01);
    const Trajectory& ball = r.motion.balls[0];
    double before = energy(scene, ball.at(slide.time));
    EXPECT_NEAR(before, energy(scene, ball.at(0)), kBound);
    // Energy is lost by mu N |slip|: Simpson's rule over the phase.
    const auto power = [&](double t) {
        const BallState s = ball.at(t);
        const Vec3 normal = Vec3(0, s.position.y(), s.position.z()).normalized();
        const double across2 = s.velocity.squaredNorm() - std::pow(s.velocity.x(), 2);
        const double push = kGravity * normal.z() - across2 / D;
        return 0.3 * push * slip_of(scene.balls[0], s, normal).norm();
    };
    const int parts = 4000;
    const double h = (leave.time - slide.time) * (1 - 1e-12) / parts;
    double lost = 0;
    for (int i = 0; i < parts; ++i)
        lost += h / 6 *
                (power(slide.time + i * h) + 4 * power(slide.time + (i + 0.5) * h) +
                 power(slide.time + (i + 1) * h));
    const double after = energy(scene, ball.at(leave.time));
    std::printf("slides %.4f s to %.4f s, loses %.9g, work of friction %.9g m^2/s^2; %zu pieces\n",
                slide.time, leave.time, before - after, lost, ball.pieces().size());
    EXPECT_GT(before - after, 1e-4);
    EXPECT_NEAR(before - after, lost, 1e-10);
}

}  // namespace
}  // namespace carom::testing
