// The marked part of the ruler.
#include <gtest/gtest.h>

#include "render/marks/ruler.h"
#include "sample_motions.h"

namespace carom {
namespace {

const View kView(samples::pinhole(Vec3(0, -6, 1), Vec3(0, 0, 1), 30), 640, 360);

RulerLayout layout_with(const std::optional<std::array<double, 2>>& band) {
    RulerStaff staff{Vec2(-0.5, 0), 0, 2, false};
    staff.band = band;
    const auto layout = lay_out_ruler(staff, kView);
    EXPECT_TRUE(layout);
    return layout.value_or(RulerLayout{});
}

Image drawn(const std::optional<std::array<double, 2>>& band) {
    Image picture(kView.width_px(), kView.height_px());
    draw_ruler(layout_with(band), kView, Font(ruler_font_px(kView)), {}, picture);
    return picture;
}

TEST(RulerBand, LiesBetweenItsHeights) {
    const RulerLayout layout = layout_with({{0.5, 1.25}});
    ASSERT_TRUE(layout.band_px);
    for (const auto& [height, px] :
         {std::pair{0.5, (*layout.band_px)[0]}, std::pair{1.25, (*layout.band_px)[1]}}) {
        const View::Projected expected = kView.project(Vec3(-0.5, 0, height));
        EXPECT_NEAR(expected.x_px, px.x(), 1e-9);
        EXPECT_NEAR(expected.y_px, px.y(), 1e-9);
    }
    EXPECT_FALSE(layout_with(std::nullopt).band_px);
}

// Only the part on the staff that is seen; none where it is all beyond the end.
TEST(RulerBand, IsCutAtTheStaffsEnds) {
    const RulerLayout layout = layout_with({{1.5, 9}});
    ASSERT_TRUE(layout.band_px);
    EXPECT_NEAR(layout.high_px.y(), (*layout.band_px)[1].y(), 1e-9);
    EXPECT_FALSE(layout_with({{3, 4}}).band_px);
}

// Green between the two heights, towards the balls; nothing above and below.
TEST(RulerBand, IsDrawn) {
    const Image with = drawn({{0.5, 1.25}}), without = drawn(std::nullopt);
    const RulerLayout layout = layout_with({{0.5, 1.25}});
    const int top = static_cast<int>((*layout.band_px)[1].y());
    const int bottom = static_cast<int>((*layout.band_px)[0].y());
    const int x = static_cast<int>(layout.low_px.x()) + 20;
    ASSERT_LT(top + 10, bottom);
    for (int y = 0; y < kView.height_px(); ++y) {
        const int alpha = with.row(y)[4 * x + 3];
        if (y > top + 3 && y < bottom - 3) {
            EXPECT_GT(alpha, 40) << y;
            EXPECT_GT(int{with.row(y)[4 * x + 1]}, int{with.row(y)[4 * x + 2]}) << y;
        } else if (y < top - 3 || y > bottom + 3) {
            EXPECT_EQ(0, alpha) << y;
        }
        EXPECT_EQ(0, without.row(y)[4 * x + 3]);
    }
}

}  // namespace
}  // namespace carom
