// Motion blur: which instants, and the mean of them against one taken picture by picture.
#include "render/view/exposure.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>

#include "hand_made_scene.h"
#include "render/picture/exposure_groups.h"
#include "scene/film_clock.h"

namespace carom {
namespace {

using testing::encoded_of;
using testing::HandMadeScene;
using testing::linear_of;

constexpr int kExposureWidth = 320, kExposureHeight = 180;

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
    EXPECT_EQ(1, exposure_count(0.2));
    EXPECT_EQ(4, exposure_count(0.5));
    EXPECT_EQ(15, exposure_count(7.3));  // finer, where the way is short
    EXPECT_EQ(16, exposure_count(12));
    EXPECT_EQ(17, exposure_count(16.5));
    EXPECT_EQ(kMostInstants, exposure_count(1e6));
    EXPECT_EQ(4, sweep_count(4));
    EXPECT_EQ(12, sweep_count(17));
    EXPECT_EQ(kMostInstants / 4, sweep_count(kMostInstants));
    const auto instants = exposure_instants(exposure, 8);
    ASSERT_EQ(8u, instants.size());
    EXPECT_NEAR(5 - 7.0 / 16 / 120, instants.front(), 1e-12);  // the middle of the first eighth
}

// A ball at 6 m/s, 1/48 s: the way in pixels is its speed, projected.
TEST(Exposure, WayIsMeasuredInThePicture) {
    const HandMadeScene made = flying_ball(180);
    const View view(*made.scene.camera, kExposureWidth, kExposureHeight);
    const Exposure exposure(made.scene.film, 10, 0.2);
    const double expected = 6.0 / 48 * view.pixels_per_metre(4);
    const BallWay found = ball_ways_px(made.scene, made.motion, exposure, view).at(0);
    const double way = found.seen;
    EXPECT_EQ(way, found.all);
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
        const View view(*made.scene.camera, kExposureWidth, kExposureHeight);
        const Exposure exposure(made.scene.film, 10, 1);
        const double way = ball_ways_px(made.scene, made.motion, exposure, view).at(0).seen;
        const double equator = 50 * 0.2 / 48 * view.pixels_per_metre(4);
        EXPECT_NEAR(marked ? equator : 0, way, 1e-6);
    }
}

// Beside the picture nothing is seen of a ball, but its shadow may be.
TEST(Exposure, WayBesideThePictureIsToldApart) {
    const HandMadeScene made = flying_ball(180, {60, 0, 0});
    const View view(*made.scene.camera, kExposureWidth, kExposureHeight);
    const BallWay way =
        ball_ways_px(made.scene, made.motion, Exposure(made.scene.film, 10, 5), view).at(0);
    EXPECT_EQ(0, way.seen);
    EXPECT_NEAR(60.0 / 48 * view.pixels_per_metre(4), way.all, 0.05 * way.all);
}

TEST(ExposureGroups, BodiesThatShareTilesBlurTogether) {
    TileOwners owners(320, 160, 16, 5);
    owners.add(0, 0, 0, 40, 20);
    owners.add(1, 100, 0, 140, 20);
    owners.add(2, 30, 10, 60, 40);  // touches a tile of body 0
    owners.add(3, 200, 100, 400, 300);
    owners.add(4, 60, 100, 70, 110);
    EXPECT_EQ(owners.group(0), owners.group(2));
    EXPECT_NE(owners.group(0), owners.group(1));

    const auto groups = sort_exposure(owners, {3.0, 0.1, 30.0, 7.5, 29.0}, 30);
    ASSERT_EQ(2u, groups.size());
    EXPECT_EQ(30, groups[0].count);
    EXPECT_EQ((std::vector<bool>{true, false, true, false, true}), groups[0].bodies);
    EXPECT_EQ(2u, groups[0].parts.size()) << "two that do not touch";
    EXPECT_EQ(15, groups[1].count) << "30, 15: as few as 15 are enough for 7.5 px";
    EXPECT_EQ((std::vector<bool>{false, false, false, true, false}), groups[1].bodies);
    const PixelRect& seen = groups[1].parts.at(0).bounds;
    EXPECT_EQ(192, seen.left);
    EXPECT_EQ(320, seen.right);
    EXPECT_EQ(96, seen.top);
    EXPECT_EQ(160, seen.bottom);
    EXPECT_EQ(8u * 4u, groups[1].parts[0].tiles.size());
}

