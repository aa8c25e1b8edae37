// Pictures on transparent ground: what is there, what is not, and what viewers make of it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "hand_made_scene.h"
#include "render/blend/alpha_encoding.h"
#include "render/view/camera.h"

namespace carom {
namespace {

using testing::encoded_of;
using testing::HandMadeScene;
using testing::linear_of;

constexpr int kTransparentWidth = 320, kTransparentHeight = 180;

HandMadeScene ball_over_plane(Background background) {
    HandMadeScene made;
    made.camera({0, -4, 1.2}, {0, 0, 0.3});
    made.surface(PlaneShape{}, made.look(LookStyle::kPlain, {1, 1, 1}));
    made.ball({0, 0, 0.35}, 0.2, made.look(LookStyle::kPlain, {0.8, 0.3, 0.1}));
    made.scene.background = background;
    return made;
}

TEST(AlphaEncoding, IsWhatLightWouldShowOverWhiteAndBlack) {
    // Half of the light is taken away: over white e(0.5), not half of the encoded value.
    Image shadow(1, 1);
    shadow.bgra = {0, 0, 0, 128};
    encode_alpha(shadow);
    EXPECT_NEAR(255 - encoded_of(1 - 128 / 255.0), shadow.bgra[3], 1);
    // Half a pixel of grey.
    const double grey = 0.4, part = 0.5;
    Image edge(1, 1);
    edge.bgra = {encoded_of(part * grey), encoded_of(part * grey), encoded_of(part * grey),
                 static_cast<std::uint8_t>(std::lround(255 * part))};
    encode_alpha(edge);
    const int over_white = edge.bgra[0] + 255 - edge.bgra[3];
    EXPECT_NEAR(encoded_of(part * grey + 1 - part), over_white, 1);
    EXPECT_EQ(encoded_of(part * grey), edge.bgra[0]) << "over black";
}

TEST(Transparent, NothingButTheBallAndItsShadow) {
    const Image clear =
        ball_over_plane(Background::kTransparent).paint(kTransparentWidth, kTransparentHeight);
    const Image sky =
        ball_over_plane(Background::kSky).paint(kTransparentWidth, kTransparentHeight);
    int shadow = 0, ball = 0;
    for (int y = 0; y < kTransparentHeight; ++y) {
        for (int x = 0; x < kTransparentWidth; ++x) {
            const std::uint8_t* p = clear.row(y) + 4 * x;
            for (int c = 0; c < 3; ++c) ASSERT_LE(p[c], p[3]) << "not premultiplied";
            EXPECT_EQ(255, sky.row(y)[4 * x + 3]);
            if (p[3] > 10 && p[0] == 0 && p[1] == 0 && p[2] == 0) ++shadow;
            if (p[3] != 255) continue;
            ++ball;
            // Within rounding: at the ball's edge a little of what lies behind may count.
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(p[c], sky.row(y)[4 * x + c], 2);
        }
    }
    fmt::print("{} pixels of the ball, {} of its shadow\n", ball, shadow);
    EXPECT_GT(ball, 350);
    EXPECT_GT(shadow, 100);
    for (const int x : {0, kTransparentWidth - 1})
        for (const int y : {0, kTransparentHeight - 1}) EXPECT_EQ(0, clear.row(y)[4 * x + 3]);
}

// Laid over white as viewers do it, the shadow is as dark as it is on a white plane in light.
TEST(Transparent, TheShadowIsThatOfTheScene) {
    const Image clear =
        ball_over_plane(Background::kTransparent).paint(kTransparentWidth, kTransparentHeight);
    const Image sky =
        ball_over_plane(Background::kSky).paint(kTransparentWidth, kTransparentHeight);
    HandMadeScene gone = ball_over_plane(Background::kSky);
    gone.ball({0, 0, 0.35}, 0.2);
    gone.scene.balls.clear();
    gone.motion.balls.clear();
    gone.motion.ball_names.clear();
    const Image empty = gone.paint(kTransparentWidth, kTransparentHeight);
    double largest = 0;
    int compared = 0;
    for (int y = 0; y < kTransparentHeight; ++y) {
        for (int x = 0; x < kTransparentWidth; ++x) {
            const std::uint8_t* p = clear.row(y) + 4 * x;
            if (p[3] < 10 || p[0] + p[1] + p[2] > 0) continue;
            // What is left of the light: over white in the one, beside the empty floor in the
            // other.
            const double left = linear_of(static_cast<std::uint8_t>(255 - p[3]));
            const double truth =
                linear_of(sky.row(y)[4 * x + 1]) / linear_of(empty.row(y)[4 * x + 1]);
            largest = std::max(largest, std::abs(left - truth));
            ++compared;
        }
    }
    fmt::print("{} pixels of shadow, largest difference of the light left: {:.4f}\n", compared,
               largest);
    EXPECT_GT(compared, 100);
    EXPECT_LT(largest, 0.02);
}

TEST(Transparent, BodiesAreDrawnAndTheirShadowsCaught) {
    HandMadeScene made = ball_over_plane(Background::kTransparent);
    made.surface(BoxShape{{0.9, 0, 0.2}, {0.4, 0.4, 0.4}, Quat::Identity()});
    const Image picture = made.paint(kTransparentWidth, kTransparentHeight);
    const View view(*made.scene.camera, kTransparentWidth, kTransparentHeight);
    const View::Projected box = view.project({0.9, -0.2, 0.2});
    EXPECT_EQ(255, picture.row(static_cast<int>(box.y_px))[4 * static_cast<int>(box.x_px) + 3]);
    const View::Projected beside = view.project({1.2, 0.05, 0});
    const std::uint8_t* p =
        picture.row(static_cast<int>(beside.y_px)) + 4 * static_cast<int>(beside.x_px);
    EXPECT_GT(p[3], 20) << "the box's shadow";
    EXPECT_LT(p[3], 200);
}

TEST(Transparent, WithBlurAndOverlay) {
    HandMadeScene made = ball_over_plane(Background::kTransparent);
    made.motion.balls[0] = Trajectory();
    Piece piece;
    piece.position = {0, 0, 0.35};
    piece.velocity = {4, 0, 0};
    made.motion.balls[0].append(piece);
    made.scene.film.shutter_deg = 360;
    made.scene.overlay.clock = ClockOptions{};
    const Image picture = made.paint(kTransparentWidth, kTransparentHeight, 0.02);
    EXPECT_GT(picture.row(12)[4 * 20 + 3], 150) << "the clock's plate";
    int partly = 0;
    for (std::size_t i = 3; i < picture.bgra.size(); i += 4)
        partly += picture.bgra[i] > 60 && picture.bgra[i] < 200 ? 1 : 0;
    EXPECT_GT(partly, 300) << "the ball's blurred ends";
    for (std::size_t i = 0; i < picture.bgra.size(); ++i)
        ASSERT_LE(picture.bgra[i], picture.bgra[i / 4 * 4 + 3]);
}

}  // namespace
}  // namespace carom
