// What is told cheaply agrees with the exact answer.
#include "sim/collide/sure_miss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carom {
namespace {

/// Random numbers of both signs over several decades, and now and then a 0.
class Draw {
  public:
    double number() {
        if (random_() % 8 == 0) return 0;
        return (random_() % 2 == 0 ? 1 : -1) * std::pow(10, unit_(random_));
    }
    Vec3 vector() {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }

  private:
    std::mt19937 random_{4};
    std::uniform_real_distribution<double> unit_{-2, 1};
};

TEST(SureMiss, OfBallsIsNeverWrong) {
    Draw draw;
    int sure = 0, hits = 0;
    for (int i = 0; i < 200'000; ++i) {
        const Path path{draw.vector(), draw.vector(), Vec3::Zero()};
        const double sum = std::abs(draw.number()) + 0.01;
        const double distance2 = path.position.squaredNorm();
        const double closing = path.position.dot(path.velocity);
        if (distance2 <= sum * sum || closing >= 0) continue;
        const double seconds = std::abs(draw.number());
        const TimeOfImpact exact = impact_with_sphere(path, sum, false, seconds);
        const bool apart = surely_apart(path, distance2, closing, sum, seconds);
        sure += apart ? 1 : 0;
        hits += exact.state == ImpactState::kHit ? 1 : 0;
        ASSERT_FALSE(apart && exact.state != ImpactState::kMiss) << "trial " << i;
    }
    EXPECT_GT(sure, 20'000);
    EXPECT_GT(hits, 1000);
}

TEST(SureMiss, OfPlanesIsNeverWrong) {
    Draw draw;
    int sure = 0, hits = 0;
    for (int i = 0; i < 200'000; ++i) {
        Vec3 normal = draw.vector();
        if (!(normal.norm() > 0)) continue;
        normal.normalize();
        const PlaneShape plane{normal, draw.number()};
        const Path path{draw.vector(), draw.vector(), draw.vector()};
        const double radius = std::abs(draw.number()) + 0.01;
        const double seconds = std::abs(draw.number());
        const bool clear = surely_clear_of(plane, path, radius, 0, seconds);
        const double gap = normal.dot(path.position) - plane.offset_m - radius;
        const TimeOfImpact exact = impact_with_plane(path, radius, plane, false, seconds);
        sure += clear ? 1 : 0;
        hits += exact.state == ImpactState::kHit ? 1 : 0;
        ASSERT_FALSE(clear && (gap < 0 || exact.state != ImpactState::kMiss)) << "trial " << i;
    }
    EXPECT_GT(sure, 20'000);
    EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace carom
