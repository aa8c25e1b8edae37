// One ball in, on and around a bowl (method exact), against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "curved_scenes.h"
#include "geometry/nearest.h"
#include "wandering.h"

namespace carom::testing {
namespace {

constexpr double kBowlR = 0.5, kBowlBall = 0.1;
constexpr double kBowlLength = kBowlR - kBowlBall;  ///< of the pendulum that a ball inside is, m

Scene with_bowl(double depth, double restitution, double friction) {
    Scene scene = exact_scene(restitution, friction, kGravity);
    add_surface(scene, "bowl", BowlShape{Vec3::Zero(), kBowlR, Vec3::UnitZ(), depth});
    return scene;
}

/// From rest at the angle a from the lowest point: half a swing takes 2 sqrt(L/g) K(sin(a/2));
/// rolling makes the ball's inertia larger by 1 + k.
TEST(Bowl, ABallSwingsAsAPendulum) {
    for (const bool rolls : {false, true})
        for (const double a : {0.1, 0.8, 1.5}) {
            Scene scene = with_bowl(kBowlR, 0, rolls ? 1e12 : 0);
            const Vec3 start(kBowlLength * std::sin(a), 0, -kBowlLength * std::cos(a));
            add_ball(scene, start);
            const double slower = rolls ? 1 + kSolid : 1;
            const double half = 2 * std::sqrt(slower * kBowlLength / kGravity) *
                                std::comp_ellint_1(std::sin(a / 2));
            const SimulationResult r = run(scene, 4 * half);
            double worst = 0;
            for (int i = 1; i <= 4; ++i) {
                const Vec3 side(i % 2 == 0 ? 1 : -1, 1, 1);
                worst = std::max(
                    worst,
                    (r.motion.balls[0].at(i * half).position - start.cwiseProduct(side)).norm());
            }
            std::printf("from %.1f rad%s: four swings off by %.2g m\n", a, rolls ? ", rolling" : "",
                        worst);
            EXPECT_LT(worst, 1e-11);
            EXPECT_TRUE(events_of(r.motion, EventKind::kLeave).empty());
        }
}

/// Round at one height: v^2 = g L sin a tan a.
TEST(Bowl, ASmoothBallCirclesAtOneHeight) {
    for (const double a : {0.3, 1.2}) {
        Scene scene = with_bowl(kBowlR, 0.5, 0);
        const double away = kBowlLength * std::sin(a), down = -kBowlLength * std::cos(a);
        const double v = std::sqrt(kGravity * away * std::tan(a)), turn = v / away;
        add_ball(scene, Vec3(away, 0, down), Vec3(0, v, 0));
        const SimulationResult r = run(scene, 3);
        double worst = 0;
        for (int i = 0; i <= 30; ++i) {
            const double t = 0.1 * i;
            const Vec3 expected(away * std::cos(turn * t), away * std::sin(turn * t), down);
            worst = std::max(worst, (r.motion.balls[0].at(t).position - expected).norm());
        }
        std::printf("at %.1f rad: off by %.2g m\n", a, worst);
        EXPECT_LT(worst, 1e-11);
    }
}

/// v -> v - (1 + e) (v.n) n on the inside, on the rim and on the outside.
TEST(Bowl, BallsAreReflectedFromAllItsSides) {
    const double e = 0.6, speed = 2;
    const auto expect = [&](double depth, const Vec3& met, const Vec3& n, const Vec3& v) {
        Scene scene = with_bowl(depth, e, 0);
        scene.simulation.gravity.setZero();
        add_ball(scene, met - 0.1 * v, v);
        const SimulationResult r = run(scene, 0.11);
        const std::vector<Event> impacts = impacts_of(r.motion);
        ASSERT_EQ(impacts.size(), 1u) << n.transpose();
        EXPECT_NEAR(impacts[0].time, 0.1, 1e-15);
        EXPECT_LT((impacts[0].normal - n).norm(), 1e-14);
        EXPECT_LT((r.motion.balls[0].at(0.11).velocity - (v - (1 + e) * v.dot(n) * n)).norm(),
                  1e-13);
    };
    const Vec3 out(0.6, 0, -0.8), down(0, 0, -speed);
    expect(kBowlR, kBowlLength * out, -out, speed * Vec3(0.6, 0, -0.8));          // inside
    expect(kBowlR, (kBowlR + kBowlBall) * out, out, speed * Vec3(-0.8, 0, 0.6));  // outside
    expect(kBowlR, Vec3(kBowlR, 0, 0) + kBowlBall * Vec3(0.6, 0, 0.8), Vec3(0.6, 0, 0.8),
           down);  // the rim
    expect(kBowlR, Vec3(kBowlR, 0, 0) + kBowlBall * Vec3(-0.6, 0, 0.8), Vec3(-0.6, 0, 0.8), down);
    // A rim at 3/5 of the radius below the middle: its circle has 4/5 of it.
    expect(0.4 * kBowlR, Vec3(0.8 * kBowlR, 0, -0.6 * kBowlR) + kBowlBall * Vec3::UnitZ(),
           Vec3::UnitZ(), down);
}

/// Out over a rim that slopes: it leaves the wall's end along it, unless the rim holds it.
TEST(Bowl, AFastBallLeavesOverTheRim) {
    const double a = std::acos(0.6);  // of the rim
    Scene scene = with_bowl(0.4 * kBowlR, 0, 0);
    const double v0 = 4;
    add_ball(scene, Vec3(0, 0, -kBowlLength), Vec3(v0, 0, 0));
    const SimulationResult r = run(scene, 1);
    const Event leave = only(r.motion, EventKind::kLeave);
    const BallState s = r.motion.balls[0].at(leave.time);
    const double v = std::sqrt(v0 * v0 - 2 * kGravity * kBowlLength * (1 - std::cos(a)));
    EXPECT_LT((s.position - kBowlLength * Vec3(std::sin(a), 0, -std::cos(a))).norm(), kBound);
    EXPECT_LT((s.velocity - v * Vec3(std::cos(a), 0, std::sin(a))).norm(), kBound);
}

/// Bouncing in a closed sphere without loss.
TEST(Bowl, NoBallGetsOutOfAClosedSphere) {
    Scene scene = with_bowl(2 * kBowlR, 1, 0);
    add_ball(scene, Vec3(0.1, 0, 0.05), Vec3(1.3, 0.7, 0.4));
    const auto [drift, farthest] = wandering(scene, [](const Vec3& p) { return p.norm(); });
    std::printf("energy off by %.2g m^2/s^2, out by %.2g m\n", drift, farthest - kBowlLength);
    EXPECT_LT(drift, 1e-11);
    EXPECT_LT(farthest, kBowlLength + 1e-12);
}

/// With loss it comes to swing along the wall, and energy never grows.
TEST(Bowl, ABallThatBouncesInItSettlesOnTheWall) {
    Scene scene = with_bowl(kBowlR, 0.6, 0.3);
    add_ball(scene, Vec3(0.15, 0.1, 0.3), Vec3(0.3, -0.6, 0));
    const SimulationResult r = run(scene, 6);
    ASSERT_FALSE(impacts_of(r.motion).empty());
    double rise = 0, least = 1e9, deepest = 0;
    for (int i = 0; i <= 3000; ++i) {
        const BallState s = r.motion.balls[0].at(0.002 * i);
        rise = std::max(rise, energy(scene, s) - least);
        least = std::min(least, energy(scene, s));
        deepest =
            std::max(deepest, -nearest_on(scene.surfaces[0].shape, s.position, kBowlBall).gap);
    }
    std::printf("energy rises by %.2g m^2/s^2, depth %.2g m\n", rise, deepest);
    EXPECT_LT(rise, 1e-11);
    EXPECT_LT(deepest, 1e-12);
    EXPECT_NEAR(r.motion.balls[0].at(6).position.norm(), kBowlLength, 1e-12);
}

TEST(Bowl, ABallRestsAtTheBottom) {
    Scene scene = with_bowl(kBowlR, 0.5, 0.3);
    add_ball(scene, Vec3(0, 0, 0.4));
    const SimulationResult r = run(scene, 5);
    EXPECT_NEAR(only(r.motion, EventKind::kRest).time, std::sqrt(2 * 0.8 / kGravity) * 3, 1e-9);
    EXPECT_LT((r.motion.balls[0].at(5).position - Vec3(0, 0, -kBowlLength)).norm(), 1e-14);
}

/// A ball too large for the opening sits on the rim all around.
TEST(Bowl, ALargeBallSitsOnTheRim) {
    Scene scene = with_bowl(0.2, 0.5, 0.3);  // the rim's radius is 0.4 m, at z = -0.3 m
    const double radius = 0.4 / 0.6;         // 3-4-5: its centre is 0.8 of the radius above the rim
    add_ball(scene, Vec3(0, 0, 0.7), Vec3::Zero(), radius);
    const SimulationResult r = run(scene, 4);
    EXPECT_LT((r.motion.balls[0].at(4).position - Vec3(0, 0, -0.3 + 0.8 * radius)).norm(), 1e-14);
    only(r.motion, EventKind::kRest);
}

}  // namespace
}  // namespace carom::testing
