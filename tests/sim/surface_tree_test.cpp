// Many surfaces: the tree of their boxes changes the cost, never the motion.
#include "sim/collide/surface_tree.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

#include "exact_scenes.h"
#include "geometry/nearest.h"
#include "shapes.h"
#include "sim/exact/exact.h"

namespace carom::testing {
namespace {

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double in(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Vec3 vector(double most) {
        const double x = in(-most, most), y = in(-most, most), z = in(-most, most);
        return {x, y, z};
    }

  private:
    std::mt19937 engine_;
};

/// A box, sphere or capsule, about `size` large; now and then one that is much larger.
SurfaceShape random_shape(Random& random, const Vec3& center, double size, int kind) {
    if (kind % 3 == 0) {
        const Vec3 turn = random.vector(1);
        return BoxShape{center, size * (random.vector(0.4) + Vec3::Constant(0.5)),
                        Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized()))};
    }
    if (kind % 3 == 1) return SphereShape{center, size * random.in(0.1, 0.5)};
    const Vec3 half = random.vector(0.5 * size);
    return CapsuleShape{center - half, center + half, size * random.in(0.05, 0.2)};
}

TEST(SurfaceTree, FindsEverySurfaceThatAPathComesNearTo) {
    Random random(7);
    int met = 0, found_in_all = 0, asked = 0;
    for (int trial = 0; trial < 60; ++trial) {
        Scene scene;
        const double spread = std::pow(10, random.in(-1, 2));
        for (int i = 0; i < 80; ++i)
            if (i % 20 == 0)
                add_plane(scene, random.vector(1));
            else
                add_shape(scene, random_shape(random, random.vector(spread),
                                              i % 13 == 0 ? spread : 0.3, i));
        const SurfaceTree tree(scene.surfaces);
        const Path path{random.vector(spread), random.vector(spread),
                        trial % 3 == 0 ? Vec3::Zero() : random.vector(spread)};
        const double seconds = random.in(0.1, 4), reach = random.in(0.01, 0.2);
        std::vector<int> found;
        tree.find_along(path, seconds, reach, found);
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
        EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
        asked += 76;
        found_in_all += static_cast<int>(found.size());
        for (int s = 0; s < 80; ++s) {
            if (s % 20 == 0) continue;  // a plane
            bool near = false;
            for (int k = 0; k <= 500 && !near; ++k) {
                const Vec3 x = path.at(seconds * k / 500);
                near = nearest_on(scene.surfaces[std::size_t(s)].shape, x, reach).gap <= 0;
            }
            met += near ? 1 : 0;
            const bool listed = std::binary_search(found.begin(), found.end(), s);
            EXPECT_TRUE(listed || !near) << "surface " << s << " of trial " << trial;
        }
    }
    fmt::print("{} surfaces: {} come near, {} found\n", asked, met, found_in_all);
    EXPECT_GT(met, 300);
    EXPECT_LT(found_in_all, 3 * met);  // of 14 times as many
}

/// Balls that fall, roll and come to rest among surfaces of all shapes.
Scene clutter(int surfaces, int balls, double restitution, double friction, unsigned seed) {
    Scene scene = exact_scene(restitution, friction, kGravity);
    use_pair(scene, restitution, friction);
    add_plane(scene);
    for (const double side : {-1.0, 1.0}) {
        add_plane(scene, side * Vec3::UnitX(), -2);
        add_plane(scene, side * Vec3::UnitY(), -2);
    }
    Random random(seed);
    for (int i = 0; i < surfaces; ++i) {
        const Vec3 center(random.in(-2, 2), random.in(-2, 2), random.in(0, 2));
        add_shape(scene, random_shape(random, center, 0.4, i));
    }
    for (int i = 0; i < balls; ++i)
        add_ball(scene, Vec3(0.3 * (i % 12) - 1.7, 0.3 * (i / 12 % 12) - 1.7, 2.9 + i / 144),
                 random.vector(1), random.in(0.03, 0.1));
    return scene;
}

std::uint64_t hash_with(Scene& scene, double duration, std::size_t surfaces_for_tree,
                        SimulationReport& report) {
    scene.simulation.duration = duration;
    ExactOptions options;
    options.surfaces_for_tree = surfaces_for_tree;
    const SimulationResult result = simulate_exact(scene, {}, {}, options);
    report = result.report;
    return result.motion.hash();
}

TEST(SurfaceTree, ChangesNothingOfTheMotion) {
    struct Case {
        int surfaces, balls;
        double restitution, friction, duration;
    };
    std::int64_t impacts = 0, islands = 0;
    for (const Case& c : {Case{1, 6, 0.8, 0, 0.9},
                          {12, 20, 0.95, 0, 0.9},
                          {40, 30, 0.6, 0.3, 0.9},
                          {60, 40, 0.3, 0, 0.9},
                          {30, 10, 0, 0.2, 1.5}}) {
        Scene scene = clutter(c.surfaces, c.balls, c.restitution, c.friction, 4);
        SimulationReport with, without;
        const std::uint64_t hash = hash_with(scene, c.duration, 1, with);
        EXPECT_EQ(hash, hash_with(scene, c.duration, 100'000, without))
            << c.surfaces << " surfaces";
        EXPECT_EQ(with.impacts, without.impacts);
        impacts += with.impacts;
        islands += with.integrated + with.steps;
    }
    fmt::print("{} impacts, {} pieces and steps of islands: the same with and without the tree\n",
               impacts, islands);
    EXPECT_GT(impacts, 200);
    EXPECT_GT(islands, 10);
}

double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

TEST(SurfaceTree, FarSurfacesCostAnImpactNothing) {
    const auto bouncing_among = [](int count) {
        Scene scene = exact_scene(1, 0, kGravity);
        add_plane(scene);
        for (int i = 0; i < count; ++i) {
            const double turn = 2.399963 * i, distance = 10 + 0.05 * i;  // golden angle
            const Vec3 at(distance * std::cos(turn), distance * std::sin(turn), 0.5 * (i % 7));
            add_shape(scene, CapsuleShape{at, at + Vec3::UnitZ(), 0.1});
        }
        add_ball(scene, Vec3(0, 0, 1.9));
        return scene;
    };
    Scene alone = bouncing_among(0), among = bouncing_among(1000);
    const double duration = 10'000 * 2 * std::sqrt(2 * 1.8 / 9.81);
    double cost_alone = 1e300, cost_among = 1e300;
    for (int i = 0; i < 7; ++i)  // in turn, so that a busy machine slows both down
        for (Scene* scene : {&alone, &among}) {
            const double start = cpu_seconds();
            const SimulationResult result = run(*scene, duration);
            double& cost = scene == &alone ? cost_alone : cost_among;
            cost = std::min(cost, (cpu_seconds() - start) / double(result.report.impacts));
            EXPECT_NEAR(double(result.report.impacts), 10'000, 1);
        }
    fmt::print("impact alone {:.3f} us, among 1,000 far capsules {:.3f} us: {:.2f} (bound 1.5)\n",
               1e6 * cost_alone, 1e6 * cost_among, cost_among / cost_alone);
    EXPECT_LE(cost_among, 1.5 * cost_alone);
}

}  // namespace
}  // namespace carom::testing
