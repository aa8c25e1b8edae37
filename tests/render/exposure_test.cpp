// Motion blur: which instants, and the mean of them against one taken picture by picture.
#include "render/exposure.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>

#include "hand_made_scene.h"
#include "scene/film_clock.h"

namespace carom {
namespace {

using testing::encoded_of;
using testing::HandMadeScene;
using testing::linear_of;

constexpr int kWidth = 320, kHeight = 180;

HandMadeScene flying_ball(double shutter_deg, const Vec3& velocity = {6, 0, 0}) {
    HandMadeScene made;
    made.camera({0, -4, 0.6}, {0, 0, 0.4});
    made.surface(PlaneShape{}, made.look(LookStyle::kPlain, {0.8, 0.8, 0.8}));
    made.ball({-0.6, 0, 0.5}, 0.2, made.look(LookStyle::kPlain, {0.1, 0.2, 0.6}), Vec3::Zero(),
              velocity);
    made.scene.film.fps = {24, 1};
    made.scene.film.shutter_deg = shutter_deg;
    return made;
}

TEST(Exposure, IsCentredOnItsInstantInFilmTime) {
    Film film;
    film.fps = {24, 1};
    film.shutter_deg = 180;
    film.speed = 0.5;
    film.start = 1;
    const Exposure exposure(film, 10, 2);
    EXPECT_NEAR(2 - 0.5 * 0.5 / 48, exposure.at(0), 1e-12);
    EXPECT_NEAR(2, exposure.at(0.5), 1e-12);
    EXPECT_NEAR(2 + 0.5 * 0.5 / 48, exposure.at(1), 1e-12);
    // Cut off where the motion begins and ends.
    EXPECT_EQ(0, Exposure(film, 10, 0).at(0));
    EXPECT_EQ(10, Exposure(film, 10, 10).at(1));
}

TEST(Exposure, FollowsARamp) {
    Film film;
    film.fps = {10, 1};
    film.shutter_deg = 360;
    film.ramp = {{1, 1}, {2, 0.1}};
    const Exposure exposure(film, 5, 1.5);
    const double middle = film_time(film, 1.5);
    for (const double part : {0.0, 0.25, 0.9}) {
        const double expected = motion_time(film, middle + 0.1 * (part - 0.5));
        EXPECT_NEAR(expected, exposure.at(part), 1e-12);
    }
    EXPECT_GT(exposure.at(0.5) - exposure.at(0), exposure.at(1) - exposure.at(0.5));
}

TEST(Exposure, TakesAsManyInstantsAsPixelsOfWay) {
    Film film;
    film.shutter_deg = 180;
    const Exposure exposure(film, 10, 5);
    EXPECT_EQ(std::vector<double>{5}, exposure_instants(exposure, 5, 0.2));
    EXPECT_EQ(2u, exposure_instants(exposure, 5, 0.5).size());
    const auto instants = exposure_instants(exposure, 5, 7.3);
    ASSERT_EQ(8u, instants.size());
    EXPECT_NEAR(5 - 7.0 / 16 / 120, instants.front(), 1e-12);  // the middle of the first eighth
    EXPECT_EQ(static_cast<std::size_t>(kMostInstants), exposure_instants(exposure, 5, 1e6).size());
}

// A ball at 6 m/s, 1/48 s: the way in pixels is its speed, projected.
TEST(Exposure, WayIsMeasuredInThePicture) {
    const HandMadeScene made = flying_ball(180);
    const View view(*made.scene.camera, kWidth, kHeight);
    const Exposure exposure(made.scene.film, 10, 0.2);
    const double expected = 6.0 / 48 * view.pixels_per_metre(4);
    const double way = ball_way_px(made.scene, made.motion, exposure, view);
    fmt::print("way {:.3f} px, closed form {:.3f}\n", way, expected);
    EXPECT_NEAR(expected, way, 0.05 * expected);
}

// A turn is seen on a ball with markings, and only there.
TEST(Exposure, SpinCountsWhereItShows) {
    for (const bool marked : {false, true}) {
        HandMadeScene made;
        made.camera({0, -4, 0}, {0, 0, 0});
        const LookStyle style = marked ? LookStyle::kStriped : LookStyle::kPlain;
        made.ball({0, 0, 0}, 0.2, made.look(style, {1, 0, 0}, {1, 1, 1}), {0, 0, 50});
        made.scene.film.fps = {24, 1};
        made.scene.film.shutter_deg = 180;
        const View view(*made.scene.camera, kWidth, kHeight);
        const Exposure exposure(made.scene.film, 10, 1);
        const double way = ball_way_px(made.scene, made.motion, exposure, view);
        const double equator = 50 * 0.2 / 48 * view.pixels_per_metre(4);
        EXPECT_NEAR(marked ? equator : 0, way, 1e-6);
    }
}

TEST(MotionBlur, IsTheMeanOfItsInstantsInLinearLight) {
    const HandMadeScene blurred = flying_ball(180), sharp = flying_ball(0);
    const double t = 0.2;
    const Image picture = blurred.paint(kWidth, kHeight, t);
    const View view(*blurred.scene.camera, kWidth, kHeight);
    const Exposure exposure(blurred.scene.film, 10, t);
    const auto instants =
        exposure_instants(exposure, t, ball_way_px(blurred.scene, blurred.motion, exposure, view));
    ASSERT_GT(instants.size(), 4u);

    Painter painter(sharp.scene, sharp.motion, {kWidth, kHeight});
    std::vector<double> sum(picture.bgra.size());
    Image one;
    for (const double instant : instants) {
        painter.paint(instant, one);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += linear_of(one.bgra[i]);
    }
    int largest = 0, blurry = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        if (i % 4 == 3) continue;
        const int mean = encoded_of(sum[i] / static_cast<double>(instants.size()));
        largest = std::max(largest, std::abs(mean - int{picture.bgra[i]}));
        blurry += std::abs(mean - int{one.bgra[i]}) > 20 ? 1 : 0;
    }
    fmt::print("{} instants; largest difference to their mean: {} of 255\n", instants.size(),
               largest);
    EXPECT_LE(largest, 1);
    EXPECT_GT(blurry, 500) << "nothing was blurred";
}

// The light along a fast ball's path is that of far more instants, so that no steps are left.
TEST(MotionBlur, LeavesNoSteps) {
    const HandMadeScene made = flying_ball(360, {6, 0, 0}), sharp = flying_ball(0, {6, 0, 0});
    const double t = 0.1;
    const Image picture = made.paint(kWidth, kHeight, t);
    const Exposure exposure(made.scene.film, 10, t);
    Painter painter(sharp.scene, sharp.motion, {kWidth, kHeight});
    constexpr int kFine = 400;
    const int y = 82;
    std::vector<double> sum(kWidth);
    Image one;
    for (int i = 0; i < kFine; ++i) {
        painter.paint(exposure.at((i + 0.5) / kFine), one);
        for (int x = 0; x < kWidth; ++x)
            sum[static_cast<std::size_t>(x)] += linear_of(one.row(y)[4 * x]);
    }
    int largest = 0;
    for (int x = 0; x < kWidth; ++x) {
        const int fine = encoded_of(sum[static_cast<std::size_t>(x)] / kFine);
        largest = std::max(largest, std::abs(fine - int{picture.row(y)[4 * x]}));
    }
    fmt::print("largest difference to 400 instants: {} of 255\n", largest);
    EXPECT_LE(largest, 2);
}

TEST(MotionBlur, WhatStandsStillAndTheClockStaySharp) {
    HandMadeScene blurred = flying_ball(180, Vec3::Zero()), sharp = flying_ball(0, Vec3::Zero());
    EXPECT_EQ(sharp.paint(kWidth, kHeight, 0.2), blurred.paint(kWidth, kHeight, 0.2));

    HandMadeScene moving = flying_ball(180), frozen = flying_ball(0);
    moving.scene.overlay.clock = frozen.scene.overlay.clock = ClockOptions{};
    const Image a = moving.paint(kWidth, kHeight, 0.2), b = frozen.paint(kWidth, kHeight, 0.2);
    for (int y = 0; y < 30; ++y)
        EXPECT_TRUE(std::equal(a.row(y), a.row(y) + 4 * 80, b.row(y))) << y;
    EXPECT_NE(a, b);
}

TEST(MotionBlur, AStrobeIsSharp) {
    const HandMadeScene blurred = flying_ball(180), sharp = flying_ball(0);
    std::array<Image, 2> strobes;
    for (int i = 0; i < 2; ++i) {
        const HandMadeScene& made = i == 0 ? blurred : sharp;
        Painter painter(made.scene, made.motion, {kWidth, kHeight});
        painter.paint_strobe({0.1, 0.3}, strobes[static_cast<std::size_t>(i)]);
    }
    EXPECT_EQ(strobes[0], strobes[1]);
}

// A camera that moves blurs what stands still.
TEST(MotionBlur, OfAMovingCamera) {
    HandMadeScene made = flying_ball(360, Vec3::Zero());
    made.scene.camera->orbit_deg_per_s = 60;
    const Image blurred = made.paint(kWidth, kHeight, 0.5);
    made.scene.film.shutter_deg = 0;
    const ImageDifference d = compare_images(blurred, made.paint(kWidth, kHeight, 0.5));
    EXPECT_GT(d.largest, 30);
}

}  // namespace
}  // namespace carom
