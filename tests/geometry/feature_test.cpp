// Which feature a ball is on, and that its core is where the nearest point says.
#include "geometry/feature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

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
            EXPECT_NEAR(f.from_core(x).norm(), f.distance, kRounding)
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
    const CylinderShape drum{{0, 0, 0}, {0, 3, 4}, 1};
    EXPECT_TRUE(is_flat(drum, Vec3(0, 0.6, 0.8)));
    EXPECT_TRUE(is_flat(drum, Vec3(0, -0.6, -0.8)));
    EXPECT_FALSE(is_flat(drum, Vec3::UnitX()));
}

TEST(Feature, ACylinderHasEndsAShaftAndRims) {
    const CylinderShape drum{Vec3::Zero(), {0, 0, 2}, 1};
    const auto at = [&](const Vec3& x, const Vec3& v = Vec3::Zero()) {
        return feature_at(drum, {x, v, Vec3::Zero()}, 0.5);
    };
    EXPECT_EQ(directions(at({0.3, 0.4, 2.5})), 1);
    EXPECT_EQ(directions(at({0, 1.5, 1})), 2);
    EXPECT_TRUE(at({1.3, 0, 2.4}).has_circle());
    EXPECT_FALSE(at({0.3, 0.4, 2.5}).has_circle());
    // On the border of an end the motion decides; one that goes along it leaves it outwards.
    EXPECT_TRUE(at({1, 0, 2.5}, {1, 0, 0}).has_circle());
    EXPECT_TRUE(at({1, 0, 2.5}, {0, 1, 0}).has_circle());
    EXPECT_FALSE(at({1, 0, 2.5}, {-1, 0, 0}).has_circle());
    // Beside it the shaft begins.
    EXPECT_TRUE(at({0, 1.5, 2}, {0, 0, 1}).has_circle());
    EXPECT_FALSE(at({0, 1.5, 2}, {0, 0, -1}).has_circle());
}

/// The rate of the normal is that of what normal_at() says a little earlier and later, for every
/// feature, along the surface and also away from it.
TEST(Feature, NormalsTurnAsTheyDoOverAShortTime) {
    constexpr double kStep = 1e-4;  // what its third power leaves is 1e-12 of a few 1/s
    double worst = 0;
    for (const SurfaceShape& shape : one_of_each())
        for (const Vec3& p : places()) {
            if (signed_distance(shape, p) <= 0) continue;
            const Vec3 x = touching(shape, p, 0.2), v(0.7, -0.4, 0.9);
            const Feature f = feature_at(shape, {x, Vec3::Zero(), Vec3::Zero()}, 0.2);
            const FeatureMotion m = f.motion_at(x, v);
            const auto normal = [&](double s) { return f.normal_at(x + s * v); };
            const Vec3 near = (normal(kStep) - normal(-kStep)) / (2 * kStep);
            const Vec3 far = (normal(2 * kStep) - normal(-2 * kStep)) / (4 * kStep);
            worst = std::max(worst, (m.normal_rate - (4 * near - far) / 3).norm());
            EXPECT_LT((m.normal - f.normal_at(x)).norm(), kRounding);
            // The gap changes at second order by what the law asks.
            const auto gap = [&](double s) { return f.gap_at(x + s * v); };
            const double bend = (gap(kStep) + gap(-kStep) - 2 * gap(0)) / (kStep * kStep);
            EXPECT_NEAR(bend, m.turning_speed.dot(m.normal_rate), 1e-6) << shape.index();
        }
    std::printf("rates of normals: within %.2g 1/s\n", worst);
    EXPECT_LT(worst, 1e-10);
}

}  // namespace
}  // namespace carom
