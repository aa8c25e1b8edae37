// The patterns of surfaces and their mirror images, near and far, against 64 samples a pixel.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "edge_quality.h"

namespace carom {
namespace {

using testing::HandMadeScene;

constexpr int kQualityWidth = 200, kQualityHeight = 112;

struct Pattern {
    const char* name;
    LookStyle style;
    Color color, second;
    double tile_m;
};

void PrintTo(const Pattern& pattern, std::ostream* out) { *out << pattern.name; }

constexpr Pattern kPatterns[] = {
    {"checker", LookStyle::kChecker, {0.92, 0.91, 0.88}, {0.84, 0.82, 0.78}, 0.5},
    {"grid", LookStyle::kGrid, {0.92, 0.91, 0.88}, {0.70, 0.69, 0.65}, 0.5},
    {"wood", LookStyle::kWood, {0.76, 0.60, 0.42}, {0.54, 0.39, 0.25}, 0.12},
    {"court", LookStyle::kCourt, {0.85, 0.70, 0.49}, {0.97, 0.96, 0.94}, 0.07},
};

int look_of(HandMadeScene& scene, const Pattern& pattern) {
    const int look = scene.look(pattern.style, pattern.color, pattern.second);
    scene.scene.looks.back().tile_m = pattern.tile_m;
    return look;
}

std::string pattern_name(const ::testing::TestParamInfo<Pattern>& test) { return test.param.name; }

class SurfaceQuality : public ::testing::TestWithParam<Pattern> {};

TEST_P(SurfaceQuality, FloorMatchesSixtyFourSamplesFromNearToTheHorizon) {
    HandMadeScene scene;
    scene.camera({0.4, -3, 0.9}, {0.1, 2, 0.2}, 40);
    scene.surface(PlaneShape{}, look_of(scene, GetParam()));
    const Image image = scene.paint(kQualityWidth, kQualityHeight);
    const Image plain = [] {
        HandMadeScene other;
        other.camera({0.4, -3, 0.9}, {0.1, 2, 0.2}, 40);
        other.surface(PlaneShape{});
        return other.paint(kQualityWidth, kQualityHeight);
    }();
    ASSERT_GT(compare_images(image, plain).differing_fraction(), 0.3);
    testing::expect_good(
        testing::edge_errors(image, testing::reference_of(scene, kQualityWidth, kQualityHeight)),
        GetParam().name);
}

TEST_P(SurfaceQuality, BoxMatchesSixtyFourSamples) {
    HandMadeScene scene;
    scene.camera({0.6, -3, 1.3}, {0, 0, 0.2}, 32);
    scene.surface(PlaneShape{}, scene.look(LookStyle::kPlain, {0.8, 0.8, 0.8}));
    const Quat turned(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
    scene.surface(BoxShape{{0, 0.2, 0.25}, {1.2, 0.8, 0.5}, turned}, look_of(scene, GetParam()));
    testing::expect_good(
        testing::edge_errors(scene.paint(kQualityWidth, kQualityHeight),
                             testing::reference_of(scene, kQualityWidth, kQualityHeight)),
        GetParam().name);
}

// Seen flatly, so that most of the light is mirrored: edges and patterns of the image are as good
// as those of the box.
TEST_P(SurfaceQuality, MirroredBoxMatchesSixtyFourSamples) {
    HandMadeScene scene;
    scene.camera({0.3, -3, 0.32}, {0, 0, 0.1}, 30);
    const int floor = scene.look(LookStyle::kPlain, {0.05, 0.05, 0.06});
    scene.scene.looks.back().reflection = 1;
    scene.surface(PlaneShape{}, floor);
    const Quat turned(Eigen::AngleAxisd(0.5, Vec3(0.2, 0, 1).normalized()));
    scene.surface(BoxShape{{0, 0.2, 0.5}, {1.0, 0.7, 0.4}, turned}, look_of(scene, GetParam()));
    testing::expect_good(
        testing::edge_errors(scene.paint(kQualityWidth, kQualityHeight),
                             testing::reference_of(scene, kQualityWidth, kQualityHeight)),
        std::string("mirrored ") + GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(Patterns, SurfaceQuality, ::testing::ValuesIn(kPatterns), pattern_name);

HandMadeScene polished_floor(double reflection) {
    HandMadeScene scene;
    scene.camera({0.3, -3, 0.7}, {0, 0, 0.25}, 34);
    const int floor = scene.look(LookStyle::kPlain, {0.25, 0.27, 0.3});
    scene.scene.looks.back().reflection = reflection;
    scene.surface(PlaneShape{}, floor);
    scene.ball({-0.4, 0, 0.25}, 0.2, scene.look(LookStyle::kPlain, {0.9, 0.2, 0.1}));
    scene.ball({0.3, 0.3, 0.5}, 0.15,
               scene.look(LookStyle::kFootball, {0.95, 0.95, 0.93}, {0.06, 0.06, 0.06}));
    return scene;
}

TEST(Reflection, MirrorImagesMatchSixtyFourSamples) {
    const HandMadeScene scene = polished_floor(1), dull = polished_floor(0);
    constexpr int kWide = 320, kHigh = 180;
    ASSERT_GT(
        compare_images(scene.paint(kWide, kHigh), dull.paint(kWide, kHigh)).differing_fraction(),
        0.02);
    testing::expect_good(
        testing::edge_errors(scene.paint(kWide, kHigh), testing::reference_of(scene, kWide, kHigh)),
        "mirror images");
}

// On the upright through the camera, the image of a ball at height h is seen where a ball at -h
// would be if there were no floor.
TEST(Reflection, ImageLiesAsFarBelowTheFloorAsTheBallAbove) {
    constexpr int kWide = 320, kHigh = 180;
    const auto with_ball = [&](double z, bool floor) {
        HandMadeScene scene;
        scene.camera({0, -3, 0.7}, {0, 0, 0}, 34);
        const int look = scene.look(LookStyle::kPlain, {0.05, 0.05, 0.05});
        scene.scene.looks.back().reflection = 1;
        if (floor) scene.surface(PlaneShape{}, look);
        scene.ball({0, 0, z}, 0.12, scene.look(LookStyle::kPlain, {0.95, 0.95, 0.95}));
        return scene.paint(kWide, kHigh);
    };
    HandMadeScene bare;
    bare.camera({0, -3, 0.7}, {0, 0, 0}, 34);
    const Image sky = bare.paint(kWide, kHigh), below = with_ball(-0.4, false);
    const Image image = with_ball(0.4, true), far = with_ball(50, true);

    // Middles of what differs, in the lower half of the picture.
    const auto middle = [&](const Image& a, const Image& b, int least) {
        Vec3 sum = Vec3::Zero();
        for (int y = kHigh / 2; y < kHigh; ++y)
            for (int x = 0; x < kWide; ++x)
                if (std::abs(int{a.row(y)[4 * x + 1]} - int{b.row(y)[4 * x + 1]}) > least)
                    sum += Vec3(x, y, 1);
        return sum;
    };
    // The ball's shadow is far from where its image is seen: the light comes from the side.
    const Vec3 expected = middle(below, sky, 3), found = middle(image, far, 3);
    ASSERT_GT(expected.z(), 100);
    ASSERT_GT(found.z(), 100);
    const Vec3 off = found / found.z() - expected / expected.z();
    fmt::print("image off by {:.2f}, {:.2f} px (at most 1); {} pixels, expected {}\n", off.x(),
               off.y(), found.z(), expected.z());
    EXPECT_LE(off.head<2>().norm(), 1);
}

// A wall between the mirror and the ball hides the image.
TEST(Reflection, BodyHidesTheImageOfTheBallBehindIt) {
    constexpr int kWide = 320, kHigh = 180;
    const auto picture = [&](bool wall, bool ball) {
        HandMadeScene scene;
        scene.camera({0, -3, 1.2}, {0, 0, 0}, 34);
        const int look = scene.look(LookStyle::kPlain, {0.05, 0.05, 0.05});
        scene.scene.looks.back().reflection = 1;
        scene.surface(PlaneShape{}, look);
        const int plain = scene.look(LookStyle::kPlain, {0.7, 0.7, 0.7});
        if (wall) scene.surface(BoxShape{{0, 0, 0.5}, {3, 0.05, 1.0}, Quat::Identity()}, plain);
        scene.ball(ball ? Vec3(0, 0.5, 0.4) : Vec3(0, 500, 0.4), 0.15, plain);
        return scene.paint(kWide, kHigh);
    };
    // Before the wall, where the floor mirrors it.
    const auto changed = [&](bool wall) {
        const Image with = picture(wall, true), without = picture(wall, false);
        int count = 0;
        for (int y = kHigh * 7 / 12; y < kHigh; ++y)
            for (int x = 0; x < kWide; ++x)
                count += std::abs(int{with.row(y)[4 * x]} - int{without.row(y)[4 * x]}) > 1 ? 1 : 0;
        return count;
    };
    const int in_the_open = changed(false), hidden = changed(true);
    fmt::print("pixels of the image: {} in the open, {} behind the wall (at most 0)\n", in_the_open,
               hidden);
    EXPECT_GT(in_the_open, 100);
    EXPECT_EQ(hidden, 0);
}

TEST(Reflection, IsNotDrawnUnlessALookAsksForIt) {
    for (const double reflection : {0.0, 0.5}) {
        const HandMadeScene scene = polished_floor(reflection);
        const Painter painter(scene.scene, scene.motion, PainterOptions{64, 36});
        EXPECT_EQ(painter.effects().at("reflection").on, reflection > 0);
    }
}

/// A slow pan: a few pixels in a second.
HandMadeScene panned(const Pattern& pattern) {
    HandMadeScene scene;
    scene.camera({0, -3, 1.0}, {0, 0, 0.3}, 34);
    scene.surface(PlaneShape{}, look_of(scene, pattern));
    const Vec3 spin(1, 2, 3);
    scene.ball({-0.7, 0, 0.25}, 0.25,
               scene.look(LookStyle::kBasketball, {0.85, 0.4, 0.17}, {0.06, 0.06, 0.06}), spin);
    scene.ball({0, 0.2, 0.6}, 0.12,
               scene.look(LookStyle::kFootball, {0.95, 0.95, 0.93}, {0.06, 0.06, 0.06}), spin);
    scene.ball({0.5, -0.2, 0.1}, 0.1,
               scene.look(LookStyle::kVolleyball, {0.95, 0.95, 0.93}, {0.14, 0.31, 0.61}), spin);
    scene.ball({0.6, 0.4, 0.5}, 0.05,
               scene.look(LookStyle::kTennis, {0.8, 0.88, 0.2}, {0.95, 0.95, 0.93}), spin);
    CameraKey begin, end;
    begin.from = {0, -3, 1.0};
    begin.to = end.to = {0, 0, 0.3};
    end.time = 1;
    end.from = {0.12, -3, 1.02};
    end.to = {0.06, 0, 0.3};
    begin.fov_deg = end.fov_deg = 34;
    scene.scene.camera->path = {begin, end};
    return scene;
}

/// The change from one picture to the next, around the middle of the scale.
Image change_of(const Image& before, const Image& after) {
    Image change = after;
    for (std::size_t i = 0; i < change.bgra.size(); ++i)
        change.bgra[i] = static_cast<std::uint8_t>(
            std::clamp(128 + int{after.bgra[i]} - int{before.bgra[i]}, 0, 255));
    return change;
}

class SlowPan : public ::testing::TestWithParam<Pattern> {};

// A picture that shimmers has errors that come and go: then the change from frame to frame is not
// that of the reference, which moves smoothly.
TEST_P(SlowPan, FramesAndTheirChangesMatchSixtyFourSamples) {
    constexpr int kPanWidth = 160, kPanHeight = 90, kFrames = 4;
    const HandMadeScene scene = panned(GetParam());
    Painter small(scene.scene, scene.motion, {kPanWidth, kPanHeight});
    Painter large(scene.scene, scene.motion,
                  {kPanWidth * testing::kSamples, kPanHeight * testing::kSamples});
    Image image, big, image_before, reference_before;
    std::vector<testing::EdgeErrors> frames, changes;
    for (int k = 0; k < kFrames; ++k) {
        const double t = 0.4 + k / 60.0;  // balls turn as well
        small.paint(t, image);
        large.paint(t, big);
        const Image reference = testing::averaged(big, testing::kSamples);
        frames.push_back(testing::edge_errors(image, reference));
        if (k > 0) {
            ASSERT_GT(compare_images(image, image_before).differing_fraction(), 0.02);
            changes.push_back(testing::edge_errors(change_of(image_before, image),
                                                   change_of(reference_before, reference)));
        }
        image_before = image;
        reference_before = reference;
    }
    testing::expect_good(testing::taken_together(frames), GetParam().name);
    testing::expect_good(testing::taken_together(changes),
                         fmt::format("{}, from frame to frame", GetParam().name));
}

INSTANTIATE_TEST_SUITE_P(Patterns, SlowPan, ::testing::ValuesIn(kPatterns), pattern_name);

}  // namespace
}  // namespace carom
