// Ruler, clock and fonts.
#include "render/overlay/overlay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/draw2d/font.h"
#include "render/marks/ruler.h"
#include "render/plates/clock.h"
#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

// ---- Nothing, and fonts ------------------------------------------------------------------------

TEST(Overlay, DrawsNothingWhenNothingIsAsked) {
    const Sample sample = five_balls();
    OverlayPainter overlay(sample.scene, sample.motion, view_of(sample, {320, 180}));
    EXPECT_EQ(overlay.background_layer().width_px, 0);
    EXPECT_FALSE(overlay.has_moving_layer());
    EXPECT_TRUE(overlay.update_moving_layer(1).empty());
    EXPECT_EQ(overlay.moving_layer().width_px, 0);
    Image picture(320, 180);
    std::fill(picture.bgra.begin(), picture.bgra.end(), std::uint8_t{137});
    const Image before = picture;
    overlay.draw_over(1, picture);
    EXPECT_EQ(picture, before);
}

TEST(Overlay, DrawsWhatIsAsked) {
    Sample sample = five_balls();
    sample.scene.overlay = {RulerOptions{}, ClockOptions{}, TrailOptions{}, LabelOptions{}};
    OverlayPainter overlay(sample.scene, sample.motion, view_of(sample, {640, 360}));
    const auto drawn = [](const Image& picture) {
        return std::count_if(picture.bgra.begin(), picture.bgra.end(), [](int v) { return v > 0; });
    };
    EXPECT_GT(drawn(overlay.background_layer()), 1000);
    EXPECT_FALSE(overlay.update_moving_layer(1).empty());
    EXPECT_GT(drawn(overlay.moving_layer()), 1000);
    Image picture(640, 360);
    overlay.draw_over(1, picture);
    EXPECT_GT(drawn(picture), 5000);
}

TEST(Font, EveryDigitIsEquallyWide) {
    const Font font(17);
    const double width = font.lay_out("0000").width_px;
    EXPECT_GT(width, 17);
    for (const char* number : {"1111", "4444", "1789", "2305"})
        EXPECT_DOUBLE_EQ(font.lay_out(number).width_px, width) << number;
    EXPECT_LT(font.lay_out("iiii").width_px, font.lay_out("mmmm").width_px);
}

// ---- The ruler ---------------------------------------------------------------------------------

// Above the staff; where the picture ends too soon for that, behind the top number, and not cut
// off.
TEST(Ruler, UnitIsNeverCutOff) {
    const Sample sample = five_balls();
    const View view = view_of(sample, {320, 180});
    const Font font(ruler_font_px(view));
    const auto drawn = [&](double top_px) {
        RulerLayout layout;
        layout.low_px = {100, 170};
        layout.high_px = {100, top_px};
        layout.ticks = {{0, layout.low_px, TickRank::kMajor, "0"},
                        {3, layout.high_px, TickRank::kMajor, "3"}};
        Image picture(320, 180);
        draw_ruler(layout, view, font, {}, picture);
        return picture;
    };
    const auto inked = [](const Image& picture, int x0, int x1, int y0, int y1) {
        int count = 0;
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) count += picture.row(y)[4 * x + 3] > 0 ? 1 : 0;
        return count;
    };
    const Image roomy = drawn(60), tight = drawn(9);
    EXPECT_GT(inked(roomy, 85, 115, 30, 57), 20) << "the unit above the staff";
    EXPECT_EQ(0, inked(roomy, 60, 76, 50, 70)) << "only the number beside it";
    EXPECT_EQ(0, inked(tight, 92, 115, 0, 7)) << "nothing above the staff";
    EXPECT_GT(inked(tight, 60, 76, 0, 20), 10) << "number and unit beside it";
}

TEST(Ruler, ReadsTheGapUnderABall) {
    // The ball's lowest point at a gap of h stands level with the mark of h, at every height.
    Sample sample = drop(1.8, 0.12, 4);
    sample.scene.overlay.ruler = RulerOptions{};
    for (const bool own : {false, true}) {
        if (own) sample.scene.camera = samples::pinhole(Vec3(0.5, -6, 1.5), Vec3(0.5, 0, 1.5), 40);
        const View view = view_of(sample, {1280, 720});
        const auto staff = stand_ruler(sample.scene, sample.motion, view);
        ASSERT_TRUE(staff);
        EXPECT_DOUBLE_EQ(staff->from_m, 0);
        EXPECT_DOUBLE_EQ(staff->to_m, 2);
        double worst = 0;
        for (int k = 0; k <= 200; ++k) {
            const Vec3 center = sample.motion.balls[0].at(0.02 * k).position;
            const double gap = center.z() - 0.12;
            const auto bottom = view.project(center - Vec3(0, 0, 0.12));
            const auto mark = view.project(Vec3(staff->foot.x(), staff->foot.y(), gap));
            worst = std::max(worst, std::abs(bottom.y_px - mark.y_px));
            EXPECT_LT(mark.x_px + 10, bottom.x_px);
        }
        fmt::print("{}: worst offset {:.2e} px (bound 1e-9)\n", own ? "level" : "framed", worst);
        EXPECT_LT(worst, 1e-9);
    }
}

