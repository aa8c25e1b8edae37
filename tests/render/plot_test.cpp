// The inset plot of height over time.
#include "render/plates/plot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

Sample plotted(Sample sample) {
    PlotOptions options;
    for (std::size_t i = 0; i < sample.scene.balls.size(); ++i)
        options.balls.push_back(static_cast<int>(i));
    sample.scene.overlay.plot = options;
    return sample;
}

TEST(Plot, CurvesAreExact) {
    const Sample sample = plotted(five_balls());
    PlotScale scale;
    scale.px_per_s = 70;
    scale.px_per_m = 110;
    scale.origin_px = Vec2(30, 200);
    double worst = 0;
    int corners = 0;
    for (std::size_t i = 0; i < sample.motion.balls.size(); ++i) {
        const double radius = sample.scene.balls[i].radius;
        PlotCurve curve(sample.motion.balls[i], radius, scale, sample.motion.duration);
        std::optional<TrailPoint> last;
        while (const auto corner = curve.next(sample.motion.duration)) {
            for (int k = 1; last && k < 8; ++k) {
                // The chord against the motion, at instants between the corners.
                const double share = k / 8.0;
                const double t = last->time + share * (corner->time - last->time);
                const double height = sample.motion.balls[i].at(t).position.z() - radius;
                const Vec2 chord = last->px + share * (corner->px - last->px);
                worst = std::max(worst, (chord - scale.px(t, height)).norm());
            }
            last = corner;
            ++corners;
        }
        ASSERT_TRUE(last);
        EXPECT_GT(last->time, 4);  // the last corner is where the ball comes to rest
    }
    fmt::print("{} corners, chords within {:.3f} px of the motion (bound 0.2)\n", corners, worst);
    EXPECT_GT(corners, 200);
    EXPECT_LT(worst, TrailCurve::kChordError + TrailCurve::kLeastStep);
}

// A hop of 0.9 s between 0 and 1 m, a million times: what is drawn follows from the plot's width.
TEST(Plot, HopsWithoutNumberAreTheRangeThatTheyCover) {
    constexpr int kHops = 1'000'000;
    constexpr double kRadius = 0.1, kHop_s = 0.9, kGravity = 9.81, kWidthPx = 300;
    Trajectory path;
    path.reserve(kHops);
    for (int i = 0; i < kHops; ++i) {
        Piece hop;
        hop.start = i * kHop_s;
        hop.position = Vec3(0, 0, kRadius);
        hop.velocity = Vec3(0, 0, 0.5 * kGravity * kHop_s);
        hop.acceleration = Vec3(0, 0, -kGravity);
        path.append(hop);
    }
    const double top = kGravity * kHop_s * kHop_s / 8;
    PlotScale scale;
    scale.px_per_s = kWidthPx / (kHops * kHop_s);
    scale.px_per_m = 100;
    PlotCurve curve(path, kRadius, scale, kHops * kHop_s);
    int corners = 0, halves = 0;
    double last_x = 0, lowest = HUGE_VAL, highest = -HUGE_VAL;
    // Asked for half of it first, it hands out half of it.
    for (const double limit : {0.5 * kHops * kHop_s, kHops * kHop_s}) {
        while (const auto corner = curve.next(limit)) {
            EXPECT_LE(corner->time, limit);
            EXPECT_GE(corner->px.x(), last_x);
            EXPECT_LT(corner->px.x() - last_x, 0.51);
            last_x = corner->px.x();
            lowest = std::min(lowest, -corner->px.y());
            highest = std::max(highest, -corner->px.y());
            ++corners;
        }
        if (halves == 0) halves = corners;
    }
    fmt::print("{} corners for {} hops (at most {})\n", corners, kHops, 4 * kWidthPx + 4);
    EXPECT_LE(corners, 4 * kWidthPx + 4);
    EXPECT_NEAR(halves, corners / 2, 4);
    EXPECT_NEAR(lowest, 0, 1e-6);
    EXPECT_NEAR(highest, top * scale.px_per_m, 1e-6);
    EXPECT_GT(last_x, kWidthPx - 1);
}

