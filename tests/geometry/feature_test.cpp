// Which feature a ball is on, and that its core is where the nearest point says.
#include "geometry/feature.h"

#include <gtest/gtest.h>

#include "geometry/nearest.h"
#include "shapes.h"

namespace carom {
namespace {

constexpr double kRounding = 1e-14;

/// A ball's centre over the nearest point of the shape.
Vec3 touching(const SurfaceShape& shape, const Vec3& p, double radius) {
    const Nearest n = nearest_on(shape, p, 0);
    return n.point + radius * n.normal;
}

/// Rank of `across`: 1 on a face, 2 on an edge or a shaft, 3 on a corner or a sphere.
double directions(const Feature& f) { return f.across.trace(); }

TEST(Feature, CentersKeepTheirDistanceFromTheCore) {
    for (const SurfaceShape& shape : one_of_each())
        for (const Vec3& p : places()) {
            if (signed_distance(shape, p) <= 0) continue;
            const Vec3 x = touching(shape, p, 0.2);
            const Feature f = feature_at(shape, {x, Vec3::Zero(), Vec3::Zero()}, 0.2);
            EXPECT_NEAR((f.across * (x - f.origin)).norm(), f.distance, kRounding)
                << shape.index() << " at " << p.transpose();
            EXPECT_LT((f.normal_at(x) - nearest_on(shape, x, 0.2).normal).norm(), 10 * kRounding)
                << shape.index();
            for (int i = 0; i < f.border_count; ++i)
                EXPECT_GE(f.borders[std::size_t(i)].margin(x), -kRounding) << shape.index();
        }
}

TEST(Feature, ABoxHasFacesEdgesAndCorners) {
    const BoxShape box{Vec3::Zero(), {2, 2, 2}, Quat::Identity()};
    const auto at = [&](const Vec3& x) {
        return directions(feature_at(box, {x, Vec3::Zero(), Vec3::Zero()}, 0.5));
    };
    EXPECT_EQ(at({0, 0, 1.5}), 1);
    EXPECT_EQ(at({1.3, 0, 1.4}), 2);
    EXPECT_EQ(at({1.1, 1.2, 1.4}), 3);
}

TEST(Feature, OnABorderTheMotionDecides) {
    const BoxShape box{Vec3::Zero(), {2, 2, 2}, Quat::Identity()};
    const auto on_border = [&](const Vec3& v, const Vec3& pull) {
        return directions(feature_at(box, {{1, 0, 1.5}, v, pull}, 0.5));
    };
    EXPECT_EQ(on_border({1, 0, 0}, Vec3::Zero()), 2);  // out, over the edge
    EXPECT_EQ(on_border({-1, 0, 0}, {5, 0, 0}), 1);    // in, onto the face
    EXPECT_EQ(on_border({0, 1, 0}, {5, 0, -9}), 2);    // along: the pull decides
    EXPECT_EQ(on_border({0, 1, 0}, {-5, 0, -9}), 1);
    const CapsuleShape rail{{0, 0, 0}, {2, 0, 0}, 0.1};
    const auto on_rail = [&](const Vec3& v) {
        return directions(feature_at(rail, {{2, 0, 0.3}, v, Vec3::Zero()}, 0.2));
    };
    EXPECT_EQ(on_rail({1, 0, 0}), 3);   // the end
    EXPECT_EQ(on_rail({-1, 0, 0}), 2);  // the shaft
}

TEST(Feature, PlanesAndFacesAreFlat) {
    const std::vector<SurfaceShape> shapes = one_of_each();
    EXPECT_TRUE(is_flat(shapes[0], std::get<PlaneShape>(shapes[0]).normal));
    EXPECT_TRUE(is_flat(shapes[1], kTurned * Vec3(0, -1, 0)));
    EXPECT_FALSE(is_flat(shapes[1], kTurned * Vec3(0.6, 0.8, 0)));
    EXPECT_FALSE(is_flat(shapes[2], Vec3::UnitZ()));
    EXPECT_FALSE(is_flat(shapes[3], Vec3::UnitZ()));
}

}  // namespace
}  // namespace carom