TEST(Ruler, TicksStandWhereTheirHeightsProjectTo) {
    Sample sample = five_balls();
    sample.scene.overlay.ruler = RulerOptions{};
    for (const Size& size : kSizes) {
        const View view = view_of(sample, size);
        const auto staff = stand_ruler(sample.scene, sample.motion, view);
        ASSERT_TRUE(staff);
        const auto layout = lay_out_ruler(*staff, view);
        ASSERT_TRUE(layout);
        int numbers = 0;
        double last_number_y = 1e9;
        for (const RulerTick& tick : layout->ticks) {
            const auto p = view.project(Vec3(staff->foot.x(), staff->foot.y(), tick.height_m));
            EXPECT_NEAR(tick.px.x(), p.x_px, 1e-9);
            EXPECT_NEAR(tick.px.y(), p.y_px, 1e-9);
            EXPECT_EQ(tick.label.empty(), tick.rank != TickRank::kMajor);
            if (tick.label.empty()) continue;
            ++numbers;
            EXPECT_NEAR(std::stod(tick.label), tick.height_m, 1e-9);
            EXPECT_GT(last_number_y - tick.px.y(), 2 * ruler_font_px(view));
            last_number_y = tick.px.y();
        }
        fmt::print("{}x{}: a number every {} m, {} numbers, {} ticks\n", size.width, size.height,
                   layout->major_step_m, numbers, layout->ticks.size());
        EXPECT_GE(numbers, 3);
        EXPECT_DOUBLE_EQ(layout->ticks.front().height_m, 0);
        EXPECT_NEAR(layout->ticks.back().height_m, 2, 1e-12);
    }
}

TEST(Ruler, IsLeftOutWhereItsMarksCannotBeToldApart) {
    for (const double height : {1e3, 1e6, 1e9, 1e12, 1e15, 1e17, 1e100}) {
        Sample sample = empty_floor(1);
        sample.scene.overlay.ruler = RulerOptions{};
        add_ball(sample, "ball", 0.1, {straight(0, Vec3(0, 0, height), Vec3::Zero())});
        const View view = view_of(sample, {1280, 720});
        const auto staff = stand_ruler(sample.scene, sample.motion, view);
        ASSERT_TRUE(staff);
        const auto layout = lay_out_ruler(*staff, view);
        fmt::print("ball at {} m: {} marks\n", height, layout ? layout->ticks.size() : 0);
        EXPECT_TRUE(layout || height > 1e6);
        EXPECT_LT(layout ? layout->ticks.size() : 0, 300u);
    }
}

TEST(Ruler, LiesInsideTheFramedPicture) {
    Sample sample = five_balls();
    sample.scene.overlay.ruler = RulerOptions{};
    for (const Size& size : kSizes) {
        const OverlayPainter overlay(sample.scene, sample.motion, view_of(sample, size));
        const Image picture = overlay.background_layer();
        ASSERT_EQ(picture.width_px, size.width);
        int least_x = size.width, least_y = size.height, most_y = 0;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                if (alpha_at(picture, x, y) == 0) continue;
                least_x = std::min(least_x, x);
                least_y = std::min(least_y, y);
                most_y = std::max(most_y, y);
            }
        }
        fmt::print("{}x{}: free at the left {}, top {}, bottom {}\n", size.width, size.height,
                   least_x, least_y, size.height - 1 - most_y);
        EXPECT_GE(least_x, 2);
        EXPECT_GE(least_y, 2);
        EXPECT_LT(most_y, size.height - 2);
    }
}

TEST(Ruler, EndsAtTheNextMarkAboveTheHighestGap) {
    const std::pair<double, double> cases[] = {{1.8, 2},       {2.0, 2},     {2.01, 2.5},
                                               {0.7, 1},       {3.2, 4},     {9.5, 10},
                                               {10000, 10000}, {0.02, 0.02}, {0.013, 0.015}};
    for (const auto& [gap, top] : cases) {
        Sample sample = drop(gap, 0.01 * gap, 1);
        sample.scene.overlay.ruler = RulerOptions{};
        const MotionExtent extent(sample.scene, sample.motion);
        const auto staff = place_ruler(sample.scene, sample.motion, extent, Vec3::UnitX());
        ASSERT_TRUE(staff);
        EXPECT_NEAR(staff->to_m, top, 1e-9 * top) << "gap " << gap;
    }
}

TEST(Ruler, StandsWhereTheSceneSays) {
    Sample sample = drop(1.8, 0.12, 4);
    sample.scene.overlay.ruler = RulerOptions{Vec2(-0.7, 0.2), 0.5, 1.75, {}};
    const View view = view_of(sample, {1280, 720});
    const auto staff = stand_ruler(sample.scene, sample.motion, view);
    ASSERT_TRUE(staff);
    EXPECT_EQ(staff->foot, Vec2(-0.7, 0.2));
    const auto layout = lay_out_ruler(*staff, view);
    ASSERT_TRUE(layout);
    EXPECT_NEAR(layout->ticks.front().height_m, 0.5, 1e-12);
    EXPECT_NEAR(layout->ticks.back().height_m, 1.75, layout->major_step_m);
}