TEST(Plot, AxesHoldTheMotionAndEndAtLines) {
    Sample sample = plotted(drop(1.8, 0.12, 4));
    PlotAxes axes = choose_plot_axes(sample.scene, sample.motion, 6, 5);
    EXPECT_EQ(axes.low_m, 0);
    EXPECT_DOUBLE_EQ(axes.high_m, 2);
    EXPECT_DOUBLE_EQ(axes.step_m, 0.5);
    EXPECT_EQ(axes.step_s, 1);
    sample.scene.film.start = 3;  // what the film does not show has no place on the axes
    axes = choose_plot_axes(sample.scene, sample.motion, 6, 5);
    EXPECT_EQ(axes.first_s, 3);
    EXPECT_LT(axes.high_m, 1.2);
    Sample still = empty_floor(1);
    add_ball(still, "still", 0.1, {straight(0, Vec3(0, 0, 0.1), Vec3::Zero())});
    still = plotted(still);
    axes = choose_plot_axes(still.scene, still.motion, 6, 5);
    EXPECT_GT(axes.high_m, axes.low_m);
}

TEST(Plot, TheTopOfAThrowIsOnTheAxes) {
    // Thrown up from 1 m at 6 m/s: the top, between two ends of pieces, is at 2.835 m.
    Sample sample = empty_floor(1);
    Piece piece;
    piece.position = Vec3(0, 0, 1.1);
    piece.velocity = Vec3(0, 0, 6);
    piece.acceleration = Vec3(0, 0, -9.81);
    add_ball(sample, "thrown", 0.1, {piece});
    sample = plotted(sample);
    const PlotAxes axes = choose_plot_axes(sample.scene, sample.motion, 6, 5);
    EXPECT_DOUBLE_EQ(axes.high_m, 3);
}

TEST(Plot, StandsInItsCornerInsideAndClear) {
    for (const Size& size : kSizes)
        for (const Corner corner :
             {Corner::kTopLeft, Corner::kTopRight, Corner::kBottomLeft, Corner::kBottomRight}) {
            Sample sample = plotted(five_balls());
            sample.scene.overlay.plot->corner = corner;
            const bool top = corner == Corner::kTopLeft || corner == Corner::kTopRight;
            const bool left = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
            const int h = size.height / 12;
            const PixelRect taken =
                PixelRect::at(size.width / 10, top ? 0 : size.height - h, 8 * size.width / 10, h);
            const PlotElement plot(sample.scene, sample.motion, size.width, size.height, {taken},
                                   {});
            const PixelRect rect = plot.rect();
            EXPECT_TRUE(inside(rect, size));
            EXPECT_FALSE(rect.overlaps(taken)) << size.width << "x" << size.height;
            EXPECT_EQ(rect.middle_x() < 0.5 * size.width, left);
            EXPECT_EQ(rect.middle_y() < 0.5 * size.height, top);
        }
}

TEST(Plot, GrowsAndDependsOnTheInstantAlone) {
    const Sample sample = plotted(five_balls());
    const Size size{640, 360};
    const auto make = [&] {
        return PlotElement(sample.scene, sample.motion, size.width, size.height, {}, {});
    };
    const auto drawn = [&](PlotElement& plot, double t) {
        Image picture(size.width, size.height);
        plot.draw(t, picture);
        return picture;
    };
    PlotElement film = make(), once = make();
    for (double t = 0; t < 2; t += 1.0 / 30) drawn(film, t);
    const Image at_2 = drawn(film, 2);
    EXPECT_EQ(at_2, drawn(once, 2));
    const Image at_5 = drawn(film, 5);
    EXPECT_EQ(at_2, drawn(film, 2));  // back
    EXPECT_EQ(at_5, drawn(film, 5));
    // Right of the instant nothing is drawn but the plate: the same pixels as at the start.
    const Image at_0 = drawn(once, 0);
    const PixelRect rect = film.rect();
    const int now = rect.left + static_cast<int>(film.scale().px(2, 0).x()) + 6;
    int left_of_it = 0, right_of_it = 0;
    for (int y = rect.top; y < rect.bottom; ++y)
        for (int x = rect.left; x < rect.right; ++x) {
            const bool same =
                std::equal(at_0.row(y) + 4 * x, at_0.row(y) + 4 * x + 4, at_2.row(y) + 4 * x);
            left_of_it += x <= now && !same;
            right_of_it += x > now && !same;
        }
    EXPECT_GT(left_of_it, 300);
    EXPECT_EQ(right_of_it, 0);
}

}  // namespace
}  // namespace carom
