// One ball on a ring (method exact): off its tube on all sides, through its hole, around its
// inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "curved_scenes.h"
#include "geometry/nearest.h"

namespace carom::testing {
namespace {

constexpr double kRingR = 0.4, kTube = 0.05, kRingBall = 0.1;
constexpr double kD = kRingBall + kTube;  ///< of a touching centre from the circle, m

const RingShape kLevel{Vec3::Zero(), Vec3::UnitZ(), kRingR, kTube};

Scene with_ring(const RingShape& ring, double restitution, double friction) {
    Scene scene = exact_scene(restitution, friction, kGravity);
    add_surface(scene, "ring", ring);
    return scene;
}

/// Drops a ball so that it meets the ring with the normal n.
void expect_reflection(const Vec3& n, double azimuth, double e) {
    Scene scene = with_ring(kLevel, e, 0);
    const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
    const Vec3 normal = n.x() * outward + n.z() * Vec3::UnitZ();
    const double fall = 0.7, t = std::sqrt(2 * fall / kGravity);
    add_ball(scene, kRingR * outward + kD * normal + fall * Vec3::UnitZ());
    const SimulationResult r = run(scene, t + 0.02);
    const std::vector<Event> impacts = impacts_of(r.motion);
    ASSERT_EQ(impacts.size(), 1u);
    EXPECT_NEAR(impacts[0].time, t, 2e-15);
    EXPECT_LT((impacts[0].normal - normal).norm(), 1e-14);
    const Vec3 before(0, 0, -kGravity * t);
    const Vec3 after = before - (1 + e) * before.dot(normal) * normal;
    EXPECT_LT((r.motion.balls[0].at(t + 1e-15).velocity - after).norm(), 2e-13);
}

TEST(Ring, ADroppedBallIsReflectedAboutTheNormal) {
    for (const double e : {1.0, 0.6})
        for (const double azimuth : {0.0, 0.7, 2.5})
            for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(-0.6, 0, 0.8)})
                expect_reflection(n, azimuth, e);
}

TEST(Ring, ABallFallsThroughTheHole) {
    Scene scene = with_ring(kLevel, 0.5, 0.3);
    const double room = kRingR - kD;
    add_ball(scene, Vec3(0, 0, 1));
    add_ball(scene, Vec3(0, room - 1e-9, 2));
    add_ball(scene, Vec3(room + 1e-9, 0, 3));
    const SimulationResult r = run(scene, 1.5);
    for (const Event& hit : impacts_of(r.motion)) EXPECT_EQ(hit.ball, 2);
    EXPECT_EQ(impacts_of(r.motion).front().ball, 2);
    for (const std::size_t i : {0u, 1u})
        EXPECT_NEAR(r.motion.balls[i].at(1.5).position.z(),
                    1.0 + static_cast<double>(i) - 0.5 * kGravity * 2.25, 1e-12);
}

/// An upright ring: a smooth ball inside it, in its plane, is a pendulum of the length R - d, whose
/// half a swing from rest takes 2 sqrt(L/g) K(sin(a/2)).
TEST(Ring, ABallSwingsInsideAnUprightRing) {
    const double length = kRingR - kD;
    for (const double a : {0.1, 1.0, 1.5}) {
        Scene scene = with_ring({Vec3::Zero(), Vec3::UnitY(), kRingR, kTube}, 0, 0);
        const Vec3 start(length * std::sin(a), 0, -length * std::cos(a));
        add_ball(scene, start);
        const double half = 2 * std::sqrt(length / kGravity) * std::comp_ellint_1(std::sin(a / 2));
        const SimulationResult r = run(scene, 4 * half);
        double worst = 0;
        for (int i = 1; i <= 4; ++i) {
            const Vec3 side(i % 2 == 0 ? 1 : -1, 1, 1);
            const BallState s = r.motion.balls[0].at(i * half);
            worst = std::max(
                {worst, (s.position - start.cwiseProduct(side)).norm(), s.velocity.norm() * half});
        }
        std::printf("from %.1f rad: four swings off by %.2g m\n", a, worst);
        EXPECT_LT(worst, 1e-11);
        EXPECT_TRUE(events_of(r.motion, EventKind::kLeave).empty());
    }
}

