// The drop test: its verdict, and where it is drawn.
#include "render/runs/rebound_verdict.h"

#include <gtest/gtest.h>

#include "hand_made_scene.h"
#include "render/draw2d/font.h"
#include "render/plates/verdict.h"

namespace carom {
namespace {

using testing::HandMadeScene;

/// A ball of radius 0.1 whose first rebound came 1 m high at 1.5 s, in a motion of 10 s.
HandMadeScene tested(double low, double high, bool to_top = false) {
    HandMadeScene scene;
    scene.camera({0, -4, 1}, {0, 0, 1});
    scene.ball({0, 0, 0.1}, 0.1);
    scene.motion.peaks = {{{1.5, 1.0}, {3, 0.5}}};
    scene.scene.test = ReboundTest{0, low, high, to_top, "Rule 7"};
    return scene;
}

bool passes(const HandMadeScene& scene) { return judge_rebound(scene.scene, scene.motion)->passes; }

TEST(ReboundVerdict, ComparesTheFirstRebound) {
    EXPECT_TRUE(passes(tested(0.9, 1.1)));
    EXPECT_TRUE(passes(tested(1.0, 1.1)));  // the limits belong to the band
    EXPECT_TRUE(passes(tested(0.9, 1.0)));
    EXPECT_FALSE(passes(tested(1.001, 1.1)));
    EXPECT_FALSE(passes(tested(0.4, 0.6)));  // where the second one came
}

TEST(ReboundVerdict, TopIsADiameterHigher) {
    EXPECT_FALSE(passes(tested(0.9, 1.1, true)));
    EXPECT_TRUE(passes(tested(1.15, 1.25, true)));
    const HandMadeScene scene = tested(0.9, 1.1, true);
    const auto verdict = judge_rebound(scene.scene, scene.motion);
    EXPECT_NEAR(1.2, verdict->height_m, 1e-15);
    EXPECT_EQ(1.5, verdict->time_s);
    EXPECT_EQ("ball0 does not pass (Rule 7): rebound to its top 1.2000 m, not 0.9 to 1.1 m",
              verdict_text(scene.scene, *verdict));
}

TEST(ReboundVerdict, NoReboundDoesNotPass) {
    HandMadeScene scene = tested(0, 1);
    scene.motion.peaks = {{}};
    const auto verdict = judge_rebound(scene.scene, scene.motion);
    ASSERT_TRUE(verdict);
    EXPECT_FALSE(verdict->passes);
    EXPECT_FALSE(verdict->rebounded);
    EXPECT_NE(std::string::npos, verdict_text(scene.scene, *verdict).find("no rebound"));
}

TEST(ReboundVerdict, NoTestNoVerdict) {
    HandMadeScene scene = tested(0, 1);
    scene.scene.test.reset();
    EXPECT_FALSE(judge_rebound(scene.scene, scene.motion));
}

/// Pixels that the test changes in the frame at t.
std::int64_t drawn_at(double low, double t, const std::vector<SpeedKey>& ramp = {}) {
    HandMadeScene with = tested(low, 2), without = tested(low, 2);
    for (HandMadeScene* scene : {&with, &without}) {
        scene->scene.film.ramp = ramp;
        if (!ramp.empty()) scene->scene.film.speed = ramp.back().speed;
    }
    without.scene.test.reset();
    Image a, b;
    Painter(with.scene, with.motion, {320, 180}).paint(t, a);
    Painter(without.scene, without.motion, {320, 180}).paint(t, b);
    return compare_images(a, b).differing;
}

TEST(ReboundVerdict, IsDrawnInTheLastTwoSeconds) {
    EXPECT_EQ(0, drawn_at(0.5, 7.9));
    EXPECT_GT(drawn_at(0.5, 8.1), 1000);
    EXPECT_GT(drawn_at(1.5, 10), 1000);
}

// Two seconds of the film, whatever its speed: with v = 1 until 8 s and 3 at 10 s, linear between,
// the last two seconds take ln 3 s on the ramp and begin 2 - ln 3 s before it, at 7.0986 s.
TEST(ReboundVerdict, IsDrawnInTheLastTwoSecondsOfARamp) {
    const std::vector<SpeedKey> ramp = {{0, 1}, {8, 1}, {10, 3}};
    EXPECT_EQ(0, drawn_at(0.5, 7.09, ramp));
    EXPECT_GT(drawn_at(0.5, 7.11, ramp), 1000);
}

// Green for a ball that passes, red for one that does not.
TEST(ReboundVerdict, ColourSaysIt) {
    for (const bool pass : {true, false}) {
        HandMadeScene scene = tested(pass ? 0.5 : 1.5, 2);
        Image image;
        Painter(scene.scene, scene.motion, {640, 360}).paint(10, image);
        int green = 0, red = 0;
        for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
            const int g = image.bgra[i + 1], r = image.bgra[i + 2];
            green += g > r + 80 ? 1 : 0;
            red += r > g + 80 ? 1 : 0;
        }
        EXPECT_EQ(pass, green > 200) << green;
        EXPECT_EQ(!pass, red > 200) << red;
    }
}

// At the top, below what is written there; where a ruler stands in its way, at the bottom; and
// where that one reaches down as well, in rows beside it. Never over the ruler while there is room.
TEST(ReboundVerdict, PlateKeepsClearOfTheRuler) {
    constexpr int kWidth = 320, kHeight = 180;
    const HandMadeScene scene = tested(0.5, 2);
    const auto verdict = judge_rebound(scene.scene, scene.motion);
    const PixelRect clock = PixelRect::at(5, 5, 60, 16);
    const auto plate = [&](std::vector<PixelRect> taken) {
        taken.push_back(clock);
        return VerdictElement(scene.scene, scene.motion, *verdict, kWidth, kHeight, {clock}, taken)
            .rect();
    };
    const PixelRect top = plate({});
    EXPECT_NEAR(kWidth, top.left + top.right, 1);
    EXPECT_GT(top.top, clock.bottom);
    EXPECT_LT(top.bottom, 50);

    const PixelRect bottom = plate({PixelRect::at(150, 0, 20, 120)});
    EXPECT_EQ(top.width(), bottom.width());
    EXPECT_GT(bottom.top, 120);
    EXPECT_LE(bottom.bottom, kHeight);

    const PixelRect whole_ruler = PixelRect::at(150, 0, 20, kHeight);
    const PixelRect left = plate({whole_ruler});
    EXPECT_LE(left.right, 150);
    EXPECT_GT(left.height(), 3 * top.height());
    EXPECT_GT(left.top, clock.bottom);
    const PixelRect right = plate({whole_ruler, PixelRect::at(0, 60, 150, 60)});
    EXPECT_GE(right.left, 170);
    EXPECT_LE(right.right, kWidth);

    EXPECT_EQ(top.top, plate({{0, 0, kWidth, kHeight}}).top) << "no room at all";
}

}  // namespace
}  // namespace carom
