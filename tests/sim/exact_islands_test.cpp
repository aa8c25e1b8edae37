// Lasting contacts that hang together: stacks, grooves, corners, piles (method exact).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "exact_scenes.h"

namespace carom::testing {
namespace {

Scene island_scene(double restitution, double friction) {
    Scene scene = scene_of(restitution, friction, kGravity, 0.00025);
    scene.simulation.method = Method::kExact;
    use_pair(scene, restitution, friction);
    return scene;
}

double largest_speed(const Scene& scene, const Motion& motion, double t) {
    double speed = 0;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const BallState s = motion.balls[i].at(t);
        speed = std::max({speed, s.velocity.norm(), scene.balls[i].radius * s.spin.norm()});
    }
    return speed;
}

/// The deepest overlap of any two balls, or of a ball and a plane [m].
double deepest(const Scene& scene, const Motion& motion, double t) {
    double depth = -INFINITY;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Vec3 x = motion.balls[i].at(t).position;
        for (const Surface& s : scene.surfaces) {
            const auto& plane = std::get<PlaneShape>(s.shape);
            depth = std::max(depth, plane.offset_m + scene.balls[i].radius - plane.normal.dot(x));
        }
        for (std::size_t j = 0; j < i; ++j)
            depth = std::max(depth, scene.balls[i].radius + scene.balls[j].radius -
                                        (x - motion.balls[j].at(t).position).norm());
    }
    return depth;
}

Scene stack_of(int balls, double friction) {
    Scene scene = island_scene(0.5, friction);
    add_plane(scene);
    for (int i = 0; i < balls; ++i) add_ball(scene, Vec3(0, 0, 0.1 + 0.2 * i));
    return scene;
}

TEST(ExactIslands, StackOfTenStands) {  // H17
    Scene scene = stack_of(10, 0.5);
    const SimulationResult r = run(scene, 10);
    double speed = 0, depth = -1;
    for (double t = 0; t <= 10; t += 0.01) {
        speed = std::max(speed, largest_speed(scene, r.motion, t));
        depth = std::max(depth, deepest(scene, r.motion, t));
    }
    std::printf("speed %.3g m/s (1e-6), depth %.3g m (1e-6), steps %lld\n", speed, depth,
                static_cast<long long>(r.report.steps));
    EXPECT_LT(speed, 1e-6);
    EXPECT_LT(depth, 1e-6);
    EXPECT_GT(depth, -1e-6) << "the stack has fallen apart";
    EXPECT_NEAR(r.motion.balls[9].at(10).position.z(), 1.9, 1e-6);
}

TEST(ExactIslands, HeavyOnLight) {  // H18
    Scene scene = stack_of(2, 0);
    scene.balls[1].mass = 1000;
    const SimulationResult r = run(scene, 10);
    double speed = 0, depth = -1;
    for (double t = 0; t <= 10; t += 0.01) {
        speed = std::max(speed, largest_speed(scene, r.motion, t));
        depth = std::max(depth, deepest(scene, r.motion, t));
    }
    std::printf("speed %.3g m/s (1e-6), depth %.3g m (1e-5)\n", speed, depth);
    EXPECT_LT(speed, 1e-6);
    EXPECT_LT(depth, 1e-5);
    EXPECT_NEAR(r.motion.balls[1].at(10).position.z(), 0.3, 1e-5);
}

TEST(ExactIslands, DroppedStackComesToRest) {
    Scene scene = island_scene(0.5, 0.5);
    add_plane(scene);
    for (int i = 0; i < 4; ++i) add_ball(scene, Vec3(0, 0, 0.3 + 0.25 * i));
    const SimulationResult r = run(scene, 10);
    std::printf("steps %lld, impacts %lld, depth %.3g\n", static_cast<long long>(r.report.steps),
                static_cast<long long>(r.report.impacts), deepest(scene, r.motion, 10));
    EXPECT_EQ(largest_speed(scene, r.motion, 10), 0);
    EXPECT_LT(deepest(scene, r.motion, 10), 1e-6);
    EXPECT_NEAR(r.motion.balls[3].at(10).position.z(), 0.7, 1e-6);
}

TEST(ExactIslands, BallStaysInGroove) {  // H11
    for (const double opening : {90.0, 120.0}) {
        Scene scene = island_scene(0.5, 0.3);
        const double tilt = 90 - opening / 2;
        add_plane(scene, incline(tilt, 0));
        add_plane(scene, incline(tilt, 180));
        const double rest = 0.1 / std::cos(tilt * M_PI / 180);
        add_ball(scene, Vec3(0, 0, rest + 0.5));
        const SimulationResult r = run(scene, 5);
        double sideways = 0;
        for (double t = 0; t <= 5; t += 0.001)
            sideways = std::max(sideways, std::abs(r.motion.balls[0].at(t).position.x()));
        const BallState end = r.motion.balls[0].at(5);
        std::printf("%g deg: |x| %.3g (1e-12), height off by %.3g, speed %.3g\n", opening, sideways,
                    end.position.z() - rest, end.velocity.norm());
        EXPECT_LT(sideways, 1e-12);
        EXPECT_NEAR(end.position.z(), rest, 1e-9);
        EXPECT_EQ(end.velocity.norm(), 0);
    }
}

