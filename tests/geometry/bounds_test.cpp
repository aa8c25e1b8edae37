// Bounds of shapes, and shapes seen from elsewhere.
#include "geometry/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"
#include "geometry/translation.h"
#include "shapes.h"

namespace carom {
namespace {

TEST(Bounds, APlaneHasNone) {
    EXPECT_TRUE(bounds_of(PlaneShape{}).isEmpty());
    EXPECT_TRUE(is_unbounded(PlaneShape{}));
}

/// The support of a shape along an axis, found from far away: there the nearest point is the
/// outermost one.
TEST(Bounds, AreAsTightAsTheShape) {
    constexpr double kFar = 1e8;
    for (const SurfaceShape& shape : one_of_each()) {
        if (is_unbounded(shape)) continue;
        const Box3 bounds = bounds_of(shape);
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 far = kFar * Vec3::Unit(axis);
            EXPECT_NEAR(bounds.max()[axis], kFar - signed_distance(shape, far), 1e-6)
                << shape.index();
            EXPECT_NEAR(bounds.min()[axis], signed_distance(shape, -far) - kFar, 1e-6)
                << shape.index();
        }
    }
}

/// Every point of the shape lies within, and some at most a little below the sphere.
TEST(Bounds, SpheresHoldTheShape) {
    for (const SurfaceShape& shape : one_of_each()) {
        const SphereAround around = sphere_around(shape);
        if (is_unbounded(shape)) {
            EXPECT_EQ(around.radius, HUGE_VAL);
            continue;
        }
        double farthest = 0;
        for (const Vec3& p : places()) {
            // Outwards from the middle, through the nearest point of a place far away.
            const Vec3 far = around.center + 1e6 * (p - around.center).normalized();
            farthest = std::max(farthest, (nearest_on(shape, far, 0).point - around.center).norm());
        }
        EXPECT_LE(farthest, around.radius * (1 + 1e-9)) << shape.index();
        EXPECT_GE(farthest, around.radius * 0.8) << shape.index();
    }
}

TEST(Translation, KeepsDistances) {
    const Vec3 origin(3, -2, 1);
    for (const SurfaceShape& shape : one_of_each())
        for (const Vec3& p : places())
            EXPECT_NEAR(signed_distance(seen_from(shape, origin), p - origin),
                        signed_distance(shape, p), 2e-15)
                << shape.index();
}

/// A plane 1e6 m from the origin: normal . origin and the offset are large, and their difference is
/// known to its own last digits.
TEST(Translation, APlaneFarAwayLosesOneRounding) {
    const Vec3 normal = Vec3(3, 4, 12) / 13, origin(1e6, -7e5, 3e5);
    // Some 3e5 m: a double has it to 6e-11 m, the extended numbers here to 1e-14 m.
    const long double exact = static_cast<long double>(normal.x()) * 1e6L -
                              static_cast<long double>(normal.y()) * 7e5L +
                              static_cast<long double>(normal.z()) * 3e5L;
    const double offset = static_cast<double>(exact) + 0.25;
    const PlaneShape seen = std::get<PlaneShape>(seen_from(PlaneShape{normal, offset}, origin));
    EXPECT_NEAR(seen.offset_m, static_cast<double>(offset - exact), 1e-13);
}

TEST(Shapes, AreEqualWhereTheirNumbersAre) {
    const std::vector<SurfaceShape> all = one_of_each();
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < all.size(); ++j)
            EXPECT_EQ(all[i] == one_of_each()[j], i == j) << i << ", " << j;
}

}  // namespace
}  // namespace carom