// A slow ball is drawn less often than a fast one beside it, and both as if they were alone; a ball
// that stands is sharp, and where a fast one passes it, it hides it at each instant.
TEST(MotionBlur, EachBallHasTheInstantsThatItNeeds) {
    const double t = 0.2;
    const Vec3 fast(4, 0, 0), slow(0, 0, 0.5), still = Vec3::Zero();
    const auto picture = [&](const std::vector<std::pair<Vec3, Vec3>>& balls, double shutter_deg) {
        HandMadeScene made;
        made.camera({0, -4, 0}, {0, 0, 0});
        made.scene.film.fps = {24, 1};
        made.scene.film.shutter_deg = shutter_deg;
        for (const auto& [place, velocity] : balls)
            made.ball(place - t * velocity, 0.2, 0, Vec3::Zero(), velocity);
        return made.paint(kExposureWidth, kExposureHeight, t);
    };
    const std::pair<Vec3, Vec3> left{{-0.9, 0, 0.4}, fast}, right{{0.9, 0, -0.4}, slow};
    const Image one = picture({left}, 180), other = picture({right}, 180);
    const Image both = picture({left, right}, 180);
    int largest = 0;  // of the slow one, which may have a few instants more than alone
    for (int y = 0; y < kExposureHeight; ++y) {
        EXPECT_TRUE(std::equal(one.row(y), one.row(y) + 2 * kExposureWidth, both.row(y))) << y;
        for (int i = 2 * kExposureWidth; i < 4 * kExposureWidth; ++i)
            largest = std::max(largest, std::abs(other.row(y)[i] - both.row(y)[i]));
    }
    EXPECT_LE(largest, 3);
    // Before the fast ball stands another one.
    const std::pair<Vec3, Vec3> before{{-0.7, -1, 0.3}, still};
    const Image hidden = picture({left, before}, 180), sharp = picture({before}, 0);
    int same = 0, moved = 0;
    for (std::size_t i = 0; i < hidden.bgra.size(); ++i) {
        same += hidden.bgra[i] == sharp.bgra[i] ? 1 : 0;
        moved += std::abs(hidden.bgra[i] - one.bgra[i]) > 20 ? 1 : 0;
    }
    EXPECT_GT(same, 4 * kExposureWidth * kExposureHeight * 8 / 10);
    EXPECT_GT(moved, 1000);
}

