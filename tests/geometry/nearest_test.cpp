// The nearest point of each shape, by closed forms and by what every nearest point is.
#include "geometry/nearest.h"

#include <gtest/gtest.h>

#include <random>

#include "shapes.h"

namespace carom {
namespace {

constexpr double kNearestRounding = 1e-14;

TEST(Nearest, ABoxHasFacesEdgesAndCorners) {
    const BoxShape box{Vec3::Zero(), {2, 4, 6}, Quat::Identity()};
    EXPECT_NEAR(nearest_on(box, {5, 0, 0}, 0.5).gap, 3.5, kNearestRounding);      // a face
    EXPECT_NEAR(nearest_on(box, {4, 6, 0}, 0.5).gap, 5 - 0.5, kNearestRounding);  // an edge: 3-4-5
    EXPECT_NEAR(nearest_on(box, {3, 4, 4}, 0.5).gap, 3 - 0.5, kNearestRounding);  // a corner: 2-2-1
    EXPECT_LT((nearest_on(box, {4, 6, 0}, 0.5).normal - Vec3(0.6, 0.8, 0)).norm(),
              kNearestRounding);
    EXPECT_EQ(nearest_on(box, {3, 4, 4}, 0).point, Vec3(1, 2, 3));
}

TEST(Nearest, InsideABoxTheNearestFaceCounts) {
    const BoxShape box{Vec3::Zero(), {2, 4, 6}, Quat::Identity()};
    const Nearest inside = nearest_on(box, {-0.75, 1, 0}, 0.5);
    EXPECT_NEAR(inside.gap, -0.25 - 0.5, kNearestRounding);
    EXPECT_EQ(inside.normal, Vec3(-1, 0, 0));
    EXPECT_EQ(inside.point, Vec3(-1, 1, 0));
}

TEST(Nearest, OnTheCoreOfWhatIsRoundEveryDirectionIsAsGood) {
    EXPECT_EQ(nearest_on(SphereShape{{1, 2, 3}, 0.5}, {1, 2, 3}, 0.1).normal, Vec3::UnitZ());
    EXPECT_NEAR(nearest_on(CapsuleShape{{0, 0, 0}, {2, 0, 0}, 0.5}, {1, 0, 0}, 0.1).gap, -0.6,
                kNearestRounding);
}

TEST(Nearest, ACylinderHasEndsAShaftAndRims) {
    const CylinderShape drum{Vec3::Zero(), {0, 0, 2}, 1};
    EXPECT_NEAR(nearest_on(drum, {0.3, 0.4, 5}, 0.5).gap, 2.5, kNearestRounding);    // an end
    EXPECT_NEAR(nearest_on(drum, {3, 4, 1.9}, 0.5).gap, 4 - 0.5, kNearestRounding);  // the shaft
    EXPECT_NEAR(nearest_on(drum, {2.4, 3.2, 6}, 0.5).gap, 5 - 0.5,
                kNearestRounding);  // a rim: 3-4-5
    EXPECT_LT((nearest_on(drum, {2.4, 3.2, 6}, 0.5).normal - Vec3(0.36, 0.48, 0.8)).norm(),
              kNearestRounding);
    EXPECT_LT((nearest_on(drum, {2.4, 3.2, 6}, 0.5).point - Vec3(0.6, 0.8, 2)).norm(),
              kNearestRounding);
    // Inside, what is nearest counts; on the axis every way to the shaft is as good.
    EXPECT_NEAR(nearest_on(drum, {0.3, 0.4, 0.4}, 0).gap, -0.4, kNearestRounding);
    EXPECT_EQ(nearest_on(drum, {0.3, 0.4, 0.4}, 0).normal, Vec3(0, 0, -1));
    EXPECT_NEAR(nearest_on(CylinderShape{Vec3::Zero(), {0, 0, 9}, 1}, {0, 0, 4}, 0).gap, -1,
                kNearestRounding);
}

TEST(Nearest, ARingIsRoundAllAround) {
    const RingShape ring{Vec3::Zero(), Vec3::UnitZ(), 2, 0.5};
    EXPECT_NEAR(nearest_on(ring, {0, 0, 0}, 1).gap, 0.5, kNearestRounding);  // in the hole
    EXPECT_NEAR(nearest_on(ring, {3, 4, 4}, 0.5).gap, 4,
                kNearestRounding);  // 3-4-5 from the circle
    EXPECT_LT((nearest_on(ring, {3, 4, 4}, 0.5).normal - Vec3(0.36, 0.48, 0.8)).norm(),
              kNearestRounding);
    EXPECT_NEAR(nearest_on(ring, {1.2, 1.6, 0.25}, 0).gap, -0.25,
                kNearestRounding);  // inside the tube
    EXPECT_EQ(nearest_on(ring, {1, 0, 0}, 0).normal, Vec3(-1, 0, 0));
}

TEST(Nearest, ABowlHasTwoSidesAndARim) {
    const BowlShape bowl{Vec3::Zero(), 1, Vec3::UnitZ(), 0.4};  // the rim: 0.8 wide, at z = -0.6
    EXPECT_NEAR(nearest_on(bowl, {0, 0, -0.5}, 0.2).gap, 0.3, kNearestRounding);
    EXPECT_EQ(nearest_on(bowl, {0, 0, -0.5}, 0.2).normal, Vec3::UnitZ());
    EXPECT_NEAR(nearest_on(bowl, {0, 0, -2}, 0.2).gap, 0.8, kNearestRounding);
    EXPECT_EQ(nearest_on(bowl, {0, 0, -2}, 0.2).normal, Vec3(0, 0, -1));
    EXPECT_NEAR(nearest_on(bowl, {0.8 + 3, 0, -0.6 + 4}, 0.2).gap, 4.8, kNearestRounding);  // 3-4-5
    EXPECT_NEAR(nearest_on(BowlShape{Vec3::Zero(), 1, Vec3::UnitZ(), 2}, {0, 0, 0.7}, 0).gap, 0.3,
                kNearestRounding);
}

TEST(Nearest, APipeHasAWallEdgesAndEnds) {
    const PipeShape half{Vec3::Zero(), Vec3(2, 0, 0), 1, Vec3::UnitZ(), 3.14159265358979312};
    EXPECT_NEAR(nearest_on(half, {1, 0, -0.3}, 0.2).gap, 0.5, kNearestRounding);
    EXPECT_EQ(nearest_on(half, {1, 0, -0.3}, 0.2).normal, Vec3::UnitZ());
    EXPECT_NEAR(nearest_on(half, {1, 0, -1.5}, 0.2).gap, 0.3, kNearestRounding);
    EXPECT_NEAR(nearest_on(half, {1, 1.3, 0.4}, 0.2).gap, 0.3, kNearestRounding);   // an edge
    EXPECT_NEAR(nearest_on(half, {1, -1.3, 0.4}, 0.2).gap, 0.3, kNearestRounding);  // the other
    EXPECT_NEAR(nearest_on(half, {2.4, 0, -1.3}, 0.2).gap, 0.3, kNearestRounding);  // an end
    EXPECT_NEAR(nearest_on(half, {-2, 1 + 1, 2}, 0.2).gap, 2.8,
                kNearestRounding);  // a corner: 2-1-2
    const PipeShape tube{Vec3::Zero(), Vec3(2, 0, 0), 1, Vec3::UnitZ(), 7};
    EXPECT_NEAR(nearest_on(tube, {1, 0, 0.7}, 0.2).gap, 0.1, kNearestRounding);
}

TEST(Nearest, TurningAndMovingShapeAndPointChangesNoDistance) {
    const BoxShape box{Vec3::Zero(), {2, 4, 6}, Quat::Identity()};
    const Vec3 move(3, -1, 2);
    const BoxShape turned{kTurned * box.center + move, box.size, kTurned};
    for (const Vec3& p : places())
        EXPECT_NEAR(signed_distance(turned, kTurned * p + move), signed_distance(box, p),
                    kNearestRounding)
            << p.transpose();
}

/// The point is on the shape, the normal leads from it to the centre, and the distance is theirs.
TEST(Nearest, PointNormalAndGapBelongTogether) {
    for (const SurfaceShape& shape : one_of_each())
        for (const Vec3& p : places()) {
            const Nearest n = nearest_on(shape, p, 0.1);
            EXPECT_NEAR(n.normal.norm(), 1, kNearestRounding) << shape.index();
            EXPECT_LT((n.point + (n.gap + 0.1) * n.normal - p).norm(), kNearestRounding)
                << shape.index();
            EXPECT_NEAR(signed_distance(shape, n.point), 0, kNearestRounding) << shape.index();
        }
}

/// No point of the shape is nearer: tried on points that are at random on its surface.
TEST(Nearest, NothingOfTheShapeIsNearer) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-3, 3);
    for (const SurfaceShape& shape : one_of_each())
        for (int i = 0; i < 200; ++i) {
            const Vec3 of =
                nearest_on(shape, {number(random), number(random), number(random)}, 0).point;
            for (const Vec3& p : places()) {
                if (signed_distance(shape, p) < 0) continue;
                EXPECT_GE((of - p).norm(), signed_distance(shape, p) - kNearestRounding)
                    << shape.index();
            }
        }
}

}  // namespace
}  // namespace carom
