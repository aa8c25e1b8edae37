// Two runs in one picture: who belongs to whom, how far apart, and what is seen of a ghost.
#include "render/runs/second_run.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "core/failure.h"
#include "hand_made_scene.h"
#include "render/plates/run_difference.h"

namespace carom {
namespace {

using testing::HandMadeScene;

constexpr int kSecondRunWidth = 320, kSecondRunHeight = 180;
const Color kRunRed{0.8, 0.05, 0.05};

SecondRun second_of(const HandMadeScene& made, AgainstView view = AgainstView::kGhost) {
    SecondRun second;
    second.scene = made.scene;
    second.motion = made.motion;
    second.ended_s = made.motion.duration;
    second.view = view;
    second.differences = {{"simulation.method", "exact", "fixed"}};
    second.first_name = "one";
    second.second_name = "other";
    return second;
}

HandMadeScene one_ball(const Vec3& position, double radius = 0.3) {
    HandMadeScene made;
    made.camera({0, -5, 0}, {0, 0, 0});
    made.ball(position, radius, made.look(LookStyle::kPlain, kRunRed));
    return made;
}

Image painted(const HandMadeScene& made, const SecondRun* second, double t = 0) {
    Painter painter(made.scene, made.motion, {kSecondRunWidth, kSecondRunHeight, second});
    Image image;
    painter.paint(t, image);
    return image;
}

/// Pixels in the middle of the picture, clear of the plate, where two pictures are not the same.
int differing(const Image& a, const Image& b) {
    int count = 0;
    for (int y = 30; y < 125; ++y)
        for (int x = 0; x < kSecondRunWidth; ++x)
            count += std::equal(a.row(y) + 4 * x, a.row(y) + 4 * x + 4, b.row(y) + 4 * x) ? 0 : 1;
    return count;
}

TEST(TwoRuns, BallsBelongTogetherByName) {
    HandMadeScene a, b;
    for (int i = 0; i < 3; ++i) a.ball({1.0 * i, 0, 0}, 0.1);
    for (int i = 0; i < 2; ++i) b.ball({1.0 * i, 0, 0.25 * i}, 0.1);
    std::swap(b.scene.balls[0].name, b.scene.balls[1].name);
    const auto pairs = paired_balls(a.scene, b.scene);
    ASSERT_EQ(2u, pairs.size());
    EXPECT_EQ(1u, pairs[0].second);
    const Apart apart = farthest_apart(a.motion, b.motion, pairs, 0);
    EXPECT_NEAR(std::hypot(1, 0.25), apart.metres, 1e-15);
    EXPECT_EQ(0u, apart.pair);
}

TEST(TwoRuns, WhatCannotBeComparedIsRefused) {
    HandMadeScene a = one_ball({0, 0, 0}), b = one_ball({0, 0, 0});
    b.scene.balls[0].name = "stranger";
    EXPECT_THROW(check_runs(a.scene, second_of(b)), Failure);

    HandMadeScene c = one_ball({0, 0, 0});
    c.surface(SphereShape{{0, 0, -1}, 0.2});
    EXPECT_THROW(check_runs(a.scene, second_of(c)), Failure) << "a surface that is not drawn";
    EXPECT_NO_THROW(check_runs(a.scene, second_of(c, AgainstView::kSide)));
    EXPECT_NO_THROW(check_runs(c.scene, second_of(c)));
}

TEST(TwoRuns, DistancesHaveTheUnitThatSuits) {
    EXPECT_EQ("0 mm", distance_text(0));
    EXPECT_EQ("< 0.001 mm", distance_text(1e-9));
    EXPECT_EQ("0.012 mm", distance_text(1.2e-5));
    EXPECT_EQ("3.21 mm", distance_text(0.003214));
    EXPECT_EQ("1.23 cm", distance_text(0.01234));
    EXPECT_EQ("45.7 cm", distance_text(0.4567));
    EXPECT_EQ("1.25 m", distance_text(1.25));
    EXPECT_EQ("1234 m", distance_text(1234.4));
}

TEST(TwoRuns, AShorterMotionStaysWhereItEnds) {
    HandMadeScene made;
    made.ball({0, 0, 0}, 0.1, 0, {0, 0, 1}, {2, 0, 0});
    const Motion held = held_until(made.motion, 15);
    EXPECT_EQ(15, held.duration);
    EXPECT_NEAR(20, held.balls[0].at(10).position.x(), 1e-12);
    EXPECT_NEAR(20, held.balls[0].at(14).position.x(), 1e-12);
    EXPECT_EQ(held.balls[0].at(10).orientation.coeffs(), held.balls[0].at(15).orientation.coeffs());
    EXPECT_NEAR(8, held_until(made.motion, 4).balls[0].at(4).position.x(), 1e-12);
}

// The camera of both holds both: the other run's ball goes twice as far.
TEST(TwoRuns, FramingHoldsBothMotions) {
    HandMadeScene a, b;
    a.ball({0, 0, 1}, 0.1, 0, Vec3::Zero(), {0.2, 0, 0});
    b.ball({0, 0, 1}, 0.1, 0, Vec3::Zero(), {-0.4, 0, 0});
    const BothRuns joined = both_runs(a.scene, a.motion, second_of(b));
    const View view(choose_camera(joined.scene, joined.motion, 16.0 / 9), kSecondRunWidth,
                    kSecondRunHeight);
    for (const double x : {2.0, -4.0}) {
        const View::Projected p = view.project({x, 0, 1});
        EXPECT_GT(p.x_px, 0);
        EXPECT_LT(p.x_px, kSecondRunWidth);
    }
    const View alone(choose_camera(a.scene, a.motion, 16.0 / 9), kSecondRunWidth, kSecondRunHeight);
    EXPECT_LT(alone.project({-4, 0, 1}).x_px, 0) << "the test shows nothing";
}

TEST(Ghost, WhereBothRunsAgreeOnlyTheSolidBallIsSeen) {
    const HandMadeScene made = one_ball({0, 0, 0});
    const SecondRun same = second_of(made);
    EXPECT_EQ(0, differing(painted(made, nullptr), painted(made, &same)));
}

// For one picture two threads compile, and balls and ghosts are drawn in whichever context has
// their program; whoever comes first, the picture is that of one thread.
TEST(TwoRuns, APictureOfTwoThreadsIsThatOfOne) {
    const auto made = [](double shift, bool mirror) {
        HandMadeScene scene;
        scene.camera({0, -5, 1}, {0, 0, 0.4});
        const int floor = scene.look(LookStyle::kPlain, {0.7, 0.7, 0.7});
        if (mirror) scene.scene.looks[static_cast<std::size_t>(floor)].reflection = 0.6;
        scene.surface(PlaneShape{}, floor);
        scene.surface(BoxShape{Vec3(0, -0.8, 0.1), Vec3(2, 0.1, 0.2), Quat::Identity()}, floor);
        const int look = scene.look(LookStyle::kBasketball, kRunRed);
        scene.ball({-0.6 + shift, 0, 0.4}, 0.3, look, {0, 3, 0}, {1, 0, 0.3});
        scene.ball({0.7, 0.5 * shift, 0.3}, 0.2, look);
        scene.scene.overlay.trail = TrailOptions{};
        return scene;
    };
    for (const bool mirror : {false, true}) {
        for (const double shutter_deg : {0.0, 180.0}) {
            HandMadeScene first = made(0, mirror);
            first.scene.film.shutter_deg = shutter_deg;
            const SecondRun second = second_of(made(0.25, mirror));
            const auto picture = [&](bool few_pictures) {
                PainterOptions options{kSecondRunWidth, kSecondRunHeight, &second};
                options.few_pictures = few_pictures;
                Painter painter(first.scene, first.motion, options);
                Image image;
                painter.paint(0.5, image);
                Image again;
                painter.paint(0.5, again);
                EXPECT_EQ(image, again);
                return image;
            };
            const Image one = picture(false);
            for (int i = 0; i < 4; ++i) {
                const ImageDifference d = compare_images(one, picture(true));
                EXPECT_LE(d.largest, 1) << "mirror " << mirror << ", shutter " << shutter_deg;
            }
        }
    }
}

TEST(Ghost, ASolidBallHidesWhatLiesBehindIt) {
    const HandMadeScene solid = one_ball({0, 0, 0}, 0.5);
    const Image alone = painted(solid, nullptr);
    const SecondRun behind = second_of(one_ball({0, 2, 0}, 0.3));
    EXPECT_EQ(0, differing(alone, painted(solid, &behind)));
    const SecondRun before = second_of(one_ball({0, -1, 0}, 0.3));
    const int tinted = differing(alone, painted(solid, &before));
    fmt::print("pixels that a ghost before the ball changes: {}\n", tinted);
    EXPECT_GT(tinted, 800);
}

// Two balls that reach into each other meet in a plane: left of it the left one is in front.
TEST(Ghost, WhereBallsMeetEachPixelHasItsOwnOrder) {
    const HandMadeScene solid = one_ball({0.1, 0, 0}, 0.5);
    const Image alone = painted(solid, nullptr);
    const SecondRun left = second_of(one_ball({-0.1, 0, 0}, 0.5));
    const Image both = painted(solid, &left);
    const int y = kSecondRunHeight / 2;
    const auto changed = [&](int x) {
        return !std::equal(both.row(y) + 4 * x, both.row(y) + 4 * x + 4, alone.row(y) + 4 * x);
    };
    // The solid ball's right part is untouched, and so is its part right of the middle.
    for (int x = kSecondRunWidth / 2 + 4; x < kSecondRunWidth; ++x) EXPECT_FALSE(changed(x)) << x;
    int ghost = 0;
    for (int x = 0; x < kSecondRunWidth / 2 - 4; ++x) ghost += changed(x) ? 1 : 0;
    EXPECT_GT(ghost, 20) << "left of the middle the ghost is in front";
}

TEST(SideBySide, EqualRunsGiveEqualHalves) {
    HandMadeScene made = one_ball({0, 0, 0});
    made.surface(PlaneShape{Vec3::UnitZ(), -0.5});
    SecondRun same = second_of(made, AgainstView::kSide);
    same.differences = {{"simulation.method", "exact", "exact"}};
    const Image image = painted(made, &same);
    ASSERT_EQ(kSecondRunWidth, image.width_px);
    int wrong = 0, dark = 0;
    const int half = (kSecondRunWidth - 2) / 2;  // a divider of 2 px, so that both halves are equal
    for (int y = 0; y < 140; ++y) {
        for (int x = 0; x < half; ++x) {
            const std::uint8_t *l = image.row(y) + 4 * x, *r = l + 4 * (half + 2);
            wrong += std::equal(l, l + 4, r) ? 0 : 1;
            dark += l[2] > l[1] + 40 ? 1 : 0;
        }
    }
    EXPECT_EQ(0, wrong);
    EXPECT_GT(dark, 300) << "the ball";
}

// The halves share a driver and its programs, but not balls and surfaces: each is the half that it
// is beside itself, also where the camera moves.
TEST(SideBySide, HalvesDoNotGetIntoEachOthersWay) {
    const auto made = [](double speed, double floor, LookStyle style) {
        HandMadeScene scene = one_ball({0, 0, 0});
        scene.scene.camera->orbit_deg_per_s = 20;
        scene.motion.duration = 1;
        scene.motion.balls[0] = Trajectory();
        Piece piece;
        piece.velocity = {speed, 0, 0.2 * speed};
        scene.motion.balls[0].append(piece);
        const int look = scene.look(style, {0.9, 0.9, 0.9}, {0.3, 0.3, 0.4});
        scene.surface(PlaneShape{Vec3::UnitZ(), floor}, look);
        scene.surface(BoxShape{{0.5, 0.4, floor}, {0.3, 0.3, 0.6}, Quat::Identity()}, look);
        return scene;
    };
    const HandMadeScene a = made(0.1, -0.5, LookStyle::kChecker);
    const HandMadeScene b = made(0.7, -0.8, LookStyle::kPlain);
    const auto beside = [](const HandMadeScene& left, const HandMadeScene& right) {
        const SecondRun second = second_of(right, AgainstView::kSide);
        return painted(left, &second, 1);
    };
    const Image both = beside(a, b), left = beside(a, a), right = beside(b, b);
    constexpr int kHalf = (kSecondRunWidth - 2) / 2;
    int wrong = 0, unlike = 0;
    for (int y = 30; y < 140; ++y) {  // below the captions
        for (int x = 0; x < kSecondRunWidth; ++x) {
            const Image& same = x < kHalf ? left : right;
            const Image& other = x < kHalf ? right : left;
            const std::uint8_t* pixel = both.row(y) + 4 * x;
            wrong += std::equal(pixel, pixel + 4, same.row(y) + 4 * x) ? 0 : 1;
            unlike += std::equal(pixel, pixel + 4, other.row(y) + 4 * x) ? 0 : 1;
        }
    }
    EXPECT_EQ(0, wrong);
    EXPECT_GT(unlike, 10'000);
}

TEST(RunDifference, SaysTheDistanceAndWhoseItIs) {
    HandMadeScene a, b;
    for (HandMadeScene* made : {&a, &b})
        for (int i = 0; i < 2; ++i) made->ball({1.0 * i, 0, 0}, 0.1);
    b.motion.balls[1] = Trajectory();
    Piece piece;
    piece.position = {1, 0, 0};
    piece.velocity = {0, 0, 0.1};
    b.motion.balls[1].append(piece);
    SecondRun second = second_of(b);
    second.ended_s = 8;
    const RunDifference plate(a.scene, a.motion, second, kSecondRunWidth, kSecondRunHeight, {}, {});
    EXPECT_EQ("Farthest apart: 0 mm", plate.distance_line(0));
    EXPECT_EQ("Farthest apart: ball1, 10.0 cm", plate.distance_line(1));
    EXPECT_EQ("Farthest apart: ball1, 90.0 cm (the other ended at 8 s)", plate.distance_line(9));
    EXPECT_EQ("simulation.method: exact", run_caption(second, false));
    EXPECT_EQ("simulation.method: fixed", run_caption(second, true));
    EXPECT_EQ("method: fixed", run_caption(second, true, true));
    second.differences = {{"balls.a.mass", "1", "2"}, {"balls.b.mass", "1", "3"}};
    EXPECT_EQ("a.mass: 2\nb.mass: 3", run_caption(second, true, true));
    second.differences.resize(9);
    EXPECT_EQ("one", run_caption(second, false));
    // Inside the picture, and off what is taken.
    const PixelRect corner = PixelRect::at(0, kSecondRunHeight - 60, 100, 60);
    const RunDifference elsewhere(a.scene, a.motion, second, kSecondRunWidth, kSecondRunHeight,
                                  {{corner}, {}}, {});
    EXPECT_FALSE(elsewhere.rect().overlaps(corner));
    // Of free corners, one where balls do not come.
    const RunDifference free(
        a.scene, a.motion, second, kSecondRunWidth, kSecondRunHeight,
        {{},
         {{20, kSecondRunHeight - 20}, {kSecondRunWidth - 20, kSecondRunHeight - 20}, {20, 20}}},
        {});
    EXPECT_GT(free.rect().left, 10);
    EXPECT_LT(free.rect().top, kSecondRunHeight / 2);
    EXPECT_GE(elsewhere.rect().left, 0);
    EXPECT_LE(elsewhere.rect().right, kSecondRunWidth);
}

}  // namespace
}  // namespace carom