TEST(Ruler, ChangesSideWhereTheCameraHasNoRoom) {
    Sample sample = drop(1.8, 0.12, 4);
    sample.scene.overlay.ruler = RulerOptions{};
    // The ball stands at the left edge of this picture.
    sample.scene.camera = samples::pinhole(Vec3(2.2, -6, 1), Vec3(2.2, 0, 1), 26);
    const View view = view_of(sample, {1280, 720});
    const auto staff = stand_ruler(sample.scene, sample.motion, view);
    ASSERT_TRUE(staff);
    EXPECT_TRUE(staff->right_of_motion);
    EXPECT_GT(staff->foot.x(), 0.12);
}

TEST(Ruler, AnEndlessStaffHasAsManyTicksAsThePictureHolds) {
    Sample sample = drop(1.8, 0.12, 4);
    const View view = view_of(sample, {1280, 720});
    const auto layout = lay_out_ruler(RulerStaff{Vec2(-0.5, 0), -1e7, 1e7, false}, view);
    ASSERT_TRUE(layout);
    fmt::print("{} ticks (at most 300)\n", layout->ticks.size());
    EXPECT_GT(layout->ticks.size(), 20u);
    EXPECT_LT(layout->ticks.size(), 300u);
    // Behind the eye there is nothing to draw.
    const Vec3 behind = view.eye() - 3 * view.forward();
    EXPECT_FALSE(lay_out_ruler(RulerStaff{behind.head<2>(), 0, 2, false}, view));
}

// ---- The clock ---------------------------------------------------------------------------------

TEST(Clock, TextHasTheDigitsAskedFor) {
    ClockElement clock(ClockOptions{Corner::kTopLeft, 2}, 12.5, 1280, 720);
    EXPECT_EQ(clock.text(0), "0.00");
    EXPECT_EQ(clock.text(1.25), "1.25");
    EXPECT_EQ(clock.text(12.5), "12.50");
    EXPECT_EQ(clock.text(-1e-17), "0.00");
    const ClockElement whole(ClockOptions{Corner::kTopLeft, 0}, 9, 1280, 720);
    EXPECT_EQ(whole.text(3.2), "3");
}

/// Columns that the clock covers at t.
std::pair<int, int> covered(ClockElement& clock, double t) {
    Image picture(1280, 720);
    clock.draw(t, picture);
    int least = 1280, most = -1;
    for (int x = 0; x < 1280; ++x)
        for (int y = 0; y < 720; ++y)
            if (alpha_at(picture, x, y) > 0) least = std::min(least, x), most = std::max(most, x);
    return {least, most};
}

TEST(Clock, WidthChangesOnlyWithTheNumberOfDigits) {
    for (const Corner corner : {Corner::kTopLeft, Corner::kTopRight}) {
        ClockElement clock(ClockOptions{corner, 2}, 10, 1280, 720);
        const auto first = covered(clock, 0);
        for (const double t : {1.11, 4.44, 9.99}) EXPECT_EQ(covered(clock, t), first);
        const auto [least, most] = covered(clock, 10);
        fmt::print("columns {} to {}, at 10 s {} to {}\n", first.first, first.second, least, most);
        EXPECT_GT(most - least, first.second - first.first + 5);
        EXPECT_EQ(clock.rect().left, least);
        EXPECT_EQ(clock.rect().width(), most - least + 1);
    }
}

TEST(Clock, OnlyTheDigitThatChangesChangesPixels) {
    ClockElement clock(ClockOptions{}, 4, 1280, 720);
    Image before(1280, 720), after(1280, 720);
    clock.draw(1.21, before);
    clock.draw(1.27, after);
    int least = 1280, most = 0;
    for (int y = 0; y < 720; ++y)
        for (int x = 0; x < 1280; ++x)
            if (!std::equal(before.row(y) + 4 * x, before.row(y) + 4 * x + 4,
                            after.row(y) + 4 * x)) {
                least = std::min(least, x);
                most = std::max(most, x);
            }
    fmt::print("pixels differ from x = {} to {}\n", least, most);
    ASSERT_LE(least, most);
    EXPECT_LT(most - least, 17);  // one letter
}

TEST(Clock, StandsInItsCorner) {
    for (const Size& size : kSizes) {
        for (const Corner corner :
             {Corner::kTopLeft, Corner::kTopRight, Corner::kBottomLeft, Corner::kBottomRight}) {
            ClockElement clock(ClockOptions{corner, 3}, 4, size.width, size.height);
            const PixelRect r = clock.rect();
            EXPECT_TRUE(inside(r, size));
            const bool left = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
            const bool top = corner == Corner::kTopLeft || corner == Corner::kTopRight;
            EXPECT_EQ(r.left + r.width() / 2 < size.width / 2, left);
            EXPECT_EQ(r.top + r.height() / 2 < size.height / 2, top);
        }
    }
}

}  // namespace
}  // namespace carom