/// Round and round the inside of an upright ring, without loss: v^2 = v0^2 - 2 g L (1 - cos).
TEST(Ring, ABallLoopsTheLoopInsideARing) {
    const double length = kRingR - kD, v0 = std::sqrt(5.5 * kGravity * length);  // 5 g L holds
    Scene scene = with_ring({Vec3::Zero(), Vec3::UnitY(), kRingR, kTube}, 0, 0);
    add_ball(scene, Vec3(0, 0, -length), Vec3(v0, 0, 0));
    const SimulationResult r = run(scene, 3);
    EXPECT_TRUE(events_of(r.motion, EventKind::kLeave).empty());
    double worst = 0, off = 0;
    for (int i = 0; i <= 300; ++i) {
        const BallState s = r.motion.balls[0].at(0.01 * i);
        worst = std::max(worst, std::abs(s.velocity.squaredNorm() + 2 * kGravity * s.position.z() -
                                         v0 * v0 + 2 * kGravity * length));
        off = std::max(off, std::abs(s.position.norm() - length));
    }
    std::printf("energy off by %.2g m^2/s^2, place by %.2g m\n", 0.5 * worst, off);
    EXPECT_LT(worst, kBound * v0 * v0);
    EXPECT_LT(off, 1e-13);
    // A little slower it leaves where g cos = -v^2 / L, cos measured from below.
    Scene slow = with_ring({Vec3::Zero(), Vec3::UnitY(), kRingR, kTube}, 0, 0);
    add_ball(slow, Vec3(0, 0, -length), Vec3(std::sqrt(4 * kGravity * length), 0, 0));
    const Event leave = only(run(slow, 0.5).motion, EventKind::kLeave);
    EXPECT_NEAR(leave.normal.z(), -2.0 / 3, kBound);
}

/// Smooth, on top of a level ring, and along it: energy and the moment about the axis stay, and the
/// normal force g n_z - v_m^2 / d - v_a^2 n_out / away is 0 where it leaves.
TEST(Ring, ASmoothBallKeepsItsMomentAboutTheAxis) {
    for (const double tilt : {0.02, -0.02, 0.3, -0.3})
        for (const double along : {0.0, 0.4, 1.0}) {
            Scene scene = with_ring(kLevel, 0, 0);
            const Vec3 n(std::sin(tilt), 0, std::cos(tilt));
            const Vec3 start = Vec3(kRingR, 0, 0) + kD * n;
            add_ball(scene, start, Vec3(0, along, 0));
            const SimulationResult r = run(scene, 3);
            const std::vector<Event> leaves = events_of(r.motion, EventKind::kLeave);
            ASSERT_FALSE(leaves.empty());
            const Event leave = leaves.front();
            const Trajectory& ball = r.motion.balls[0];
            double worst = 0, off = 0;
            for (int i = 0; i <= 200; ++i) {
                const BallState s = ball.at(leave.time * i / 200 * (1 - 1e-12));
                const double moment =
                    s.position.x() * s.velocity.y() - s.position.y() * s.velocity.x();
                worst = std::max({worst, std::abs(moment - start.x() * along),
                                  std::abs(energy(scene, s) - energy(scene, ball.at(0)))});
                off = std::max(off, std::abs(nearest_on(kLevel, s.position, kRingBall).gap));
            }
            const BallState s = ball.at(leave.time * (1 - 1e-15));
            const double away = std::hypot(s.position.x(), s.position.y());
            const Vec3 outward = Vec3(s.position.x(), s.position.y(), 0) / away;
            const double v_a = Vec3::UnitZ().cross(outward).dot(s.velocity);
            const double v_m2 = s.velocity.squaredNorm() - v_a * v_a;
            const double force = kGravity * leave.normal.z() - v_m2 / kD -
                                 v_a * v_a / away * leave.normal.dot(outward);
            std::printf(
                "tilt %g, %g m/s along: leaves at %.4f s; moment and energy off by %.2g, "
                "gap %.2g m, force at the end %.2g m/s^2\n",
                tilt, along, leave.time, worst, off, force);
            EXPECT_LT(worst, kBound);
            EXPECT_LT(off, 1e-14);
            EXPECT_NEAR(force, 0, 1e-10);
        }
}

