// Lists of neighbours find every pair that can touch, and change nothing of a motion.
#include "sim/collide/neighbour_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "exact_scenes.h"
#include "sim/exact/exact.h"

namespace carom::testing {
namespace {

/// Balls go at random; one that leaves its box gets another. Whatever touches is listed, on both
/// sides and once.
TEST(NeighbourLists, FindEveryPairThatTouches) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const double spread : {0.6, 1.0, 4.0}) {
        std::vector<Vec3> places, velocities;
        std::vector<double> radii;
        for (int i = 0; i < 120; ++i) {
            places.push_back(spread * Vec3(unit(random), unit(random), unit(random)));
            velocities.emplace_back(unit(random), unit(random), unit(random));
            radii.push_back(i == 7 ? 1.0 : 0.1 + 0.05 * unit(random));
        }
        NeighbourLists lists(places, radii);
        ASSERT_FALSE(lists.grid().in_cell(7));
        int moves = 0, touching = 0;
        for (int step = 0; step < 300; ++step) {
            for (int i = 0; i < 120; ++i) {
                const auto k = static_cast<std::size_t>(i);
                places[k] += 0.01 * velocities[k];
                if (!lists.grid().in_cell(i) || lists.in_box(i, places[k])) continue;
                const std::vector<int> before = lists.of(i);
                lists.move(i, places[k], velocities[k]);
                ++moves;
                ASSERT_TRUE(lists.in_box(i, places[k]));
                for (const int other : lists.of(i)) {
                    const bool known =
                        std::find(before.begin(), before.end(), other) != before.end();
                    ASSERT_EQ(std::count(lists.added().begin(), lists.added().end(), other),
                              known ? 0 : 1);
                }
            }
            if (step % 10 != 0) continue;
            for (int i = 0; i < 120; ++i)
                for (int j = 0; j < 120; ++j) {
                    if (i == j || i == 7 || j == 7) continue;
                    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
                    const auto listed = std::count(lists.of(i).begin(), lists.of(i).end(), j);
                    const bool touch = (places[a] - places[b]).norm() <= radii[a] + radii[b];
                    touching += touch ? 1 : 0;
                    ASSERT_LE(listed, 1);
                    ASSERT_TRUE(listed == 1 || !touch) << i << " and " << j;
                    ASSERT_EQ(listed, std::count(lists.of(j).begin(), lists.of(j).end(), i));
                }
        }
        EXPECT_GT(moves, 100);
        EXPECT_GT(touching, 10);
    }
}

/// Balls of radii 0.4 to 0.5 on a lattice of edge 1.05 in a cube, with random velocities.
Scene dense_gas(double restitution, bool with_large) {
    Scene scene = exact_scene(restitution, 0, 0);
    use_pair(scene, restitution);
    constexpr int kSide = 6;
    for (int axis = 0; axis < 3; ++axis) {
        add_plane(scene, Vec3::Unit(axis), 0);
        add_plane(scene, -Vec3::Unit(axis), -1.05 * kSide);
    }
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
        const Vec3 cell(i % kSide, i / kSide % kSide, i / kSide / kSide);
        const Vec3 velocity(unit(random), unit(random), unit(random));
        const double radius = 0.45 + 0.05 * unit(random);
        if (with_large && (cell - Vec3(1, 1, 1)).cwiseAbs().maxCoeff() <= 1) continue;
        add_ball(scene, 1.05 * (cell + Vec3::Constant(0.5)), velocity, radius);
    }
    if (with_large) {
        add_ball(scene, 1.05 * Vec3::Constant(1.5), Vec3::Zero(), 1.5);
        scene.balls.back().mass = 20;
    }
    return scene;
}

TEST(NeighbourLists, ADenseGasIsTheSameWithoutThem) {
    for (const bool with_large : {false, true})
        for (const double restitution : {1.0, 0.95}) {
            Scene scene = dense_gas(restitution, with_large);
            scene.simulation.duration = 6;
            const SimulationResult with = simulate_exact(scene, {}, {}, {2});
            const SimulationResult without = simulate_exact(scene, {}, {}, {100'000});
            EXPECT_GT(with.report.impacts, 20 * static_cast<int>(scene.balls.size()));
            EXPECT_EQ(with.motion.hash(), without.motion.hash())
                << restitution << (with_large ? ", one of them large" : "");
        }
}

}  // namespace
}  // namespace carom::testing
