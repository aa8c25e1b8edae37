// Velocity arrows.
#include "render/marks/velocity.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

TEST(Velocity, ArrowsAreExactAtTheInstant) {
    Sample sample = five_balls();
    sample.scene.overlay.velocity = VelocityOptions{0.1};
    const View view = view_of(sample, {1280, 720});
    const VelocityElement velocity(sample.scene, sample.motion, view, {});
    EXPECT_EQ(velocity.scale_s(), 0.1);
    double worst = 0;
    int arrows = 0;
    for (std::size_t ball = 0; ball < sample.motion.balls.size(); ++ball)
        for (double t = 0.013; t < 5; t += 0.37) {
            // A central difference is exact for a parabola, but across an impact.
            constexpr double kStep = 1e-4;
            const auto& path = sample.motion.balls[ball];
            if (path.piece_index(t - kStep) != path.piece_index(t + kStep)) continue;
            const Vec3 slope =
                (path.at(t + kStep).position - path.at(t - kStep).position) / (2 * kStep);
            const auto tip = view.project(path.at(t).position + 0.1 * slope);
            const auto arrow = velocity.arrow(ball, t);
            ASSERT_TRUE(arrow);
            worst = std::max(worst, (arrow->to - Vec2(tip.x_px, tip.y_px)).norm());
            ++arrows;
        }
    fmt::print("{} arrows within {:.1e} px of the slope of the path (bound 1e-6)\n", arrows, worst);
    EXPECT_GT(arrows, 50);
    EXPECT_LT(worst, 1e-6);
}

TEST(Velocity, TheChosenScaleIsRoundAndTheLongestArrowFits) {
    for (const double height : {0.002, 1.8, 700.0}) {
        Sample sample = drop(height, 0.1 * height, std::sqrt(height) * 2);
        sample.scene.overlay.velocity = VelocityOptions{};
        const View view = view_of(sample, {1280, 720});
        const VelocityElement velocity(sample.scene, sample.motion, view, {});
        const double digits = std::log10(velocity.scale_s());
        const double digit = std::pow(10, digits - std::floor(digits + 1e-9));
        EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 ||
                    std::abs(digit - 5) < 1e-6)
            << velocity.scale_s();
        double longest = 0;
        for (int k = 0; k <= 1000; ++k) {
            const auto arrow = velocity.arrow(0, sample.motion.duration * k / 1000);
            ASSERT_TRUE(arrow);
            longest = std::max(longest, (arrow->to - arrow->from).norm());
        }
        fmt::print("drop of {} m: scale {} s, longest arrow {:.0f} px of 720\n", height,
                   velocity.scale_s(), longest);
        EXPECT_LT(longest, 0.27 * 720);  // a quarter, and what perspective adds
        EXPECT_GT(longest, 0.08 * 720);
    }
}

TEST(Velocity, AnArrowPastTheEyeKeepsItsDirection) {
    Sample sample = empty_floor(1);
    add_ball(sample, "towards", 0.1, {straight(0, Vec3(0.2, 0, 1), Vec3(0.1, -10, 0.5))});
    add_ball(sample, "behind", 0.1, {straight(0, Vec3(0, -9, 1), Vec3(1, 0, 0))});
    sample.scene.camera.emplace();
    sample.scene.camera->from = Vec3(0, -4, 1);
    sample.scene.camera->to = Vec3(0, 0, 1);
    sample.scene.overlay.velocity = VelocityOptions{1.0};
    const View view = view_of(sample, {640, 360});
    VelocityElement velocity(sample.scene, sample.motion, view, {});
    const auto arrow = velocity.arrow(0, 0);
    ASSERT_TRUE(arrow);
    const auto near = view.project(Vec3(0.2, 0, 1) + 0.1 * Vec3(0.1, -10, 0.5));
    const Vec2 expected = Vec2(near.x_px, near.y_px) - arrow->from, drawn = arrow->to - arrow->from;
    EXPECT_NEAR(expected.normalized().dot(drawn.normalized()), 1, 1e-9);
    EXPECT_FALSE(velocity.arrow(1, 0));
    Image picture(640, 360);
    velocity.draw(0, picture);  // whatever its length
    EXPECT_GT(std::count_if(picture.bgra.begin(), picture.bgra.end(), [](int v) { return v > 0; }),
              100);
}

TEST(Velocity, ABallAtRestHasNone) {
    Sample sample = empty_floor(1);
    add_ball(sample, "still", 0.1, {straight(0, Vec3(0, 0, 0.1), Vec3::Zero())});
    sample.scene.overlay.velocity = VelocityOptions{};
    VelocityElement velocity(sample.scene, sample.motion, view_of(sample, {320, 180}), {});
    Image picture(320, 180);
    velocity.draw(0.5, picture);
    EXPECT_EQ(picture, Image(320, 180));
}

}  // namespace
}  // namespace carom