/// With friction enough to roll, energy stays, and nothing slips.
TEST(Ring, ABallRollsOffARingWithoutLoss) {
    Scene scene = with_ring(kLevel, 0, 1e12);
    const Vec3 n(std::sin(0.1), 0, std::cos(0.1)), v(0, 0.7, 0);
    add_ball(scene, Vec3(kRingR, 0, 0) + kD * n, v).spin = n.cross(v) / kRingBall + 5 * n;
    const SimulationResult r = run(scene, 2);
    const Event leave = events_of(r.motion, EventKind::kLeave).front();
    double drift = 0, slip = 0;
    for (int i = 0; i <= 200; ++i) {
        const BallState s = r.motion.balls[0].at(leave.time * i / 200 * (1 - 1e-12));
        drift =
            std::max(drift, std::abs(energy(scene, s) - energy(scene, r.motion.balls[0].at(0))));
        slip = std::max(
            slip, slip_of(scene.balls[0], s, nearest_on(kLevel, s.position, 0).normal).norm());
    }
    std::printf("energy off by %.2g m^2/s^2, slip %.2g m/s\n", drift, slip);
    EXPECT_LT(drift, kBound);
    EXPECT_LT(slip, kBound);
}

TEST(Ring, WithoutLossABallThatRattlesInsideKeepsItsEnergy) {
    Scene scene = with_ring({Vec3::Zero(), Vec3::UnitY(), kRingR, kTube}, 1, 0);
    add_ball(scene, Vec3(0.1, 0, 0.05), Vec3(1.3, 0, 0.4));
    const SimulationResult r = run(scene, 5);
    const Trajectory& ball = r.motion.balls[0];
    EXPECT_GT(impacts_of(r.motion).size(), 10u);
    double drift = 0;
    for (int i = 0; i <= 500; ++i)
        drift =
            std::max(drift, std::abs(energy(scene, ball.at(0.01 * i)) - energy(scene, ball.at(0))));
    std::printf("%zu impacts, energy off by %.2g m^2/s^2\n", impacts_of(r.motion).size(), drift);
    EXPECT_LT(drift, kBound);
}

/// A hole that is too small: a ball in its middle meets the ring all around, bounces along the
/// axis, and sits there; tilted it stays while gravity lies within the cone of the normals.
TEST(Ring, ABallInTheMiddleOfASmallHoleSits) {
    const double radius = 0.12, tube = 0.05, hole = 0.1, d = radius + tube;
    const double height = std::sqrt(d * d - hole * hole);
    Scene scene = with_ring({Vec3::Zero(), Vec3::UnitZ(), hole, tube}, 0.5, 0.3);
    add_ball(scene, Vec3(0, 0, height + 0.5), Vec3::Zero(), radius);
    const double t = std::sqrt(2 * 0.5 / kGravity);
    const SimulationResult r = run(scene, 4);
    const Event first = impacts_of(r.motion).front();
    EXPECT_NEAR(first.time, t, 1e-14);
    EXPECT_LT((first.normal - Vec3::UnitZ()).norm(), 1e-14);
    EXPECT_NEAR(first.separation_speed, 0.5 * kGravity * t, 1e-12);
    const Event rest = only(r.motion, EventKind::kRest);
    EXPECT_NEAR(rest.time, t * 3, 1e-9);  // t (1 + 2 e / (1 - e))
    EXPECT_LT((r.motion.balls[0].at(4).position - Vec3(0, 0, height)).norm(), 1e-14);

    const double steepest = std::atan(hole / height);
    for (const double tilt : {0.9 * steepest, 1.1 * steepest}) {
        const Vec3 axis(std::sin(tilt), 0, std::cos(tilt));
        Scene tilted = with_ring({Vec3::Zero(), axis, hole, tube}, 0.5, 0.3);
        add_ball(tilted, height * axis, Vec3::Zero(), radius);
        const SimulationResult moved = run(tilted, 1);
        const Vec3 end = moved.motion.balls[0].at(1).position;
        if (tilt < steepest)
            EXPECT_LT((end - height * axis).norm(), 1e-13);
        else
            EXPECT_LT(end.z(), -1);
    }
}

