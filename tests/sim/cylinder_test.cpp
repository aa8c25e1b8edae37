// One ball on a cylinder (method exact): off its shaft, its ends and its rims, against closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "curved_scenes.h"
#include "geometry/nearest.h"

namespace carom::testing {
namespace {

constexpr double kCylinderR = 0.4;  ///< of the cylinders that stand upright, their tops at z = 0, m
constexpr double kBall = 0.1;

const CylinderShape kDrum{Vec3(0, 0, -1), Vec3::Zero(), kCylinderR};

Scene on_drum(double restitution, double friction) {
    Scene scene = exact_scene(restitution, friction, kGravity);
    add_surface(scene, "drum", kDrum);
    return scene;
}

/// Drops a ball by `fall` [m] so that it meets a surface with the normal n at the place `met` of
/// its centre: v -> v - (1 + e) (v.n) n.
void expect_reflection(Scene scene, const Vec3& met, const Vec3& n, double e, const char* what) {
    const double fall = 0.7, t = std::sqrt(2 * fall / kGravity);
    add_ball(scene, met + fall * Vec3::UnitZ());
    const SimulationResult r = run(scene, t + 0.05);
    const std::vector<Event> impacts = impacts_of(r.motion);
    ASSERT_EQ(impacts.size(), 1u) << what;
    EXPECT_NEAR(impacts[0].time, t, 1e-15) << what;
    EXPECT_LT((impacts[0].normal - n).norm(), 1e-14) << what;
    const Vec3 before(0, 0, -kGravity * t);
    const Vec3 after = before - (1 + e) * before.dot(n) * n;
    EXPECT_LT((r.motion.balls[0].at(t + 1e-15).velocity - after).norm(), 1e-13) << what;
}

TEST(Cylinder, ADroppedBallIsReflectedAboutTheNormal) {
    for (const double e : {1.0, 0.6}) {
        const Scene scene = on_drum(e, 0);
        expect_reflection(scene, {0.2, 0.1, kBall}, Vec3::UnitZ(), e, "the end");
        const double out = 0.06, up = 0.08;  // 3-4-5 with the ball's radius
        const Vec3 outward(0.6, 0.8, 0);
        expect_reflection(scene, (kCylinderR + out) * outward + up * Vec3::UnitZ(),
                          0.6 * outward + 0.8 * Vec3::UnitZ(), e, "the rim");
        Scene lying = exact_scene(e, 0, kGravity);
        add_surface(lying, "roller", CylinderShape{Vec3(-1, 0, 0), Vec3(1, 0, 0), kCylinderR});
        expect_reflection(lying, (kCylinderR + kBall) * Vec3(0, 0.6, 0.8), Vec3(0, 0.6, 0.8), e,
                          "the shaft");
        expect_reflection(lying, {1 + 0.06, 0, kCylinderR + 0.08}, Vec3(0.6, 0, 0.8), e,
                          "the upright rim");
    }
}

/// Straight out over the rim it pivots as about an edge: with (1 + k) v^2 / 2 + g r cos constant it
/// leaves where v^2 = g r cos.
TEST(Cylinder, ABallRollsOverTheRimAndLeaves) {
    for (const double azimuth : {0.0, 0.7})
        for (const double v0 : {1e-3, 0.4, 0.9}) {
            Scene scene = on_drum(0, 1e12);
            const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
            const double to_rim = 0.15;
            add_ball(scene, Vec3(0, 0, kBall) + (kCylinderR - to_rim) * outward, v0 * outward)
                .spin = Vec3::UnitZ().cross(v0 * outward) / kBall;
            const SimulationResult r = run(scene, to_rim / v0 + 1.2);
            const Event leave = only(r.motion, EventKind::kLeave);
            const double expected =
                ((1 + kSolid) * v0 * v0 / (kGravity * kBall) + 2) / (3 + kSolid);
            std::printf("v0 = %g: leaves at cos = %.12f, off by %.2g\n", v0, leave.normal.z(),
                        leave.normal.z() - expected);
            EXPECT_NEAR(leave.normal.z(), expected, kBound);
            EXPECT_GT(leave.time, to_rim / v0);
            EXPECT_NEAR(leave.normal.dot(Vec3::UnitZ().cross(outward)), 0, kBound);
        }
}

/// Too fast for the rim to hold: it flies off the border at once.
TEST(Cylinder, AFastBallFliesOffTheEnd) {
    Scene scene = on_drum(0, 0);
    add_ball(scene, Vec3(0, 0, kBall), Vec3(1.5, 0, 0));  // v^2 > g r
    const SimulationResult r = run(scene, 0.4);
    const Event leave = only(r.motion, EventKind::kLeave);
    EXPECT_NEAR(leave.time, kCylinderR / 1.5, 1e-14);
    EXPECT_NEAR(leave.normal.z(), 1, 1e-14);
}

/// Smooth, out over the rim beside the middle: energy and the moment about the axis stay, and the
/// normal force g cos - r a'^2 - (R + r sin) b'^2 sin is 0 where it leaves, with a from the top and
/// b around the axis.
TEST(Cylinder, ASmoothBallKeepsItsMomentAboutTheAxisOnTheRim) {
    for (const double aside : {0.1, 0.3, 0.39}) {
        Scene scene = on_drum(0, 0);
        add_ball(scene, Vec3(0, aside, kBall), Vec3(0.5, 0, 0));
        const double end = std::sqrt(kCylinderR * kCylinderR - aside * aside) / 0.5;
        const SimulationResult r = run(scene, end + 1);
        const Event leave = only(r.motion, EventKind::kLeave);
        ASSERT_GT(leave.time, end + 1e-3);
        const Trajectory& ball = r.motion.balls[0];
        double worst = 0, off = 0, turned = 0;
        for (int i = 0; i <= 200; ++i) {
            const BallState s = ball.at(end + (leave.time - end) * i / 200 * (1 - 1e-12));
            const double moment = s.position.x() * s.velocity.y() - s.position.y() * s.velocity.x();
            worst = std::max({worst, std::abs(moment + 0.5 * aside),
                              std::abs(energy(scene, s) - energy(scene, ball.at(0)))});
            off = std::max(off, std::abs(nearest_on(kDrum, s.position, kBall).gap));
            turned = std::atan2(s.position.y(), s.position.x());
        }
        const Vec3 n = leave.normal;
        const BallState s = ball.at(leave.time * (1 - 1e-15));
        const double away = std::hypot(s.position.x(), s.position.y());
        const Vec3 around = Vec3(-s.position.y(), s.position.x(), 0) / away;
        const double v_around = around.dot(s.velocity), sine = std::hypot(n.x(), n.y());
        const double v_down = (s.velocity - v_around * around).norm();
        const double force =
            kGravity * n.z() - v_down * v_down / kBall - v_around * v_around / away * sine;
        std::printf(
            "%.2f m aside: turns to %.3f rad; moment and energy off by %.2g, gap %.2g m, "
            "force at the end %.2g m/s^2\n",
            aside, turned, worst, off, force);
        EXPECT_LT(worst, kBound);
        EXPECT_LT(off, 1e-14);
        EXPECT_NEAR(force, 0, 1e-10);
    }
}

/// Rolling beside the middle the spin about the normal comes in: energy stays, and nothing slips.
TEST(Cylinder, ABallThatRollsObliquelyOverTheRimKeepsItsEnergy) {
    Scene scene = on_drum(0, 1e12);
    const Vec3 v(0.5, 0, 0);
    add_ball(scene, Vec3(0, 0.25, kBall), v).spin =
        Vec3::UnitZ().cross(v) / kBall + 9 * Vec3::UnitZ();
    const double end = std::sqrt(kCylinderR * kCylinderR - 0.25 * 0.25) / 0.5;
    const SimulationResult r = run(scene, end + 1);
    const Event leave = only(r.motion, EventKind::kLeave);
    const Trajectory& ball = r.motion.balls[0];
    double drift = 0, slip = 0;
    for (int i = 0; i <= 200; ++i) {
        const BallState s = ball.at(leave.time * i / 200 * (1 - 1e-12));
        drift = std::max(drift, std::abs(energy(scene, s) / energy(scene, ball.at(0)) - 1));
        const Vec3 n = nearest_on(kDrum, s.position, kBall).normal;
        slip = std::max(slip, slip_of(scene.balls[0], s, n).norm());
    }
    std::printf("energy off by %.2g, slip %.2g m/s\n", drift, slip);
    EXPECT_LT(drift, kBound);
    EXPECT_LT(slip, kBound);
    EXPECT_GT(leave.time, end);
}

/// Down the top of a sloping shaft, and over the rim of its end.
TEST(Cylinder, ABallSlidesDownTheShaftOverTheRim) {
    const double slope = 0.1;
    const Vec3 axis(std::cos(slope), 0, -std::sin(slope)), n(std::sin(slope), 0, std::cos(slope));
    Scene scene = exact_scene(0, 0, kGravity);
    add_surface(scene, "roller", CylinderShape{Vec3::Zero(), 0.5 * axis, kCylinderR});
    add_ball(scene, (kCylinderR + kBall) * n + 0.1 * axis);
    const double a = kGravity * std::sin(slope), t = std::sqrt(2 * 0.4 / a);
    const SimulationResult r = run(scene, t + 1);
    const BallState end = r.motion.balls[0].at(t);
    EXPECT_LT((end.position - (kCylinderR + kBall) * n - 0.5 * axis).norm(), kBound);
    EXPECT_NEAR(end.velocity.dot(axis), a * t, kBound);
    // v^2 / 2 grows by g r (cos slope - cos).
    const double v2 = a * t * a * t;
    const double expected = (v2 / (kGravity * kBall) + 2 * std::cos(slope)) / 3;
    const Event leave = only(r.motion, EventKind::kLeave);
    EXPECT_NEAR(leave.normal.z(), expected, kBound);
}

TEST(Cylinder, ABallRestsOnTheEnd) {
    Scene scene = on_drum(0.5, 0.4);
    add_ball(scene, Vec3(0.1, 0.2, 0.6));
    const SimulationResult r = run(scene, 6);
    EXPECT_EQ(only(r.motion, EventKind::kRest).other.index, 0);
    EXPECT_NEAR(r.motion.balls[0].at(6).position.z(), kBall, 1e-14);
}

/// Between drum and floor: a ball that leans on both slips nowhere and gains nothing.
TEST(Cylinder, ABallRollsAlongTheFootOfADrum) {
    Scene scene = exact_scene(1, 0, kGravity);
    add_surface(scene, "drum", CylinderShape{Vec3(0, 0, 0), Vec3(0, 0, 1), kCylinderR});
    add_plane(scene);
    // Towards the drum at an angle, without loss: off it, and on over the floor.
    add_ball(scene, Vec3(-1, 0.3, kBall), Vec3(2, 0, 0));
    const SimulationResult r = run(scene, 1);
    const std::vector<Event> impacts = impacts_of(r.motion);
    ASSERT_EQ(impacts.size(), 1u);
    const double met = std::sqrt(0.25 - 0.09);  // R + r = 0.5
    EXPECT_NEAR(impacts[0].time, (1 - met) / 2, 1e-14);
    const Vec3 n(-met / 0.5, 0.3 / 0.5, 0), v(2, 0, 0);
    EXPECT_LT((r.motion.balls[0].at(1).velocity - (v - 2 * v.dot(n) * n)).norm(), 1e-13);
    EXPECT_NEAR(r.motion.balls[0].at(1).position.z(), kBall, 1e-14);
}

/// The method `fixed` meets it too: within what a step tells.
TEST(Cylinder, FixedStepsMeetEndsAndRims) {
    Scene scene = scene_of(0.5, 0, kGravity, 1e-4);
    add_surface(scene, "drum", kDrum);
    const double t = std::sqrt(2 * 0.5 / kGravity);
    add_ball(scene, Vec3(0.1, 0, kBall + 0.5));
    add_ball(scene, Vec3(kCylinderR + 0.06, 0, 0.08 + 0.5));
    const SimulationResult r = run(scene, t + 0.1);
    const std::vector<Event> impacts = impacts_of(r.motion);
    ASSERT_EQ(impacts.size(), 2u);
    for (const Event& hit : impacts) {
        EXPECT_NEAR(hit.time, t, 2e-4);
        const Vec3 n = hit.ball == 0 ? Vec3::UnitZ() : Vec3(0.6, 0, 0.8);
        EXPECT_LT((hit.normal - n).norm(), 5e-3);
        EXPECT_NEAR(hit.separation_speed / hit.approach_speed, 0.5, 1e-9);
    }
}

}  // namespace
}  // namespace carom::testing