// Rolling down a groove of two planes that falls by 20 degrees: constant acceleration
// g sin a / (1 + k R^2 / d^2), d the distance of the centre from the line of the contacts.
TEST(ExactIslands, RollsDownGroove) {
    Scene scene = island_scene(0.5, 1.0);
    const double a = 20 * M_PI / 180, half = M_PI / 4;
    const Vec3 down(std::cos(a), 0, -std::sin(a)), up(std::sin(a), 0, std::cos(a));
    for (const double side : {-1.0, 1.0})
        add_plane(scene, std::cos(half) * up + side * std::sin(half) * Vec3::UnitY());
    add_ball(scene, 0.1 / std::cos(half) * up);
    const SimulationResult r = run(scene, 1);
    const double d = 0.1 * std::cos(half);
    const double expected = 0.5 * kGravity * std::sin(a) / (1 + kSolid * 0.01 / (d * d));
    const double way = r.motion.balls[0].at(1).position.dot(down);
    std::printf("way %.12g, expected %.12g, relative error %.3g\n", way, expected,
                way / expected - 1);
    EXPECT_NEAR(way / expected, 1, 1e-6);
}

TEST(ExactIslands, RollsAlongWall) {
    Scene scene = island_scene(0.5, 0.3);
    add_plane(scene);
    add_plane(scene, -Vec3::UnitY(), -0.1);
    add_ball(scene, Vec3(0, 0, 0.1), Vec3(1, 0, 0)).spin = Vec3(0, 10, 0);
    const SimulationResult r = run(scene, 1);
    const BallState end = r.motion.balls[0].at(1);
    std::printf("x %.15g y %.3g\n", end.position.x(), end.position.y());
    EXPECT_NEAR(end.position.x(), 1, 1e-9);
    EXPECT_NEAR(end.position.y(), 0, 1e-9);
}

// Galilean cannon of three balls, 6:2:1: the top one leaves at 3 v, the others are left at rest.
TEST(ExactIslands, CannonLeavesStack) {  // H8
    Scene scene = island_scene(1, 0);
    add_plane(scene);
    const double h = 1;
    for (int i = 0; i < 3; ++i) add_ball(scene, Vec3(0, 0, 0.1 + 0.2 * i + h));
    scene.balls[0].mass = 6;
    scene.balls[1].mass = 2;
    const SimulationResult r = run(scene, 1);
    const double v = std::sqrt(2 * kGravity * h), t = std::sqrt(2 * h / kGravity) + 0.2;
    const double top = r.motion.balls[2].at(t).velocity.z() + kGravity * 0.2;
    std::printf("top leaves at %.12g v, the others move at %.3g and %.3g m/s\n", top / v,
                r.motion.balls[0].at(t).velocity.norm(), r.motion.balls[1].at(t).velocity.norm());
    EXPECT_NEAR(top / v, 3, 1e-9);
    EXPECT_NEAR(r.motion.balls[1].at(1).position.z(), 0.3, 1e-6);
    EXPECT_LT(r.motion.balls[1].at(1).velocity.norm(), 1e-6);
}

TEST(ExactIslands, ComesToRestInCorner) {
    Scene scene = island_scene(0.5, 0.4);
    add_plane(scene, Vec3(0.1, 0.1, 1));
    add_plane(scene, -Vec3::UnitX(), -1);
    add_plane(scene, -Vec3::UnitY(), -1);
    add_ball(scene, Vec3(0, 0.5, 0.6), Vec3(0.3, 0.6, 0));
    const SimulationResult r = run(scene, 30);
    const BallState end = r.motion.balls[0].at(30);
    std::printf("end %.6g %.6g %.6g speed %.3g depth %.3g steps %lld\n", end.position.x(),
                end.position.y(), end.position.z(), end.velocity.norm(),
                deepest(scene, r.motion, 30), static_cast<long long>(r.report.steps));
    EXPECT_LT(deepest(scene, r.motion, 30), 1e-6);
}

Scene poured(int count, double friction) {
    Scene scene = island_scene(0.5, friction);
    add_plane(scene);
    for (const double side : {-1.0, 1.0}) {
        add_plane(scene, side * Vec3::UnitX(), -0.25);
        add_plane(scene, side * Vec3::UnitY(), -0.25);
    }
    for (int i = 0; i < count; ++i) {
        const double jitter = 0.01 * std::sin(7.0 * i);
        add_ball(scene, Vec3(-0.12 + 0.24 * (i % 2) + jitter,
                             -0.12 + 0.24 * (i / 2 % 2) + 0.5 * jitter, 0.3 + 0.23 * (i / 4)));
    }
    return scene;
}