/// Dropped beside the middle it rattles between the sides, and loses what it had.
TEST(Ring, ABallThatRattlesInASmallHoleComesToRest) {
    for (const Vec3& aside : {Vec3(0.01, 0, 0), Vec3(0.02, 0.01, 0)}) {
        Scene scene = with_ring({Vec3::Zero(), Vec3::UnitZ(), 0.1, 0.05}, 0.5, 0.3);
        add_ball(scene, Vec3(0, 0, 0.16) + aside, Vec3::Zero(), 0.12);
        const SimulationResult r = run(scene, 5);
        double rise = 0, least = 1e9, deepest = 0;
        for (int i = 0; i <= 5000; ++i) {
            const BallState s = r.motion.balls[0].at(0.001 * i);
            const double e = energy(scene, s);
            rise = std::max(rise, e - least);
            least = std::min(least, e);
            deepest = std::max(deepest, -nearest_on(scene.surfaces[0].shape, s.position, 0.12).gap);
        }
        std::printf("%zu impacts, energy rises by %.2g m^2/s^2, depth %.2g m, ends %.2g m aside\n",
                    impacts_of(r.motion).size(), rise, deepest,
                    r.motion.balls[0].at(5).position.head<2>().norm());
        EXPECT_LT(rise, 1e-9);
        EXPECT_LT(deepest, 1e-9);
        EXPECT_LT(r.motion.balls[0].at(5).position.head<2>().norm(), 1e-9);
    }
}

/// Without gravity, and with gravity along the axis: its own motion presses a ball onto the inside
/// of a ring. After the bounces, which keep the speed along it, it goes round in a circle.
TEST(Ring, ABallCirclesInsideARingThatNothingElsePressesItOnto) {
    const double length = kRingR - kD;
    Scene scene = with_ring(kLevel, 0.5, 0);
    scene.simulation.gravity.setZero();
    add_ball(scene, Vec3(0.1, 0, 0), Vec3(0.3, 1, 0));
    const SimulationResult r = run(scene, 20);
    const Event lasts = only(r.motion, EventKind::kSlide);
    EXPECT_LT(lasts.time, 5);
    const double moment = 0.1;  // per mass, about the axis: x v_y
    double worst = 0, off = 0;
    for (int i = 0; i <= 200; ++i) {
        const BallState s = r.motion.balls[0].at(10 + 0.05 * i);
        worst = std::max(worst, std::abs(s.position.x() * s.velocity.y() -
                                         s.position.y() * s.velocity.x() - moment));
        off = std::max(off, std::abs(s.position.norm() - length));
    }
    std::printf("circles from %.4f s on; moment off by %.2g m^2/s, place by %.2g m\n", lasts.time,
                worst, off);
    EXPECT_LT(worst, kBound);
    EXPECT_LT(off, 1e-12);
    EXPECT_NEAR(r.motion.balls[0].at(15).velocity.norm(), moment / length, 1e-12);
}

TEST(Ring, FixedStepsMeetIt) {
    Scene scene = scene_of(0.5, 0, kGravity, 1e-4);
    add_surface(scene, "ring", kLevel);
    const double t = std::sqrt(2 * 0.5 / kGravity);
    add_ball(scene, Vec3(kRingR - 0.6 * kD, 0, 0.8 * kD + 0.5));
    const SimulationResult r = run(scene, t + 0.02);
    const std::vector<Event> impacts = impacts_of(r.motion);
    ASSERT_EQ(impacts.size(), 1u);
    EXPECT_NEAR(impacts[0].time, t, 2e-4);
    EXPECT_LT((impacts[0].normal - Vec3(-0.6, 0, 0.8)).norm(), 5e-3);
}

}  // namespace
}  // namespace carom::testing
