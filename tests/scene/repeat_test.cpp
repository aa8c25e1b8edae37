// Grids of balls, and the random numbers that move them.
#include "scene/repeat.h"

#include <fmt/core.h>

#include <random>

#include "scene_testing.h"

namespace carom {
namespace {

TEST(Repeat, PlacesAGridWithOneSpacingPerAxis) {
    const Scene scene = scene_of(
        "carom: 1\nballs: [{name: c, radius: 0.1, position: [1, 2, 3], mass: 2, repeat: {count: "
        "[2, 3, 4], spacing: [1, -2, 0.5]}}]");
    ASSERT_EQ(scene.balls.size(), 24U);
    std::size_t n = 0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 4; ++k, ++n) {
                EXPECT_EQ(scene.balls[n].name, fmt::format("c_{}_{}_{}", i, j, k));
                EXPECT_EQ(scene.balls[n].position, Vec3(1 + i, 2 - 2 * j, 3 + 0.5 * k));
                EXPECT_EQ(scene.balls[n].mass, 2);
            }
}

TEST(Repeat, DropHeightServesAGridToo) {
    const Scene scene = scene_of(
        "carom: 1\nballs: [{name: c, radius: 0.1, drop_height: 1, at: [1, 1], repeat: {count: "
        "[1, 1, 2], spacing: 0.3}}]");
    EXPECT_EQ(scene.balls.at(0).position, Vec3(1, 1, 1.1));
    EXPECT_DOUBLE_EQ(scene.balls.at(1).position.z(), 1.4);
}

TEST(Repeat, JitterIsUniformBelowItsBound) {
    Ball ball;
    ball.name = "c";
    const std::vector<Ball> balls = repeat_ball(ball, {{100, 100, 1}, Vec3(1, 1, 1), 0.001, 7});
    ASSERT_EQ(balls.size(), 10000U);
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < balls.size(); ++n) {
        const Vec3 moved =
            balls[n].position - Vec3(static_cast<double>(n / 100), static_cast<double>(n % 100), 0);
        EXPECT_GE(moved.minCoeff(), -1e-12);  // rounding of coordinates up to 100
        EXPECT_LT(moved.maxCoeff(), 0.001 + 1e-12);
        sum += moved;
    }
    // The mean of 10000 has a standard deviation of 0.001 / sqrt(12 * 10000) = 2.9e-6.
    const Vec3 mean = sum / 10000;
    fmt::print("means {} {} {} against 0.0005 +- 1.2e-5\n", mean.x(), mean.y(), mean.z());
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mean[axis], 0.0005, 1.2e-5);
}

TEST(Repeat, JitterIsTheDocumentedGenerator) {
    Ball ball;
    const std::vector<Ball> balls = repeat_ball(ball, {{2, 1, 1}, Vec3(1, 1, 1), 0.5, 42});
    std::mt19937_64 generator(42);
    for (int n = 0; n < 2; ++n)
        for (int axis = 0; axis < 3; ++axis) {
            const double u = static_cast<double>(generator() >> 11U) / 9007199254740992.0;
            const double start = axis == 0 ? n : 0;
            EXPECT_EQ(balls[static_cast<std::size_t>(n)].position[axis], start + 0.5 * u);
        }
    // The C++ standard fixes the 10000th output of the default seed.
    std::mt19937_64 standard;
    standard.discard(9999);
    EXPECT_EQ(standard(), 9981545732273789042ULL);
}

TEST(Repeat, SeedsDifferAndRepeatThemselves) {
    const std::string head =
        "carom: 1\nballs: [{name: c, radius: 0.1, position: [0, 0, 1], repeat: {count: [3, 3, 3], "
        "spacing: 0.3, jitter: 0.01";
    const Scene one = scene_of(head + "}}]");
    const Scene same = scene_of(head + ", seed: 1}}]");
    const Scene other = scene_of(head + ", seed: 2}}]");
    int equal_to_other = 0;
    for (std::size_t n = 0; n < one.balls.size(); ++n) {
        EXPECT_EQ(one.balls[n].position, same.balls[n].position);
        equal_to_other += one.balls[n].position == other.balls[n].position;
    }
    EXPECT_EQ(equal_to_other, 0);
}

TEST(Repeat, RefusesWhatDoesNotFit) {
    const auto errors = [](const std::string& name, const std::string& repeat) {
        return errors_of("carom: 1\nballs:\n  - {name: " + name +
                         ", radius: 0.1, position: [0, 0, 1], repeat: " + repeat + "}");
    };
    EXPECT_EQ(errors("c", "{count: [0, 1, 1], spacing: 1}"),
              "t.yaml:3:66: error: 'count' must be at least 1, not 0\n");
    EXPECT_EQ(errors("c", "{count: [1000, 1000, 2], spacing: 1}"),
              "t.yaml:3:65: error: this makes 2000000 balls; a scene may have at most 1000000\n");
    EXPECT_EQ(errors("c", "{count: [1000000, 1000000, 1000000], spacing: 1}"),
              "t.yaml:3:65: error: this makes 1000000000000000000 balls; a scene may have at most "
              "1000000\n");
    EXPECT_EQ(
        errors("c", "{count: [2, 2, 2], spacing: 0.19}"),
        "t.yaml:3:5: error: the balls 'c_0_0_0' and 'c_0_0_1' overlap by 0.01 m at the start\n");
    EXPECT_EQ(errors(std::string(60, 'n'), "{count: [1, 1, 1], spacing: 1}"),
              "t.yaml:3:12: error: with 'repeat' the name grows to '" + std::string(60, 'n') +
                  "_0_0_0', longer than 64 characters\n");
    EXPECT_EQ(errors("c",
                     "{count: [2, 1, 1], spacing: 1}}\n  - {name: c_1_0_0, radius: 0.1, "
                     "position: [9, 9, 9]"),
              "t.yaml:4:12: error: the name 'c_1_0_0' is taken already, by the ball in line 3\n");
}

}  // namespace
}  // namespace carom