TEST(ExactIslands, PouredBallsComeToRest) {
    // Ten are an island at most, thirty a pile, whose steps are longer.
    for (const auto& [count, depth_bound] : {std::pair{10, 1e-5}, {30, 5e-5}}) {
        Scene scene = poured(count, 0.3);
        const SimulationResult r = run(scene, 4);
        const double start = total_energy(scene, r.motion, 0);
        double least = start, gain = 0, depth = -1;
        for (double t = 0; t <= 4; t += 0.005) {
            const double e = total_energy(scene, r.motion, t);
            gain = std::max(gain, (e - least) / start);
            least = std::min(least, e);
            depth = std::max(depth, deepest(scene, r.motion, t));
        }
        int still = 0;
        double speed = 0;
        for (const Trajectory& ball : r.motion.balls) {
            const double v = ball.at(4).velocity.norm();
            speed = std::max(speed, v);
            if (v == 0) ++still;
        }
        std::printf(
            "%d: energy gain %.3g (1e-6), depth %.3g m (%g), %d at rest, others up to "
            "%.3g m/s, %lld steps, %lld impacts\n",
            count, gain, depth, depth_bound, still, speed, static_cast<long long>(r.report.steps),
            static_cast<long long>(r.report.impacts));
        EXPECT_LT(gain, 1e-6);
        EXPECT_LT(depth, depth_bound);
        // A ball that is alone on the floor rolls on: nothing resists that.
        EXPECT_LT(speed, 0.05);
        EXPECT_GE(2 * still, count);
        if (count == 10) {
            EXPECT_EQ(r.motion.hash(), run(scene, 4).motion.hash());
        }
    }
}

TEST(ExactIslands, RestingStackCostsNothing) {
    Scene scene = stack_of(10, 0.5);
    const SimulationResult r = run(scene, 60);
    std::printf("steps %lld, pieces %zu\n", static_cast<long long>(r.report.steps),
                r.motion.balls[9].pieces().size());
    EXPECT_LT(r.report.steps, 200);
    EXPECT_TRUE(r.motion.events.empty());
}

TEST(ExactIslands, RemovedSupportWakes) {
    Scene scene = stack_of(3, 0);
    Ball& hammer = add_ball(scene, Vec3(-10, 0, 0.1), Vec3(10, 0, 0));
    hammer.mass = 100;
    const SimulationResult r = run(scene, 3);
    const double top = r.motion.balls[2].at(3).position.z();
    const double bottom = r.motion.balls[0].at(3).position.x();
    std::printf("top at %.4g m, bottom driven to x = %.4g m\n", top, bottom);
    EXPECT_NEAR(r.motion.balls[2].at(0.9).position.z(), 0.5, 1e-6);
    EXPECT_LT(top, 0.35);
    EXPECT_GT(bottom, 5);
}

// Balls that are thrown into a corner come to lie there through steps: none of them lifts a ball,
// or speeds it up, beyond what it had.
TEST(ExactIslands, StepsInACornerAddNoEnergy) {
    std::int64_t steps = 0;
    double worst = 0;
    for (int k = 0; k < 12; k += 2) {
        Scene scene = island_scene(0.1 * (k % 4), 0.2 * (k % 5));
        use_pair(scene, 0.3, 0.4);
        scene.simulation.gravity = Vec3(6, 4 + 0.3 * k, -7);
        scene.simulation.duration = 1.5;
        add_plane(scene);
        add_plane(scene, -Vec3::UnitX(), -0.5);
        add_plane(scene, -Vec3::UnitY(), -0.5);
        for (int i = 0; i < 4; ++i)
            add_ball(scene, Vec3(0.1 + 0.03 * k * i, 0.3 - 0.02 * k, 0.1 + 0.15 * i),
                     Vec3(0.3 * i, 0.1 * k, 0), 0.05 + 0.01 * (i % 2));
        const SimulationResult r = simulate(scene);
        steps += r.report.steps;
        const auto total = [&](double t) {
            double sum = 0;
            for (std::size_t b = 0; b < scene.balls.size(); ++b) {
                const BallState s = r.motion.balls[b].at(t);
                const Ball& ball = scene.balls[b];
                sum += ball.mass * (0.5 * s.velocity.squaredNorm() +
                                    0.5 * ball.inertia_factor * ball.radius * ball.radius *
                                        s.spin.squaredNorm() -
                                    scene.simulation.gravity.dot(s.position));
            }
            return sum;
        };
        double least = total(0);
        for (int i = 1; i <= 3000; ++i) {
            const double now = total(1.5 * i / 3000);
            worst = std::max(worst, now - least);
            least = std::min(least, now);
        }
    }
    std::printf("%lld steps, energy rises by %.2g J at most (3e-8)\n",
                static_cast<long long>(steps), worst);
    EXPECT_GE(steps, 100);
    EXPECT_LE(worst, 3e-8);
}

}  // namespace
}  // namespace carom::testing