/// The mean of so many sharp pictures while the shutter is open, in linear light.
Image mean_of_instants(const HandMadeScene& sharp, const Exposure& exposure, int count) {
    Painter painter(sharp.scene, sharp.motion, {kExposureWidth, kExposureHeight});
    std::vector<double> sum(std::size_t{4} * kExposureWidth * kExposureHeight);
    Image mean(kExposureWidth, kExposureHeight), one;
    for (const double instant : exposure_instants(exposure, count)) {
        painter.paint(instant, one);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += linear_of(one.bgra[i]);
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
        mean.bgra[i] = i % 4 == 3 ? std::uint8_t{255} : encoded_of(sum[i] / count);
    return mean;
}

int values_beyond(const Image& a, const Image& b, int off) {
    int count = 0;
    for (std::size_t i = 0; i < a.bgra.size(); ++i)
        count += std::abs(int{a.bgra[i]} - int{b.bgra[i]}) > off ? 1 : 0;
    return count;
}

// It is nearer to the light of all the time than instants are that lie half a pixel apart.
TEST(MotionBlur, IsTheMeanOverTimeInLinearLight) {
    const HandMadeScene blurred = flying_ball(180), sharp = flying_ball(0);
    const double t = 0.2;
    const Image picture = blurred.paint(kExposureWidth, kExposureHeight, t);
    const View view(*blurred.scene.camera, kExposureWidth, kExposureHeight);
    const Exposure exposure(blurred.scene.film, 10, t);
    const BallWay way = ball_ways_px(blurred.scene, blurred.motion, exposure, view).at(0);
    const int count = exposure_count(way.seen);
    ASSERT_GT(count, 4);
    const Image truth = mean_of_instants(sharp, exposure, 256);
    const int found = compare_images(truth, picture).largest;
    const int instants = compare_images(truth, mean_of_instants(sharp, exposure, count)).largest;
    fmt::print("largest difference to 256 instants: {} of 255; of {} instants {}\n", found, count,
               instants);
    EXPECT_LE(found, instants);
    EXPECT_LE(found, 4);
    EXPECT_GT(values_beyond(truth, sharp.paint(kExposureWidth, kExposureHeight, t), 20), 500)
        << "nothing was blurred";
}

// The light along a fast ball's path is that of far more instants, so that no steps are left.
TEST(MotionBlur, LeavesNoSteps) {
    const HandMadeScene made = flying_ball(360, {6, 0, 0}), sharp = flying_ball(0, {6, 0, 0});
    const double t = 0.1;
    const Image picture = made.paint(kExposureWidth, kExposureHeight, t);
    const Exposure exposure(made.scene.film, 10, t);
    Painter painter(sharp.scene, sharp.motion, {kExposureWidth, kExposureHeight});
    constexpr int kFine = 400;
    const int y = 82;
    std::vector<double> sum(kExposureWidth);
    Image one;
    for (int i = 0; i < kFine; ++i) {
        painter.paint(exposure.at((i + 0.5) / kFine), one);
        for (int x = 0; x < kExposureWidth; ++x)
            sum[static_cast<std::size_t>(x)] += linear_of(one.row(y)[4 * x]);
    }
    int largest = 0;
    for (int x = 0; x < kExposureWidth; ++x) {
        const int fine = encoded_of(sum[static_cast<std::size_t>(x)] / kFine);
        largest = std::max(largest, std::abs(fine - int{picture.row(y)[4 * x]}));
    }
    fmt::print("largest difference to 400 instants: {} of 255\n", largest);
    EXPECT_LE(largest, 2);
}

// A short way of a ball with fine markings, too.
TEST(MotionBlur, FewInstantsLeaveLittleOfEach) {
    for (const double way_m : {0.5, 1.0, 2.0}) {
        const auto spinning = [&](double shutter_deg) {
            HandMadeScene made;
            made.camera({0, -4, 0}, {0, 0, 0});
            const double spin = way_m;
            made.ball({0, 0, 0}, 0.5,
                      made.look(LookStyle::kBasketball, {0.8, 0.4, 0.1}, {0.05, 0.05, 0.05}),
                      {0.2 * spin, 0.3 * spin, spin}, {0.2 * spin, 0, 0});
            made.scene.film.fps = {24, 1};
            made.scene.film.shutter_deg = shutter_deg;
            return made;
        };
        const HandMadeScene made = spinning(360), sharp = spinning(0);
        const double t = 0.5;
        const Image picture = made.paint(kExposureWidth, kExposureHeight, t);
        const Exposure exposure(made.scene.film, 10, t);
        Painter painter(sharp.scene, sharp.motion, {kExposureWidth, kExposureHeight});
        constexpr int kFine = 60;
        std::vector<double> sum(picture.bgra.size());
        Image one;
        for (const double instant : exposure_instants(exposure, kFine)) {
            painter.paint(instant, one);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += linear_of(one.bgra[i]);
        }
        const View view(*made.scene.camera, kExposureWidth, kExposureHeight);
        const double way = ball_ways_px(made.scene, made.motion, exposure, view).at(0).seen;
        int largest = 0, changed = 0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            if (i % 4 == 3) continue;
            largest =
                std::max(largest, std::abs(encoded_of(sum[i] / kFine) - int{picture.bgra[i]}));
            changed += std::abs(int{one.bgra[i]} - int{picture.bgra[i]}) > 8 ? 1 : 0;
        }
        fmt::print("way {:.2f} px, {} instants: largest difference to 60 is {} of 255\n", way,
                   exposure_count(way), largest);
        EXPECT_LE(largest, 8);
        EXPECT_GT(changed, 50) << "nothing was blurred";
    }
}

