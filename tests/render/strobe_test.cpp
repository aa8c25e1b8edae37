// Several instants in one picture: each ball where and as it is in its own frame.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "hand_made_scene.h"

namespace carom {
namespace {

using testing::HandMadeScene;

constexpr int kStrobeWidth = 320, kStrobeHeight = 180;
const Color kStrobeRed{0.8, 0.05, 0.05}, kStrobeBlue{0.05, 0.1, 0.8};

Image painted(Painter& painter, const std::vector<double>& instants) {
    Image image;
    painter.paint_strobe(instants, image);
    return image;
}

bool same_pixel(const Image& a, const Image& b, int x, int y) {
    return std::equal(a.row(y) + 4 * x, a.row(y) + 4 * x + 4, b.row(y) + 4 * x);
}

TEST(Strobe, OneInstantIsItsFrame) {
    HandMadeScene scene;
    scene.camera({0, -4, 0.5}, {0, 0, 0.5});
    scene.surface(PlaneShape{});
    scene.ball({-1, 0, 0.5}, 0.2, 0, {0, 3, 0}, {1, 0, 0});
    Painter painter(scene.scene, scene.motion, {kStrobeWidth, kStrobeHeight});
    Image frame;
    painter.paint(0.7, frame);
    EXPECT_EQ(frame, painted(painter, {0.7}));
}

// Without overlap every pixel is that of the background or of exactly one frame.
TEST(Strobe, InstantsApartAreTheirFramesSideBySide) {
    HandMadeScene scene;
    scene.camera({0, -4, 0}, {0, 0, 0});
    scene.ball({-1, 0, 0}, 0.2, scene.look(LookStyle::kStriped, kStrobeRed, kStrobeBlue), {0, 5, 2},
               {1, 0, 0});
    Painter painter(scene.scene, scene.motion, {kStrobeWidth, kStrobeHeight});
    const std::vector<double> instants = {0, 1, 2};
    const Image strobe = painted(painter, instants), empty = painted(painter, {10});
    std::vector<Image> frames;
    for (const double t : instants) frames.push_back(painted(painter, {t}));
    std::vector<int> seen(frames.size());
    int wrong = 0;
    for (int y = 0; y < kStrobeHeight; ++y) {
        for (int x = 0; x < kStrobeWidth; ++x) {
            const Image* expected = &empty;
            for (std::size_t k = 0; k < frames.size(); ++k) {
                if (same_pixel(frames[k], empty, x, y)) continue;
                expected = &frames[k];
                ++seen[k];
            }
            wrong += same_pixel(strobe, *expected, x, y) ? 0 : 1;
        }
    }
    for (const int pixels : seen) EXPECT_GT(pixels, 300);
    EXPECT_EQ(0, wrong);
}

/// The middle pixel of a ball that moves along the view axis at `velocity`, at two instants.
std::pair<Image, Image> along_the_view(double velocity, double nearer_instant) {
    HandMadeScene scene;
    scene.camera({0, -6, 0}, {0, 0, 0});
    scene.ball({0, -0.5 * velocity, 0}, 0.3,
               scene.look(LookStyle::kStriped, kStrobeRed, kStrobeBlue), {0, 2, 0},
               {0, velocity, 0});
    Painter painter(scene.scene, scene.motion, {kStrobeWidth, kStrobeHeight});
    return {painted(painter, {0, 1}), painted(painter, {nearer_instant})};
}

// What is nearer is in front, whether it came earlier or later.
TEST(Strobe, NearerInstantsAreInFront) {
    for (const double velocity : {-1.5, 1.5}) {
        const auto [strobe, nearer] = along_the_view(velocity, velocity > 0 ? 0 : 1);
        int compared = 0, wrong = 0;
        for (int y = kStrobeHeight / 2 - 10; y <= kStrobeHeight / 2 + 10; ++y) {
            for (int x = kStrobeWidth / 2 - 10; x <= kStrobeWidth / 2 + 10; ++x) {
                ++compared;
                wrong += same_pixel(strobe, nearer, x, y) ? 0 : 1;
            }
        }
        EXPECT_EQ(441, compared);
        EXPECT_EQ(0, wrong) << velocity;
    }
}

TEST(Strobe, AnotherBallInFrontStaysInFront) {
    HandMadeScene scene;
    scene.camera({0, -5, 0}, {0, 0, 0});
    scene.ball({0, -1, 0}, 0.3, scene.look(LookStyle::kPlain, kStrobeBlue));
    scene.ball({-1, 1, 0}, 0.3, scene.look(LookStyle::kPlain, kStrobeRed), {0, 0, 0}, {1, 0, 0});
    Painter painter(scene.scene, scene.motion, {kStrobeWidth, kStrobeHeight});
    const Image strobe = painted(painter, {0, 0.5, 1, 1.5, 2});
    const std::uint8_t* middle = strobe.row(kStrobeHeight / 2) + 4 * (kStrobeWidth / 2);
    EXPECT_GT(int{middle[0]}, int{middle[2]} + 40) << "not blue";
    EXPECT_NE(strobe, painted(painter, {2}));
}

// Every instant throws its shadow on the floor; a ball at rest is drawn once, however long.
TEST(Strobe, ShadowsAreThereOncePerPlace) {
    HandMadeScene scene;
    scene.camera({0, -5, 2}, {0, 0, 0.3});
    scene.surface(PlaneShape{}, scene.look(LookStyle::kPlain, {0.9, 0.9, 0.9}));
    scene.ball({-1.5, 0, 0.6}, 0.2, 0, {0, 0, 0}, {1, 0, 0});
    Painter painter(scene.scene, scene.motion, {kStrobeWidth, kStrobeHeight});
    const auto light = [](const Image& image) {
        double sum = 0;
        for (std::size_t i = 0; i < image.bgra.size(); i += 4) sum += image.bgra[i + 1];
        return sum;
    };
    const double empty = light(painted(painter, {10}));  // the ball has left the picture
    double singly = 0;
    for (const double t : {0.5, 1.5, 2.5}) singly += empty - light(painted(painter, {t}));
    const double together = empty - light(painted(painter, {0.5, 1.5, 2.5}));
    fmt::print("darkening of three instants: {:.0f}, one by one {:.0f}\n", together, singly);
    EXPECT_NEAR(1, together / singly, 0.02);

    HandMadeScene still;
    still.camera({0, -5, 2}, {0, 0, 0.3});
    still.surface(PlaneShape{});
    still.ball({0, 0, 0.2}, 0.2);
    Painter resting(still.scene, still.motion, {kStrobeWidth, kStrobeHeight});
    EXPECT_EQ(painted(resting, {3}), painted(resting, {0, 1, 2, 3}));
}

}  // namespace
}  // namespace carom
