// Where the ruler stands, and how high it is.
#include "render/view/framing.h"

#include <gtest/gtest.h>

#include "render/draw2d/round_steps.h"
#include "sample_motions.h"

namespace carom {
namespace {

using samples::drop;
using samples::five_balls;
using samples::Sample;

RulerStaff staff_of(Sample sample, bool right = false) {
    if (!sample.scene.overlay.ruler) sample.scene.overlay.ruler = RulerOptions{};
    const MotionExtent extent(sample.scene, sample.motion);
    const auto staff = place_ruler(sample.scene, sample.motion, extent, Vec3::UnitX(), right);
    EXPECT_TRUE(staff);
    return staff.value_or(RulerStaff{});
}

TEST(RulerPlace, IsBesideAllBallsInTheOutermostOnesDepth) {
    const Sample sample = five_balls();
    double left = 1e9, right = -1e9;
    for (const Ball& ball : sample.scene.balls) {
        left = std::min(left, ball.position.x() - ball.radius);
        right = std::max(right, ball.position.x() + ball.radius);
    }
    const RulerStaff at_left = staff_of(sample), at_right = staff_of(sample, true);
    EXPECT_LT(at_left.foot.x(), left);
    EXPECT_GT(at_right.foot.x(), right);
    EXPECT_FALSE(at_left.right_of_motion);
    EXPECT_TRUE(at_right.right_of_motion);
    EXPECT_NEAR(sample.scene.balls.front().position.y(), at_left.foot.y(), 1e-12);
}

TEST(RulerPlace, EndsAtTheNextMark) {
    // The ball falls with its lowest point from `height`.
    const auto top = [](double height) { return staff_of(drop(height, 0.1, 3)).to_m; };
    EXPECT_NEAR(2.0, top(1.8), 1e-12);
    EXPECT_NEAR(2.0, top(2.0), 1e-12) << "a height on a mark needs no further one";
    EXPECT_NEAR(2.5, top(2.01), 1e-12);
    EXPECT_NEAR(5.0, top(4.2), 1e-12) << "whole metres above 3";
    EXPECT_NEAR(0.3, top(0.25), 1e-12);
    EXPECT_NEAR(15.0, top(12), 1e-12);
}

TEST(RulerPlace, TheScenesOwnPlaceAndEndsAreKept) {
    Sample sample = drop(2, 0.1, 3);
    sample.scene.overlay.ruler = RulerOptions{};
    sample.scene.overlay.ruler->at = Vec2(3, -2);
    sample.scene.overlay.ruler->from = 0.5;
    sample.scene.overlay.ruler->to = 7.25;
    const RulerStaff staff = staff_of(sample);
    EXPECT_EQ(Vec2(3, -2), staff.foot);
    EXPECT_EQ(0.5, staff.from_m);
    EXPECT_EQ(7.25, staff.to_m);
}

TEST(RoundSteps, AreOneTwoAndFiveTimesPowersOfTen) {
    EXPECT_NEAR(0.2, step_at_least(0.11), 1e-15);
    EXPECT_NEAR(0.5, step_at_least(0.5), 1e-15);
    EXPECT_NEAR(1.0, step_at_least(0.51), 1e-15);
    EXPECT_NEAR(2000, step_at_least(1001), 1e-9);
    EXPECT_NEAR(0.1, step_at_most(0.19), 1e-15);
    EXPECT_NEAR(0.5, step_at_most(0.99), 1e-15);
    EXPECT_NEAR(200, step_at_most(499), 1e-9);
}

}  // namespace
}  // namespace carom
