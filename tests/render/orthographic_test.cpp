// Parallel rays: a metre is as many pixels everywhere, in the numbers and in the picture.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hand_made_scene.h"
#include "render/balls/balls_in_view.h"

namespace carom {
namespace {

using testing::HandMadeScene;

constexpr int kOrthoWidth = 640, kOrthoHeight = 360;
constexpr double kHigh_m = 1.8;  // of the picture
constexpr double kMetre_px = kOrthoHeight / kHigh_m;

HandMadeScene side_view() {
    HandMadeScene scene;
    scene.camera({0.1, -7, 0.8}, {0.1, 0, 0.8});
    scene.scene.camera->orthographic_m = kHigh_m;
    return scene;
}

struct Disc {
    double x_px = 0, y_px = 0, radius_px = 0;
    int pixels = 0;
};

/// The disc of a ball of pure red or blue: middle of all pixels in which that colour leads.
Disc measure(const Image& image, int channel) {
    Disc disc;
    double area = 0;
    for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
            const std::uint8_t* p = image.row(y) + 4 * x;
            const int other = channel == 2 ? 0 : 2;
            if (p[channel] < p[other] + 40) continue;
            disc.x_px += x + 0.5;
            disc.y_px += y + 0.5;
            ++area;
            ++disc.pixels;
        }
    }
    disc.x_px /= area;
    disc.y_px /= area;
    disc.radius_px = std::sqrt(area / M_PI);
    return disc;
}

TEST(Orthographic, ProjectsMetresToPixelsAtAnyDepth) {
    const HandMadeScene scene = side_view();
    const View view(*scene.scene.camera, kOrthoWidth, kOrthoHeight);
    ASSERT_TRUE(view.orthographic());
    for (const double depth : {0.5, 7.0, 400.0}) {
        EXPECT_DOUBLE_EQ(view.pixels_per_metre(depth), kMetre_px);
        const auto p = view.project(Vec3(0.6, -7 + depth, 1.3));
        EXPECT_NEAR(p.x_px, 0.5 * kOrthoWidth + 0.5 * kMetre_px, 1e-9);
        EXPECT_NEAR(p.y_px, 0.5 * kOrthoHeight - 0.5 * kMetre_px, 1e-9);
        EXPECT_NEAR(p.depth_m, depth, 1e-9);
    }
}

TEST(Orthographic, PlacesAreReadOffThePictureToHalfAPixel) {
    HandMadeScene scene = side_view();
    const Vec3 near(-0.63, -3, 1.137), far(0.71, 30, 0.412);
    const double r_near = 0.1, r_far = 0.23;
    scene.ball(near, r_near, scene.look(LookStyle::kPlain, {0.8, 0.02, 0.02}));
    scene.ball(far, r_far, scene.look(LookStyle::kPlain, {0.02, 0.02, 0.8}));
    const Image image = scene.paint(kOrthoWidth, kOrthoHeight);
    const auto check = [&](const Vec3& center, double radius, int channel) {
        const Disc disc = measure(image, channel);
        ASSERT_GT(disc.pixels, 500);
        const double x_m = 0.1 + (disc.x_px - 0.5 * kOrthoWidth) / kMetre_px;
        const double z_m = 0.8 - (disc.y_px - 0.5 * kOrthoHeight) / kMetre_px;
        const double off_px = std::hypot(x_m - center.x(), z_m - center.z()) * kMetre_px;
        const double radius_off_px = std::abs(disc.radius_px - radius * kMetre_px);
        fmt::print("read {:.4f} {:.4f} m, off {:.3f} px, radius off {:.3f} px (at most 0.5)\n", x_m,
                   z_m, off_px, radius_off_px);
        EXPECT_LT(off_px, 0.5);
        EXPECT_LT(radius_off_px, 0.5);
    };
    check(near, r_near, 2);
    check(far, r_far, 0);
}

TEST(Orthographic, TheGroundEndsAtItsHeight) {
    HandMadeScene scene = side_view();
    scene.surface(PlaneShape{}, scene.look(LookStyle::kPlain, {0.3, 0.3, 0.3}));
    const Image image = scene.paint(kOrthoWidth, kOrthoHeight);
    // The floor at z = 0 lies 0.8 m below the middle: at 340 px, between two rows.
    const double floor_px = 0.5 * kOrthoHeight + 0.8 * kMetre_px;
    ASSERT_NEAR(floor_px, 340, 1e-9);
    const int above = image.row(338)[4 * 100], below = image.row(341)[4 * 100];
    fmt::print("above the floor {}, below {}\n", above, below);
    EXPECT_GT(above, below + 50);
    EXPECT_EQ(image.row(10)[4 * 100], above) << "nothing but sky above";
    EXPECT_EQ(image.row(358)[4 * 500], below);
}

TEST(Orthographic, BodiesHideWhatIsBehindThem) {
    HandMadeScene scene = side_view();
    scene.scene.camera->from = Vec3(0.1, -7, 4.8);  // slanted: the floor is seen
    scene.surface(PlaneShape{}, scene.look(LookStyle::kPlain, {0.9, 0.9, 0.9}));
    BoxShape box;
    box.center = Vec3(0, 1, 0.3);
    box.size = Vec3(0.4, 0.4, 0.6);
    scene.surface(box, scene.look(LookStyle::kPlain, {0.3, 0.3, 0.3}));
    const Image without = scene.paint(kOrthoWidth, kOrthoHeight);
    const View view(*scene.scene.camera, kOrthoWidth, kOrthoHeight);
    const int red = scene.look(LookStyle::kPlain, {0.8, 0.02, 0.02});
    const auto red_at = [&](const Vec3& center) {
        HandMadeScene one = scene;
        one.ball(center, 0.1, red);
        return measure(one.paint(kOrthoWidth, kOrthoHeight), 2).pixels;
    };
    const double disc = M_PI * std::pow(0.1 * kMetre_px, 2);
    const int before = red_at(box.center - 2 * view.forward());
    const int behind = red_at(box.center + 0.6 * view.forward() + Vec3(0, 0, 0.0));
    fmt::print("red pixels: before {}, behind {}, disc {:.0f}\n", before, behind, disc);
    EXPECT_NEAR(before, disc, 0.1 * disc);
    EXPECT_EQ(behind, 0);
    EXPECT_GT(without.row(350)[0], 100) << "the floor fills the picture";
}

TEST(Orthographic, OrderGoesByDepthAlone) {
    HandMadeScene scene = side_view();
    scene.ball({0.9, 0, 0.8}, 0.02);
    scene.ball({0.1, 0.3, 0.8}, 0.25);
    const View view(*scene.scene.camera, kOrthoWidth, kOrthoHeight);
    const auto balls = balls_at(0, scene.scene, scene.motion, view);
    ASSERT_EQ(balls.size(), 2U);
    EXPECT_EQ(balls.front().index, 1) << "the farther centre is drawn first";
    EXPECT_TRUE(may_be_seen(balls[0], view));
    EXPECT_FALSE(may_be_seen({Vec3(0, 0, -1), 0.1, Mat3::Identity(), 0, 0, 0}, view));
}

}  // namespace
}  // namespace carom
