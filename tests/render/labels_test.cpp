// Names of the balls: no overlap, no jumps.
#include "render/marks/labels.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/draw2d/font.h"
#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

TEST(Labels, UnderscoresAreSpaces) { EXPECT_EQ(label_text("table_tennis"), "table tennis"); }

TEST(Labels, NeverOverlapAndStayInThePicture) {
    for (const double spacing : {0.45, 0.25, 0.24}) {
        Sample sample = five_balls(spacing);
        sample.scene.overlay.labels = LabelOptions{};
        for (const Size& size : kSizes) {
            const LabelsElement labels(sample.scene, sample.motion, view_of(sample, size));
            const PixelRect clock = PixelRect::at(10, 10, size.width / 10, size.height / 20);
            int shown = 0, frames = 0;
            for (double t = 0; t < sample.motion.duration; t += 1.0 / 60, ++frames) {
                std::vector<PixelRect> rects{clock};
                for (const auto& place : labels.place(t, {clock})) {
                    if (!place) continue;
                    ++shown;
                    EXPECT_TRUE(inside(place->rect, size));
                    for (const PixelRect& other : rects) EXPECT_FALSE(place->rect.overlaps(other));
                    rects.push_back(place->rect);
                }
            }
            fmt::print("spacing {} m, {}x{}: {:.2f} labels a frame\n", spacing, size.width,
                       size.height, double(shown) / frames);
            EXPECT_EQ(shown, 5 * frames);
        }
    }
}

TEST(Labels, MoveWithTheirBallsAndDoNotJump) {
    Sample sample = five_balls();
    sample.scene.overlay.labels = LabelOptions{};
    const View view = view_of(sample, {1280, 720});
    const LabelsElement labels(sample.scene, sample.motion, view);
    double worst = 0;
    for (std::size_t b = 0; b < 5; ++b) {
        Vec2 before(0, 0);
        for (int k = 0; k < 360; ++k) {
            const auto place = labels.place(k / 60.0, {})[b];
            ASSERT_TRUE(place);
            const auto ball = view.project(sample.motion.balls[b].at(k / 60.0).position);
            const Vec2 offset(place->rect.middle_x() - ball.x_px, place->rect.top - ball.y_px);
            if (k > 0) worst = std::max(worst, (offset - before).norm());
            before = offset;
        }
    }
    // Names of up to 95 px over balls that come as near as 41 px to each other, while they pass at
    // up to 40 px a frame.
    fmt::print("a label moves against its ball by at most {:.2f} px a frame (bound 8)\n", worst);
    EXPECT_LT(worst, 8);
}

TEST(Labels, PartGraduallyWhereBallsMeet) {
    Sample sample = meeting();
    sample.scene.overlay.labels = LabelOptions{};
    const View view = view_of(sample, {1280, 720});
    const LabelsElement labels(sample.scene, sample.motion, view);
    double worst = 0;
    std::vector<PixelRect> before;
    for (int k = 0; k < 240; ++k) {
        std::vector<PixelRect> now;
        for (const auto& place : labels.place(k / 60.0, {})) {
            ASSERT_TRUE(place);
            now.push_back(place->rect);
        }
        for (std::size_t i = 0; i < before.size(); ++i) {
            worst = std::max(worst, double(std::abs(now[i].left - before[i].left)));
            EXPECT_EQ(now[i].top, before[i].top);
        }
        before = now;
    }
    // Each to its own side of the place where the balls rest.
    const double middle = view.project(Vec3(0, 0, 0.05)).x_px;
    fmt::print("at most {} px a frame (bound 6); at the end {} | {:.1f} | {}\n", worst,
               before[0].right, middle, before[1].left);
    EXPECT_LT(worst, 6);
    EXPECT_LE(before[0].right, before[1].left);
    EXPECT_NEAR(before[0].right, middle, 3);
}

TEST(Labels, OfCrossingHeightsSpreadBeforeTheyMeet) {
    // Labels 80 px wide over balls 50 px apart need 81 px, half on each side.
    std::vector<LabelWish> wishes = {{true, 100, 50, 80, 20}, {true, 150, 90, 80, 20}};
    Eigen::MatrixXd close = Eigen::MatrixXd::Zero(2, 2);
    spread_labels(wishes, close);
    EXPECT_EQ(wishes[0].center_x, 100);
    close(0, 1) = 1;
    spread_labels(wishes, close);
    EXPECT_GE(wishes[1].center_x - wishes[0].center_x, 81);
    EXPECT_NEAR(wishes[1].center_x + wishes[0].center_x, 250, 1e-9);
}

TEST(Labels, WithoutRoomAreLeftOut) {
    const std::vector<LabelWish> crowd(50, LabelWish{true, 50, 40, 60, 20});
    const auto places = place_labels(crowd, 100, 100, {});
    const auto shown =
        std::count_if(places.begin(), places.end(), [](auto& p) { return p.has_value(); });
    EXPECT_GE(shown, 3);
    EXPECT_LE(shown, 5);
    EXPECT_FALSE(place_labels({LabelWish{false, 50, 40, 60, 20}}, 100, 100, {})[0]);
}

}  // namespace
}  // namespace carom
