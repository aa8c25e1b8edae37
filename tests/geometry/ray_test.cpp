// Where rays meet shapes, against steps as long as the distance from the shape.
#include "geometry/ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/convexity.h"
#include "geometry/nearest.h"
#include "shapes.h"

namespace carom {
namespace {

constexpr double kFar = 30;  // m, beyond all of the shapes

/// The first place where the distance is below 1e-10 m, found by steps as long as it.
std::optional<double> first_by_steps(const SurfaceShape& shape, const Ray& ray) {
    double t = 0;
    for (int step = 0; step < 200'000 && t < kFar; ++step) {
        const double gap = signed_distance(shape, ray.at(t));
        if (gap < 1e-10) return t;
        t += gap;
    }
    return std::nullopt;
}

std::vector<Ray> rays() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<Ray> found;
    for (const Vec3& from : places())
        for (int i = 0; i < 400; ++i) {
            const Vec3 d(normal(random), normal(random), normal(random));
            found.push_back({from, d.normalized()});
        }
    return found;
}

TEST(Ray, FirstHitsAreWhereTheDistanceVanishes) {
    for (const SurfaceShape& shape : one_of_each()) {
        int hits = 0, misses = 0;
        for (const Ray& ray : rays()) {
            const double start = signed_distance(shape, ray.origin);
            std::optional<RayHit> hit = first_hit(shape, ray);
            if (hit && hit->distance > kFar) hit.reset();  // of a plane
            if (start <= 0) {
                EXPECT_FALSE(hit && is_convex(shape)) << shape.index();
                continue;
            }
            const std::optional<double> right = first_by_steps(shape, ray);
            ASSERT_EQ(right.has_value(), hit.has_value())
                << shape.index() << " at " << (right ? *right : hit->distance);
            ++(hit ? hits : misses);
            if (!hit) continue;
            const double slant = std::abs(hit->normal.dot(ray.direction));
            EXPECT_NEAR(*right, hit->distance, 1e-9 + 3e-10 / slant) << shape.index();
            EXPECT_LT(std::abs(signed_distance(shape, ray.at(hit->distance))), 1e-11);
            EXPECT_LT(hit->normal.dot(ray.direction), 0) << shape.index();
            const Nearest near = nearest_on(shape, ray.at(hit->distance) + 1e-6 * hit->normal, 0);
            EXPECT_LT((near.normal - hit->normal).norm(), 1e-6) << shape.index();
        }
        EXPECT_GT(hits, 300) << shape.index();
        EXPECT_GT(misses, 300) << shape.index();
    }
}

TEST(Ray, FarAwayNothingIsLost) {
    for (const double away : {1e3, 1e6}) {
        const Ray ray{Vec3(-away, 0, 0.05), Vec3::UnitX()};
        const double half = std::sqrt(0.1 * 0.1 - 0.05 * 0.05);
        const double bound = 1e-15 * away;
        EXPECT_NEAR(away - half, first_hit(SphereShape{Vec3::Zero(), 0.1}, ray)->distance, bound);
        const CapsuleShape capsule{Vec3(0, -1, 0), Vec3(0, 1, 0), 0.1};
        EXPECT_NEAR(away - half, first_hit(capsule, ray)->distance, bound);
        const CylinderShape cylinder{Vec3(0, -1, 0), Vec3(0, 1, 0), 0.1};
        EXPECT_NEAR(away - half, first_hit(cylinder, ray)->distance, bound);
        const RingShape ring{Vec3::Zero(), Vec3::UnitZ(), 1, 0.1};
        EXPECT_NEAR(away - 1 - half, first_hit(ring, ray)->distance, 1e-11 + bound);
    }
}

TEST(Ray, AlongAnAxis) {
    const CylinderShape cylinder{Vec3(0, 0, 1), Vec3(0, 0, 3), 0.5};
    const auto down = first_hit(cylinder, {Vec3(0.2, 0, 5), -Vec3::UnitZ()});
    ASSERT_TRUE(down);
    EXPECT_DOUBLE_EQ(2, down->distance);
    EXPECT_EQ(Vec3(Vec3::UnitZ()), down->normal);
    EXPECT_FALSE(first_hit(cylinder, {Vec3(0.6, 0, 5), -Vec3::UnitZ()}));
    const RingShape ring{Vec3::Zero(), Vec3::UnitZ(), 1, 0.1};
    EXPECT_FALSE(first_hit(ring, {Vec3(0, 0, 5), -Vec3::UnitZ()}));
    const auto on_tube = first_hit(ring, {Vec3(1, 0, 5), -Vec3::UnitZ()});
    ASSERT_TRUE(on_tube);
    EXPECT_NEAR(4.9, on_tube->distance, 1e-12);
}

TEST(Ray, WallsHaveTwoSides) {
    const BowlShape bowl{Vec3::Zero(), 1, Vec3::UnitZ(), 1};
    const auto inside = first_hit(bowl, {Vec3(0, 0, 2), -Vec3::UnitZ()});
    ASSERT_TRUE(inside);
    EXPECT_DOUBLE_EQ(3, inside->distance);
    EXPECT_EQ(Vec3(Vec3::UnitZ()), inside->normal);
    const auto outside = first_hit(bowl, {Vec3(0, 0, -2), Vec3::UnitZ()});
    ASSERT_TRUE(outside);
    EXPECT_DOUBLE_EQ(1, outside->distance);
    EXPECT_EQ(-Vec3(Vec3::UnitZ()), outside->normal);
}

}  // namespace
}  // namespace carom
