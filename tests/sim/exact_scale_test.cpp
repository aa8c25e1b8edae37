// Many balls: the grid changes the cost, never the motion.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "exact_scenes.h"
#include "sim/collide/neighbour_grid.h"
#include "sim/exact/exact.h"

namespace carom::testing {
namespace {

/// Balls on a lattice, with random velocities, in a cube of six planes.
Scene gas(int balls, double gravity, double restitution, unsigned seed, double spacing = 0.5) {
    Scene scene = exact_scene(restitution, 0, gravity);
    use_pair(scene, restitution);
    const int side = static_cast<int>(std::ceil(std::cbrt(balls)));
    const double length = side * spacing;
    for (int axis = 0; axis < 3; ++axis) {
        add_plane(scene, Vec3::Unit(axis), 0);
        add_plane(scene, -Vec3::Unit(axis), -length);
    }
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> speed(-1, 1), radius(0.08, 0.12);
    for (int i = 0; i < balls; ++i) {
        const Vec3 cell(i % side, i / side % side, i / side / side);
        const Vec3 at = spacing * (cell + Vec3::Constant(0.5));
        const Vec3 v(speed(random), speed(random), speed(random));
        add_ball(scene, at, v, radius(random));
    }
    return scene;
}

std::uint64_t hash_with(Scene& scene, double duration, std::size_t balls_for_grid,
                        std::int64_t* impacts = nullptr) {
    scene.simulation.duration = duration;
    const SimulationResult result = simulate_exact(scene, {}, {}, {balls_for_grid});
    if (impacts != nullptr) *impacts = result.report.impacts;
    return result.motion.hash();
}

TEST(ExactScale, GridChangesNothing) {
    for (const int balls : {50, 120, 200})
        for (const double gravity : {0.0, kGravity}) {
            Scene scene = gas(balls, gravity, gravity > 0 ? 0.9 : 1.0, 3);
            // One that is much larger than the rest stands in no cell.
            if (balls == 120) scene.balls[60].radius = 0.35;
            if (balls == 120) scene.balls[60].mass = 30;
            if (balls == 120)
                for (Ball& b : scene.balls)
                    if (&b != &scene.balls[60]) b.radius = 0.06;
            std::int64_t impacts = 0;
            const double duration = gravity > 0 ? 1.0 : 5.0;
            const std::uint64_t with = hash_with(scene, duration, 2, &impacts);
            EXPECT_EQ(with, hash_with(scene, duration, 100'000)) << balls << " balls";
            EXPECT_GT(impacts, 2 * balls);
            std::printf("%d balls, g %g: %lld impacts, the same with and without the grid\n", balls,
                        gravity, static_cast<long long>(impacts));
        }
}

/// Balls that fly apart into open space: the grid must follow, and stay harmless.
TEST(ExactScale, GridFollowsBallsThatSpread) {
    Scene scene = exact_scene(1, 0, 0);
    use_pair(scene, 1);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 64; ++i)
        add_ball(scene, 0.25 * Vec3(i % 4, i / 4 % 4, i / 16),
                 Vec3(unit(random), unit(random), unit(random)));
    std::int64_t impacts = 0;
    const std::uint64_t with = hash_with(scene, 600, 2, &impacts);
    EXPECT_GT(impacts, 20);
    EXPECT_EQ(with, hash_with(scene, 600, 100'000));
}

TEST(ExactScale, GasKeepsItsEnergy) {
    Scene scene = gas(60, 0, 1, 11, 0.3);
    scene.simulation.duration = 60;
    const SimulationResult result = simulate_exact(scene);
    const double impacts_a_ball = 2.0 * double(result.report.impacts) / 60;
    ASSERT_GE(impacts_a_ball, 100);
    const double before = kinetic_energy(scene, result.motion, 0);
    const double after = kinetic_energy(scene, result.motion, 60);
    std::printf("energy after %.0f impacts a ball: %.3g\n", impacts_a_ball,
                relative_error(after, before));
    EXPECT_LE(relative_error(after, before), 1e-12);
    for (const Trajectory& ball : result.motion.balls) {
        const Vec3 at = ball.at(60).position;
        EXPECT_GE(at.minCoeff(), 0.08 - 1e-9);
        EXPECT_LE(at.maxCoeff(), 1.2 - 0.08 + 1e-9);
    }
}

/// No two balls of a gas ever overlap: nothing was missed.
TEST(ExactScale, NothingPassesThroughAnything) {
    Scene scene = gas(80, 0, 1, 2, 0.26);
    scene.simulation.duration = 4;
    const SimulationResult result = simulate_exact(scene, {}, {}, {2});
    double deepest = 0;
    for (double t = 0; t <= 4; t += 0.01) {
        std::vector<Vec3> x;
        for (const Trajectory& ball : result.motion.balls) x.push_back(ball.at(t).position);
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                deepest = std::max(
                    deepest, scene.balls[i].radius + scene.balls[j].radius - (x[i] - x[j]).norm());
    }
    EXPECT_GT(result.report.impacts, 400);
    EXPECT_LE(deepest, 1e-12);
}

TEST(ExactScale, PairsAreLeftOutWhereNoneCanMeet) {
    Scene scene = exact_scene(0.8, 0.3, kGravity);
    add_plane(scene);
    for (int i = 0; i < 5; ++i) add_ball(scene, Vec3(0.3 * i, 0, 1 + 0.2 * i));
    const SimulationResult apart = run(scene, 3);
    EXPECT_FALSE(apart.report.effects.at("pairs").on) << apart.report.effects.at("pairs").why;
    EXPECT_GT(apart.report.impacts, 20);
    // One moves sideways: now they can.
    scene.balls[0].velocity.x() = 1;
    EXPECT_TRUE(run(scene, 1).report.effects.at("pairs").on);
    // Spin and friction together move a ball sideways as well.
    scene.balls[0].velocity.x() = 0;
    scene.balls[0].spin.y() = 10;
    EXPECT_TRUE(run(scene, 1).report.effects.at("pairs").on);
    // One above the other.
    scene.balls[0].spin.y() = 0;
    scene.balls[0].position = Vec3(0.3, 0, 3);
    EXPECT_TRUE(run(scene, 1).report.effects.at("pairs").on);
}

// ---- The grid itself
// ------------------------------------------------------------------------------

TEST(NeighbourGrid, FindsEveryPairInReach) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<Vec3> positions;
        std::vector<double> radii;
        const double spread = std::pow(10, 3 * unit(random) - 1);
        for (int i = 0; i < 200; ++i) {
            positions.push_back(spread *
                                Vec3(unit(random) - 0.5, unit(random), unit(random) - 0.9));
            radii.push_back(i % 50 == 0 ? 5 * unit(random) : 0.1 * (0.5 + unit(random)));
        }
        NeighbourGrid grid(positions, radii);
        // Some move, and are put where they are then.
        for (int i = 0; i < 200; i += 3) {
            positions[static_cast<std::size_t>(i)] += Vec3(unit(random), 0, -unit(random));
            if (grid.in_cell(i)) grid.move(i, grid.cell_at(positions[static_cast<std::size_t>(i)]));
        }
        int pairs = 0;
        for (int i = 0; i < 200; ++i) {
            std::multiset<int> near;
            grid.for_each_near(i, [&](int other) { near.insert(other); });
            EXPECT_EQ(near.count(i), 0u);
            for (int j = 0; j < 200; ++j) {
                if (i == j) continue;
                const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
                const bool touch = (positions[a] - positions[b]).norm() <= radii[a] + radii[b];
                pairs += touch ? 1 : 0;
                if (touch) {
                    EXPECT_EQ(near.count(j), 1u) << i << " and " << j;
                }
                EXPECT_LE(near.count(j), 1u);
            }
        }
        if (spread < 5) {
            EXPECT_GT(pairs, 0);
        }
    }
}

// Lossless balls that fall as a block and meet many at a time: no step may take their energy.
TEST(ExactScale, LosslessBlockKeepsItsEnergy) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> jitter(0, 0.001);
        Scene scene = exact_scene(1, 0, kGravity);
        add_plane(scene);
        for (int i = 0; i < 216; ++i)
            add_ball(scene,
                     Vec3(0.21 * (i % 6) + jitter(random), 0.21 * (i / 6 % 6) + jitter(random),
                          1.101 + 0.21 * (i / 36) + jitter(random)));
        const SimulationResult result = run(scene, 2);
        const auto energy = [&](double t) {
            double sum = kinetic_energy(scene, result.motion, t);
            for (std::size_t b = 0; b < scene.balls.size(); ++b)
                sum += scene.balls[b].mass * 9.81 * result.motion.balls[b].at(t).position.z();
            return sum;
        };
        double worst = 0;
        for (int k = 1; k <= 200; ++k)
            worst = std::max(worst, relative_error(energy(0.01 * k), energy(0)));
        fmt::print("block of 216, seed {}: {} impacts, energy within {:.1e} (bound 1e-12)\n", seed,
                   result.report.impacts, worst);
        EXPECT_GT(result.report.impacts, 1000);
        EXPECT_LE(worst, 1e-12);
    }
}

}  // namespace
}  // namespace carom::testing
