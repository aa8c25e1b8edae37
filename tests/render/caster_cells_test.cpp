// Balls that may shade one another are found without asking each.
#include "render/balls/caster_cells.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace carom {
namespace {

TEST(CasterCells, HoldEveryBallWhoseShadowMayReachAnother) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (const double largest : {0.1, 1.0}) {
        std::vector<BallInView> balls(3000);
        for (BallInView& ball : balls) {
            ball.center = Vec3(between(-20, 20), between(-20, 20), between(10, 50));
            ball.radius = between(0.05, largest);
        }
        const Vec3 to_light = Vec3(-0.5, 0.42, 1).normalized();
        const CasterCells cells(balls, to_light);
        int pairs = 0, looked_at = 0;
        for (const BallInView& ball : balls) {
            const std::vector<int>& near = cells.near(ball);
            EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
            looked_at += static_cast<int>(near.size());
            for (int i = 0; i < 3000; ++i) {
                const BallInView& other = balls[static_cast<std::size_t>(i)];
                const Vec3 rel = other.center - ball.center;
                const double along = rel.dot(to_light);
                const double across = (rel - along * to_light).norm();
                if (across > ball.radius + (1 + kLargestLamp) * other.radius) continue;
                ++pairs;
                EXPECT_TRUE(std::binary_search(near.begin(), near.end(), i));
            }
        }
        fmt::print("radii up to {} m: {} pairs, {} looked at, of {}\n", largest, pairs, looked_at,
                   3000 * 3000);
        EXPECT_GT(pairs, 3000);
    }
}

}  // namespace
}  // namespace carom