// However few parts the time is divided into: balls of all styles that fly and turn fast, with
// their shadows and images, and one that bounces meanwhile, are as in the mean of many instants.
TEST(MotionBlur, IsNearTheMeanOfManyInstants) {
    constexpr LookStyle kStyles[] = {
        LookStyle::kPlain,    LookStyle::kStriped, LookStyle::kBasketball, LookStyle::kVolleyball,
        LookStyle::kFootball, LookStyle::kTennis,  LookStyle::kTableTennis};
    const double t = 0.5;
    for (const LookStyle style : kStyles) {
        for (const bool mirror : {false, true}) {
            if (mirror && style != LookStyle::kStriped) continue;
            const auto made = [&](double shutter_deg) {
                HandMadeScene scene;
                scene.camera({0, -4, 0.6}, {0, 0, 0.4});
                const int floor = scene.look(LookStyle::kPlain, {0.8, 0.8, 0.8});
                if (mirror) scene.scene.looks[static_cast<std::size_t>(floor)].reflection = 0.5;
                scene.surface(PlaneShape{}, floor);
                const int look = scene.look(style, {0.8, 0.3, 0.1}, {0.9, 0.9, 0.85});
                const Vec3 fast(9, 1, 1), slow(-1, 0, 2);
                scene.ball(Vec3(-0.5, 0, 0.5) - t * fast, 0.3, look, {5, 20, 10}, fast);
                scene.ball(Vec3(0.8, 0.2, 0.4) - t * slow, 0.25, look, {0, 3, 25}, slow);
                // Down to the floor at t, and up again.
                scene.ball({-1.1, 0.4, 0.2 + t * 5}, 0.2, look, Vec3::Zero(), {0, 0, -5});
                Piece up;
                up.start = t;
                up.position = {-1.1, 0.4, 0.2};
                up.velocity = {0, 0, 4};
                scene.motion.balls.back().append(up);
                scene.scene.film.fps = {24, 1};
                scene.scene.film.shutter_deg = shutter_deg;
                return scene;
            };
            const HandMadeScene open = made(180), sharp = made(0);
            const Image picture = open.paint(kExposureWidth, kExposureHeight, t);
            constexpr int kMany = 128;
            const Image truth = mean_of_instants(sharp, Exposure(open.scene.film, 10, t), kMany);
            const int largest = compare_images(truth, picture).largest;
            const int beyond = values_beyond(truth, picture, 3);
            fmt::print(
                "style {}{}: largest difference to {} instants {} of 255, {} values off by "
                "more than 3\n",
                static_cast<int>(style), mirror ? ", mirrored" : "", kMany, largest, beyond);
            EXPECT_LE(largest, 8);
            EXPECT_GT(values_beyond(truth, sharp.paint(kExposureWidth, kExposureHeight, t), 20),
                      1000)
                << "nothing was blurred";
        }
    }
}

TEST(MotionBlur, WhatStandsStillAndTheClockStaySharp) {
    HandMadeScene blurred = flying_ball(180, Vec3::Zero()), sharp = flying_ball(0, Vec3::Zero());
    EXPECT_EQ(sharp.paint(kExposureWidth, kExposureHeight, 0.2),
              blurred.paint(kExposureWidth, kExposureHeight, 0.2));

    HandMadeScene moving = flying_ball(180), frozen = flying_ball(0);
    moving.scene.overlay.clock = frozen.scene.overlay.clock = ClockOptions{};
    const Image a = moving.paint(kExposureWidth, kExposureHeight, 0.2),
                b = frozen.paint(kExposureWidth, kExposureHeight, 0.2);
    for (int y = 0; y < 30; ++y)
        EXPECT_TRUE(std::equal(a.row(y), a.row(y) + 4 * 80, b.row(y))) << y;
    EXPECT_NE(a, b);
}

TEST(MotionBlur, AStrobeIsSharp) {
    const HandMadeScene blurred = flying_ball(180), sharp = flying_ball(0);
    std::array<Image, 2> strobes;
    for (int i = 0; i < 2; ++i) {
        const HandMadeScene& made = i == 0 ? blurred : sharp;
        Painter painter(made.scene, made.motion, {kExposureWidth, kExposureHeight});
        painter.paint_strobe({0.1, 0.3}, strobes[static_cast<std::size_t>(i)]);
    }
    EXPECT_EQ(strobes[0], strobes[1]);
}

// A camera that moves blurs what stands still.
TEST(MotionBlur, OfAMovingCamera) {
    HandMadeScene made = flying_ball(360, Vec3::Zero());
    made.scene.camera->orbit_deg_per_s = 60;
    const Image blurred = made.paint(kExposureWidth, kExposureHeight, 0.5);
    made.scene.film.shutter_deg = 0;
    const ImageDifference d =
        compare_images(blurred, made.paint(kExposureWidth, kExposureHeight, 0.5));
    EXPECT_GT(d.largest, 30);
}

}  // namespace
}  // namespace carom
