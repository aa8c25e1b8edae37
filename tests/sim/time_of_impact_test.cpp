// Times of impact against a bisection on the distance, for every kind of surface.
#include "sim/collide/time_of_impact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "geometry/nearest.h"
#include "sim/collide/time_of_impact_high_degree.h"

namespace carom {
namespace {

/// Where the gap first turns negative, by small steps and bisection. Empty: nowhere.
std::optional<double> reference(const Path& path, double radius, const SurfaceShape& shape,
                                double horizon) {
    const auto gap = [&](double s) { return nearest_on(shape, path.at(s), radius).gap; };
    constexpr int kSteps = 4000;
    for (int i = 1; i <= kSteps; ++i) {
        double high = horizon * i / kSteps;
        if (gap(high) >= 0) continue;
        double low = horizon * (i - 1) / kSteps;
        for (int k = 0; k < 100; ++k) {
            const double middle = 0.5 * (low + high);
            (gap(middle) < 0 ? high : low) = middle;
        }
        return high;
    }
    return std::nullopt;
}

struct Tally {
    int hits = 0;
    int misses = 0;
    int steep = 0;  ///< hits that are not grazing
    double worst = 0;
};

/// Balls from all sides, aimed at places in and around the surface.
Tally shoot(const SurfaceShape& shape, const Vec3& center, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    Tally tally;
    for (int trial = 0; trial < 600; ++trial) {
        const double radius = 0.05 + 0.2 * std::abs(unit(random));
        const Vec3 away = Vec3(unit(random), unit(random), unit(random)).normalized();
        const Vec3 aim = center + size * Vec3(unit(random), unit(random), unit(random));
        Path path;
        path.position = center + (2 * size + radius + 1) * away;
        path.velocity = (1 + 3 * std::abs(unit(random))) * (aim - path.position).normalized();
        if (trial % 2 == 1) path.acceleration = 3 * Vec3(unit(random), unit(random), unit(random));
        const double horizon = 6;
        if (nearest_on(shape, path.position, radius).gap <= 0) continue;
        const auto expected = reference(path, radius, shape, horizon);
        const TimeOfImpact found = impact_with_surface(path, radius, shape, false, horizon);
        EXPECT_NE(found.state, ImpactState::kCapped);
        EXPECT_NE(found.state, ImpactState::kPressed);
        if (!expected) {
            // The steps may have jumped over a graze; then the gap is 0 and shrinking there.
            if (found.state == ImpactState::kHit) {
                EXPECT_NEAR(nearest_on(shape, path.at(found.s), radius).gap, 0, 1e-12);
            }
            ++tally.misses;
            continue;
        }
        ++tally.hits;
        EXPECT_EQ(found.state, ImpactState::kHit) << "trial " << trial << " at " << *expected;
        const Nearest met = nearest_on(shape, path.at(*expected), radius);
        const Vec3 v = path.velocity + *expected * path.acceleration;
        if (found.s < *expected - 1e-6) {  // a graze that the steps jumped over
            EXPECT_NEAR(nearest_on(shape, path.at(found.s), radius).gap, 0, 1e-12);
            continue;
        }
        if (-met.normal.dot(v) < 0.05 * v.norm()) continue;
        ++tally.steep;
        tally.worst = std::max(tally.worst, std::abs(found.s - *expected));
    }
    return tally;
}

void expect_good(const Tally& tally, const char* name) {
    std::printf("%s: %d hits, %d misses, within %.3g s\n", name, tally.hits, tally.misses,
                tally.worst);
    EXPECT_GT(tally.steep, 100);
    EXPECT_LE(tally.worst, 2e-13);
}

/// Speeds that halving has left, 1e-80 of a pull that is none: it stays where it is.
TEST(TimeOfImpact, WhatAllButLiesStillMeetsNothing) {
    const Path path{Vec3(-1.4793942359241028, -1.4793942359663039, -1.479394235958539),
                    Vec3(0, -1.7162190754680852e-87, -1.9053859328855673e-103),
                    Vec3(0, 2.1175823681357508e-19, 7.6215437315422694e-100)};
    const SphereShape sphere{Vec3(0.943745906692568, 1.1456224097128338, 0.0450298876335), 0.166};
    EXPECT_EQ(impact_with_surface(path, 0.02, sphere, false, 0.25).state, ImpactState::kMiss);
}

TEST(TimeOfImpact, Plane) {
    const Vec3 n = Vec3(1, 2, 3).normalized();
    expect_good(shoot(PlaneShape{n, 0.3}, 0.3 * n, 1, 1), "plane");
}

TEST(TimeOfImpact, Sphere) {
    expect_good(shoot(SphereShape{Vec3(1, 2, 3), 0.7}, Vec3(1, 2, 3), 0.7, 2), "sphere");
}

TEST(TimeOfImpact, Capsule) {
    expect_good(shoot(CapsuleShape{Vec3(-0.5, 0.2, 0), Vec3(0.6, 0.1, 0.4), 0.2},
                      Vec3(0.05, 0.15, 0.2), 0.7, 3),
                "capsule");
}

TEST(TimeOfImpact, BoxFacesEdgesAndCorners) {
    const Quat turn(Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()));
    expect_good(
        shoot(BoxShape{Vec3(0.1, 0, -0.2), Vec3(1, 0.6, 0.3), turn}, Vec3(0.1, 0, -0.2), 0.6, 4),
        "box");
    expect_good(
        shoot(BoxShape{Vec3::Zero(), Vec3(1, 1, 1e-3), Quat::Identity()}, Vec3::Zero(), 0.5, 5),
        "plate");
    expect_good(shoot(BoxShape{Vec3::Zero(), Vec3(2, 1e-3, 1e-3), turn}, Vec3::Zero(), 0.4, 6),
                "bar");
}

TEST(TimeOfImpact, CylinderEndsShaftAndRims) {
    expect_good(shoot(CylinderShape{Vec3(-0.5, 0.2, 0), Vec3(0.6, 0.1, 0.4), 0.4},
                      Vec3(0.05, 0.15, 0.2), 0.6, 7),
                "cylinder");
    expect_good(shoot(CylinderShape{Vec3::Zero(), Vec3(1e-3, 0, 0), 0.7}, Vec3::Zero(), 0.5, 8),
                "disc");
    expect_good(shoot(CylinderShape{Vec3(0, -1, 0), Vec3(0, 1, 0), 1e-3}, Vec3::Zero(), 0.4, 9),
                "needle");
}

TEST(TimeOfImpact, RingFromAllSides) {
    const Vec3 axis = Vec3(1, -2, 0.5).normalized();
    expect_good(shoot(RingShape{Vec3(0.1, 0, -0.2), axis, 0.6, 0.1}, Vec3(0.1, 0, -0.2), 0.6, 10),
                "ring");
    // Thinner than the balls, and with a hole that is too small for them.
    expect_good(shoot(RingShape{Vec3::Zero(), axis, 0.7, 1e-3}, Vec3::Zero(), 0.6, 11), "wire");
    expect_good(shoot(RingShape{Vec3::Zero(), axis, 0.2, 0.15}, Vec3::Zero(), 0.3, 12), "knob");
}

TEST(TimeOfImpact, BowlsAndPipesFromAllSides) {
    const Vec3 up = Vec3(1, -2, 0.5).normalized();
    expect_good(shoot(BowlShape{Vec3(0.1, 0, -0.2), 0.6, up, 0.6}, Vec3(0.1, 0, -0.2), 0.6, 13),
                "bowl");
    expect_good(shoot(BowlShape{Vec3::Zero(), 0.8, up, 0.2}, Vec3(-0.6 * up), 0.5, 14), "dish");
    expect_good(shoot(BowlShape{Vec3::Zero(), 0.6, up, 1.1}, Vec3::Zero(), 0.6, 15), "jar");
    const Vec3 across = up.unitOrthogonal();
    const auto pipe = [&](double angle) {
        return PipeShape{Vec3(-0.5 * up), Vec3(0.5 * up), 0.5, across, angle};
    };
    expect_good(shoot(pipe(3.14), Vec3::Zero(), 0.6, 16), "half pipe");
    expect_good(shoot(pipe(5.5), Vec3::Zero(), 0.6, 17), "slit pipe");
    expect_good(shoot(pipe(7), Vec3::Zero(), 0.6, 18), "tube");
}

TEST(TimeOfImpact, FastBallAgainstThinPlate) {
    for (int phase = 0; phase < 1000; ++phase) {
        const double z0 = 2 + 0.001 * phase;
        const Path path{Vec3(0.1, 0.2, z0), Vec3(0, 0, -1000), Vec3::Zero()};
        const TimeOfImpact found = impact_with_surface(
            path, 0.05, BoxShape{Vec3::Zero(), Vec3(1, 1, 1e-3), Quat::Identity()}, false, 1);
        ASSERT_EQ(found.state, ImpactState::kHit);
        EXPECT_NEAR(found.s, (z0 - 0.05 - 5e-4) / 1000, 1e-15);
    }
}

TEST(TimeOfImpact, GrazingIsDecidedBySign) {
    // Numbers that are exact in binary, so that 0 is 0.
    const double r = 0.125;
    for (const double speed : {1.0 / 64, 1.0, 1024.0})
        for (const double offset : {-1e-9, 0.0, 1e-9}) {
            const bool hit = offset < 0;
            const Vec3 v(speed, 0, 0);
            const double horizon = 20 / speed;
            const auto state = [&](const Vec3& at, const SurfaceShape& shape) {
                return impact_with_surface({at, v, Vec3::Zero()}, r, shape, false, horizon).state;
            };
            const ImpactState expected = hit ? ImpactState::kHit : ImpactState::kMiss;
            EXPECT_EQ(state(Vec3(-4, 0.5 + r + offset, 0), SphereShape{Vec3::Zero(), 0.5}),
                      expected);
            EXPECT_EQ(state(Vec3(-4, 0.5 + r + offset, 0),
                            CapsuleShape{Vec3(0, 0, -1), Vec3(0, 0, 1), 0.5}),
                      expected);
            EXPECT_EQ(state(Vec3(-4, 0.5 + r + offset, 0),
                            CylinderShape{Vec3(0, 0, -1), Vec3(0, 0, 1), 0.5}),
                      expected);
            // Inside a ring that stands upright, and by its outside.
            const RingShape ring{Vec3::Zero(), Vec3::UnitZ(), 0.75, 0.25};
            EXPECT_EQ(state(Vec3(-4, 1 + r + offset, 0), ring), expected);
            EXPECT_EQ(
                impact_with_surface({Vec3(0.375 - offset, 0, -4), Vec3(0, 0, speed), Vec3::Zero()},
                                    r, ring, false, horizon)
                    .state,
                expected);
            // Past the rim, across the top of a circle that stands upright.
            EXPECT_EQ(state(Vec3(-4, 0.5 + r + offset, 1),
                            CylinderShape{Vec3(0, 0, -1), Vec3(0, 0, 1), 0.5}),
                      expected);
            // Along a face of a box: it is met at the edge of the face in front.
            EXPECT_EQ(state(Vec3(-4, 0.5 + r + offset, 0),
                            BoxShape{Vec3::Zero(), Vec3(1, 1, 1), Quat::Identity()}),
                      expected);
            // Two balls.
            EXPECT_EQ(impact_with_sphere({Vec3(-4, 2 * r + offset, 0), v, Vec3::Zero()}, 2 * r,
                                         false, horizon)
                          .state,
                      expected);
        }
    // A parabola whose top is 1e-9 below, above, or just at a ceiling.
    for (const double offset : {-1e-9, 0.0, 1e-9}) {
        const Path path{Vec3(0, 0, 0), Vec3(0, 0, 4), Vec3(0, 0, -8)};  // rises by 1
        const PlaneShape ceiling{Vec3(0, 0, -1), -(1 + r + offset)};
        EXPECT_EQ(impact_with_plane(path, r, ceiling, false, 10).state,
                  offset < 0 ? ImpactState::kHit : ImpactState::kMiss);
    }
}

TEST(TimeOfImpact, TouchingBallMeetsAgainOnlyAfterItsHop) {
    const PlaneShape floor{Vec3::UnitZ(), 0};
    const Vec3 g(0, 0, -9.81);
    for (const double v : {1e-9, 1e-3, 5.0})
        for (const double rounding : {-1e-16, 0.0, 1e-16}) {
            const Path path{Vec3(0, 0, 0.1 + rounding), Vec3(1, 0, v), g};
            const TimeOfImpact found = impact_with_plane(path, 0.1, floor, true, 10);
            ASSERT_EQ(found.state, ImpactState::kHit);
            EXPECT_LE(std::abs(found.s / (2 * v / 9.81) - 1), 1e-15);
        }
}

// A gap of rounding counts as none, and so does the same gap when it shuts again; far from the
// origin, and against a rail as well.
TEST(TimeOfImpact, AGapThatCountsAsNoneDoesSoWhenItShutsAgain) {
    const Vec3 g(0, 0, -3);
    for (const double rounding : {0.0, 1.4e-14, 3e-12})
        for (const double v : {4e-8, 1e-7, 1e-3}) {
            const BoxShape box{Vec3(0.3, 0.1, -0.5), Vec3(2, 2, 1), Quat::Identity()};
            const Path path{Vec3(0.2, 0, 0.1 + rounding), Vec3(1e-7, 0, v), g};
            const CapsuleShape rail{Vec3(-1, 0, -0.05), Vec3(1, 0, -0.05), 0.05};
            const CylinderShape drum{Vec3(0.3, 0.1, -1), Vec3(0.3, 0.1, 0), 1};
            const CylinderShape roller{Vec3(-1, 0, -0.05), Vec3(1, 0, -0.05), 0.05};
            for (const SurfaceShape& shape : {SurfaceShape(box), SurfaceShape(rail),
                                              SurfaceShape(drum), SurfaceShape(roller)}) {
                const TimeOfImpact found = impact_with_surface(path, 0.1, shape, true, 10);
                ASSERT_EQ(found.state, ImpactState::kHit) << rounding << ", " << v;
                EXPECT_LE(std::abs(found.s / (2 * v / 3) - 1), 1e-9);
                Piece piece;
                piece.position = path.position;
                piece.velocity = path.velocity;
                piece.acceleration = g;
                const TimeOfImpact curved =
                    impact_with_surface(high_degree_path(piece, 0, 1), 0.1, shape, true);
                ASSERT_EQ(curved.state, ImpactState::kHit) << rounding << ", " << v;
                EXPECT_LE(std::abs(curved.s / (2 * v / 3) - 1), 1e-6);
            }
        }
}

TEST(TimeOfImpact, PressedAndReleased) {
    const PlaneShape floor{Vec3::UnitZ(), 0};
    const Vec3 at(0, 0, 0.1);
    EXPECT_EQ(impact_with_plane({at, Vec3(1, 0, 0), Vec3(0, 0, -1)}, 0.1, floor, true, 9).state,
              ImpactState::kPressed);
    EXPECT_EQ(impact_with_plane({at, Vec3(1, 0, 0), Vec3(0, 0, 1)}, 0.1, floor, true, 9).state,
              ImpactState::kMiss);
    EXPECT_EQ(impact_with_plane({at, Vec3(1, 0, 0), Vec3::Zero()}, 0.1, floor, true, 9).state,
              ImpactState::kMiss);
    // On a sphere: pressed while v^2 < g R, off it above.
    const SphereShape ball{Vec3::Zero(), 0.4};
    const Vec3 top(0, 0, 0.5);
    for (const double v2 : {0.4, 0.49, 0.51, 0.6})
        EXPECT_EQ(impact_with_surface({top, Vec3(std::sqrt(v2), 0, 0), Vec3(0, 0, -1)}, 0.1, ball,
                                      true, 9)
                      .state,
                  v2 < 0.5 ? ImpactState::kPressed : ImpactState::kMiss);
    // On a cylinder's end, and on its rim, along which v^2 / (R + r sin) draws outwards.
    const CylinderShape drum{Vec3(0, 0, -1), Vec3::Zero(), 0.4};
    const Vec3 up(0.6, 0, 0.8), on_rim = Vec3(0.4, 0, 0) + 0.1 * up;
    EXPECT_EQ(
        impact_with_surface({Vec3(0.2, 0, 0.1), Vec3(9, 0, 0), Vec3(0, 0, -1)}, 0.1, drum, true, 9)
            .state,
        ImpactState::kPressed);
    for (const double part : {0.99, 1.01}) {
        // g cos = v^2 sin / (R + r sin)
        const double v = std::sqrt(part * 0.8 * 0.46 / 0.6);
        EXPECT_EQ(
            impact_with_surface({on_rim, Vec3(0, v, 0), Vec3(0, 0, -1)}, 0.1, drum, true, 9).state,
            part < 1 ? ImpactState::kPressed : ImpactState::kMiss);
    }
    // On the face of a box, and on its edge, from which it may fall.
    const BoxShape box{Vec3::Zero(), Vec3(2, 2, 1), Quat::Identity()};
    EXPECT_EQ(
        impact_with_box({Vec3(0.2, 0, 0.6), Vec3::Zero(), Vec3(0, 0, -1)}, 0.1, box, true, 9).state,
        ImpactState::kPressed);
    EXPECT_EQ(
        impact_with_box({Vec3(0.2, 0, 0.6), Vec3(0, 0, 0.5), Vec3(0, 0, -1)}, 0.1, box, true, 9).s,
        1);
}

TEST(TimeOfImpact, NearestPoints) {
    const BoxShape box{Vec3::Zero(), Vec3(2, 2, 2), Quat::Identity()};
    const Nearest corner = nearest_on(box, Vec3(2, 2, 2), 0.5);
    EXPECT_NEAR(corner.gap, std::sqrt(3.0) - 0.5, 1e-15);
    EXPECT_LE((corner.normal - Vec3::Ones().normalized()).norm(), 1e-15);
    EXPECT_EQ(corner.point, Vec3::Ones());
    const Nearest inside = nearest_on(box, Vec3(0.9, 0, 0), 0.5);
    EXPECT_NEAR(inside.gap, -0.6, 1e-15);
    EXPECT_EQ(inside.normal, Vec3::UnitX());
    const CapsuleShape rail{Vec3::Zero(), Vec3(1, 0, 0), 0.1};
    EXPECT_NEAR(nearest_on(rail, Vec3(0.5, 0, 1), 0.2).gap, 0.7, 1e-15);
    EXPECT_NEAR(nearest_on(rail, Vec3(-3, 0, 4), 0.2).gap, 4.7, 1e-15);
}

}  // namespace
}  // namespace carom
