// The whole picture: markings, shadows, occlusion, and that the same instant gives the same bytes.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/failure.h"
#include "hand_made_scene.h"
#include "render/gl/gl_program.h"
#include "render/gl/offscreen.h"
#include "render/view/lights.h"

namespace carom {
namespace {

using testing::HandMadeScene;
using testing::linear_of;

constexpr int kPainterWidth = 320, kPainterHeight = 180;
const Color kRed{0.8, 0.05, 0.05};

HandMadeScene floor_scene() {
    HandMadeScene scene;
    scene.camera({0, -4, 1.5}, {0, 0, 0.4}, 36);
    scene.surface(PlaneShape{}, scene.look(LookStyle::kPlain, {0.9, 0.9, 0.9}));
    return scene;
}

int differing_pixels(const Image& a, const Image& b) {
    return static_cast<int>(compare_images(a, b).differing);
}

TEST(Painter, NamesItsRenderer) {
    HandMadeScene scene = floor_scene();
    const Painter painter(scene.scene, scene.motion, PainterOptions{64, 36});
    fmt::print("{}\n", painter.renderer());
    EXPECT_NE(painter.renderer().find("Mesa"), std::string::npos);
}

TEST(Painter, DrawsAnOpaquePictureThatIsNotBlank) {
    HandMadeScene scene = floor_scene();
    scene.ball({0, 0, 0.5}, 0.2, scene.look(LookStyle::kBasketball, {0.8, 0.4, 0.1}, {0, 0, 0}));
    const Image image = scene.paint(kPainterWidth, kPainterHeight);
    ASSERT_EQ(image.width_px, kPainterWidth);
    ASSERT_EQ(image.height_px, kPainterHeight);
    int darkest = 255, lightest = 0;
    for (std::size_t i = 0; i < image.bgra.size(); ++i) {
        if (i % 4 == 3) {
            ASSERT_EQ(image.bgra[i], 255) << "at byte " << i;
        } else {
            darkest = std::min(darkest, int{image.bgra[i]});
            lightest = std::max(lightest, int{image.bgra[i]});
        }
    }
    EXPECT_LT(darkest, 60);
    EXPECT_GT(lightest, 180);
    EXPECT_LT(lightest, 255) << "white is clipped";
}

TEST(Painter, OneProgramForAllStylesDrawsTheSamePixels) {
    HandMadeScene scene = floor_scene();
    scene.surface(BoxShape{Vec3(0, -0.6, 0.05), Vec3(2.4, 0.05, 0.1), Quat::Identity()},
                  scene.look(LookStyle::kPlain, {0.5, 0.4, 0.3}));
    constexpr int kStyles = 7;  // kPlain ... kTableTennis
    for (int i = 0; i < kStyles; ++i) {
        const int look = scene.look(static_cast<LookStyle>(i), {0.8, 0.5, 0.2}, {0.1, 0.2, 0.5});
        scene.ball({0.32 * i - 0.96, 0.1 * (i % 3), 0.3}, 0.15, look);
    }
    const auto painted = [&](bool few_pictures) {
        PainterOptions options{2 * kPainterWidth, 2 * kPainterHeight};
        options.few_pictures = few_pictures;
        Image image;
        Painter(scene.scene, scene.motion, options).paint(0, image);
        return image;
    };
    const Image each = painted(false), all = painted(true);
    EXPECT_EQ(differing_pixels(each, all), 0);

    // Every style is in the picture: without it, some pixels change.
    for (Ball& ball : scene.scene.balls) {
        const int look = std::exchange(ball.look, 0);
        const int changed = differing_pixels(each, painted(true));
        fmt::print("ball {}: {} pixels\n", ball.name, changed);
        EXPECT_GT(changed, 300);
        ball.look = look;
    }
}

TEST(Painter, SameInstantGivesSameBytesInAnyOrder) {
    HandMadeScene scene = floor_scene();
    const int look = scene.look(LookStyle::kFootball, {0.9, 0.9, 0.9}, {0.1, 0.1, 0.1});
    scene.ball({-0.5, 0, 0.5}, 0.2, look, {1, 2, 3}, {0.1, 0, 0});
    scene.ball({0.5, 0.2, 0.3}, 0.2, look, {0, 0, 9}, {-0.2, 0, 0});
    scene.scene.overlay.trail = TrailOptions{};
    Painter first(scene.scene, scene.motion, PainterOptions{kPainterWidth, kPainterHeight});
    Painter second(scene.scene, scene.motion, PainterOptions{kPainterWidth, kPainterHeight});
    Image forward, later, back, alone;
    first.paint(0.25, forward);
    first.paint(1.5, later);
    first.paint(0.25, back);
    second.paint(1.5, alone);
    EXPECT_GT(differing_pixels(forward, later), 100);
    EXPECT_TRUE(forward == back);
    EXPECT_TRUE(later == alone);
}

TEST(Painter, SpinMovesTheMarkingsOfEveryStyle) {
    for (const LookStyle style :
         {LookStyle::kStriped, LookStyle::kBasketball, LookStyle::kVolleyball, LookStyle::kFootball,
          LookStyle::kTennis, LookStyle::kTableTennis}) {
        for (int axis = 0; axis < 3; ++axis) {
            HandMadeScene scene = floor_scene();
            scene.ball({0, 0, 0.6}, 0.5, scene.look(style, {0.9, 0.6, 0.2}, {0.1, 0.1, 0.3}),
                       Vec3::Unit(axis));
            Painter painter(scene.scene, scene.motion,
                            PainterOptions{kPainterWidth, kPainterHeight});
            Image before, after;
            painter.paint(0, before);
            painter.paint(0.7, after);
            EXPECT_GT(differing_pixels(before, after), 40)
                << "style " << static_cast<int>(style) << ", axis " << axis;
        }
    }
}

TEST(Painter, SpinDoesNotShowOnAPlainBall) {
    HandMadeScene scene = floor_scene();
    scene.ball({0, 0, 0.6}, 0.5, scene.look(LookStyle::kPlain, kRed), {1, 2, 3});
    Painter painter(scene.scene, scene.motion, PainterOptions{kPainterWidth, kPainterHeight});
    Image before, after;
    painter.paint(0, before);
    painter.paint(0.7, after);
    // The same up to how the rotation rounds.
    EXPECT_LE(compare_images(before, after).largest, 1);
}

// The shadow's centre lies where the line through the ball's centre along the light meets the
// floor.
TEST(Painter, ShadowLiesWhereTheLightPutsIt) {
    const HandMadeScene empty = floor_scene();
    HandMadeScene scene = floor_scene();
    const Vec3 center(-0.4, 0.3, 0.9);
    scene.ball(center, 0.15);
    const View view(*scene.scene.camera, kPainterWidth, kPainterHeight);
    const Vec3 to_light = choose_lights(view).to_light;
    ASSERT_GT(to_light.z(), 0.3);
    const Vec3 foot = center - to_light * (center.z() / to_light.z());
    const View::Projected expected = view.project(foot);
    const double ball_bottom = view.project(center).y_px + 0.2 * view.pixels_per_metre(4);

    const Image with = scene.paint(kPainterWidth, kPainterHeight),
                without = empty.paint(kPainterWidth, kPainterHeight);
    double sum = 0, x_mean = 0, y_mean = 0;
    for (int y = static_cast<int>(ball_bottom); y < kPainterHeight; ++y) {
        for (int x = 0; x < kPainterWidth; ++x) {
            const double dark = linear_of(without.row(y)[4 * x]) - linear_of(with.row(y)[4 * x]);
            ASSERT_GE(dark, -1e-2);
            sum += dark;
            x_mean += dark * (x + 0.5);
            y_mean += dark * (y + 0.5);
        }
    }
    ASSERT_GT(sum, 5);
    x_mean /= sum;
    y_mean /= sum;
    fmt::print("shadow at ({:.2f}, {:.2f}), expected ({:.2f}, {:.2f})\n", x_mean, y_mean,
               expected.x_px, expected.y_px);
    // Perspective pulls the mean of an ellipse by a fraction of a pixel.
    EXPECT_NEAR(x_mean, expected.x_px, 0.6);
    EXPECT_NEAR(y_mean, expected.y_px, 0.6);
}

TEST(Painter, OverlappingShadowsAreNotDarkerThanFullShade) {
    HandMadeScene scene = floor_scene();
    const View view(*scene.scene.camera, kPainterWidth, kPainterHeight);
    const Vec3 to_light = choose_lights(view).to_light;
    // Both on one line to the lamp: the floor at the origin is in the full shade of each.
    scene.ball(to_light * 2.0, 0.3);
    HandMadeScene two = scene;
    two.ball(to_light * 3.0, 0.3);
    const View::Projected at = view.project(Vec3::Zero());
    const int x = static_cast<int>(at.x_px), y = static_cast<int>(at.y_px);
    const int lit = floor_scene().paint(kPainterWidth, kPainterHeight).row(y)[4 * x + 1];
    const int one = scene.paint(kPainterWidth, kPainterHeight).row(y)[4 * x + 1];
    const int both = two.paint(kPainterWidth, kPainterHeight).row(y)[4 * x + 1];
    fmt::print("lit {}, behind one ball {}, behind two {}\n", lit, one, both);
    EXPECT_LT(one, lit - 20);
    EXPECT_NEAR(both, one, 1);
}

TEST(Painter, BoxHidesTheBallBehindItAndNotTheOneBefore) {
    HandMadeScene scene = floor_scene();
    scene.surface(BoxShape{{0, 0, 0.5}, {1, 0.2, 1}, Quat::Identity()},
                  scene.look(LookStyle::kPlain, {0.3, 0.5, 0.7}));
    const int red = scene.look(LookStyle::kPlain, kRed);
    HandMadeScene before = scene, behind = scene;
    before.ball({0, -0.5, 0.5}, 0.2, red);
    behind.ball({0, 0.6, 0.35}, 0.2, red);
    const View view(*scene.scene.camera, kPainterWidth, kPainterHeight);
    const auto red_at = [&](const HandMadeScene& which, const Vec3& p) {
        const View::Projected at = view.project(p);
        const Image image = which.paint(kPainterWidth, kPainterHeight);
        const std::uint8_t* pixel =
            image.row(static_cast<int>(at.y_px)) + 4 * static_cast<int>(at.x_px);
        return pixel[2] - pixel[1];
    };
    EXPECT_GT(red_at(before, {0, -0.5, 0.5}), 60);
    EXPECT_LT(red_at(behind, {0, 0.6, 0.35}), 0);
}

// The wall is cut away for the first picture, which sees it from behind; in the second one it hides
// a ball, as in the picture of a camera that stands there.
TEST(Painter, AMovingCameraComesToSeeAWall) {
    HandMadeScene scene = floor_scene();
    scene.camera({4, 0, 1.5}, {0, 0, 0.4}, 36);
    scene.scene.camera->orbit_deg_per_s = 90;
    scene.surface(PlaneShape{Vec3(-1, 0, 0), -0.9}, scene.look(LookStyle::kPlain, {0.5, 0.6, 0.7}));
    scene.ball({1.3, 0, 0.4}, 0.3, scene.look(LookStyle::kPlain, kRed));
    Painter moving(scene.scene, scene.motion, PainterOptions{kPainterWidth, kPainterHeight});
    Image first, second, standing;
    moving.paint(0, first);
    moving.paint(1, second);
    PainterOptions options{kPainterWidth, kPainterHeight};
    options.only_at = 1.0;
    Painter(scene.scene, scene.motion, options).paint(1, standing);
    EXPECT_TRUE(second == standing);

    const auto red = [](const Image& image) {
        int count = 0;
        for (std::size_t i = 0; i < image.bgra.size(); i += 4)
            count += image.bgra[i + 2] > 2 * image.bgra[i] + 20 ? 1 : 0;
        return count;
    };
    fmt::print("pixels of the ball: {} from behind the wall, {} from before it\n", red(first),
               red(second));
    EXPECT_GT(red(first), 500);
    EXPECT_EQ(0, red(second));
}

TEST(Painter, DrawsNothingOfBallsOutOfView) {
    HandMadeScene empty;
    empty.camera({0, 0, 0}, {0, 1, 0});
    HandMadeScene scene = empty;
    const int red = scene.look(LookStyle::kPlain, kRed);
    scene.ball({0, -3, 0}, 1, red);      // behind the eye
    scene.ball({0, 0.1, 0}, 2, red);     // around it
    scene.ball({500, 5, 0}, 1, red);     // beside the picture
    scene.ball({0, -1, 0.3}, 1.0, red);  // touches the eye's plane from behind
    EXPECT_EQ(differing_pixels(scene.paint(kPainterWidth, kPainterHeight),
                               empty.paint(kPainterWidth, kPainterHeight)),
              0);
}

TEST(Painter, DrawsABallThatReachesBehindTheEye) {
    HandMadeScene empty;
    empty.camera({0, 0, 0}, {0, 1, 0}, 90);
    HandMadeScene scene = empty;
    scene.ball({2, 0.5, 0}, 1.9, scene.look(LookStyle::kPlain, kRed));
    const Image image = scene.paint(kPainterWidth, kPainterHeight);
    // Its outline crosses the middle row where |p - c| of the tangent ray is the radius: a ray at
    // the angle a from the view axis is tangent when the angle to the centre is asin(r / |c|).
    const double to_center = std::atan2(2, 0.5);
    const double tangent = to_center - std::asin(1.9 / std::hypot(2, 0.5));
    const double column = kPainterWidth / 2.0 + std::tan(tangent) * kPainterHeight / 2.0;
    ASSERT_GT(column, 10);
    ASSERT_LT(column, kPainterWidth - 10);
    const auto red_at = [&](double x) {
        const std::uint8_t* pixel = image.row(kPainterHeight / 2) + 4 * static_cast<int>(x);
        return pixel[2] - pixel[1];
    };
    EXPECT_GT(red_at(column + 2), 30);
    EXPECT_LT(red_at(column - 2), 10);
}

TEST(Painter, TakesScenesWithoutBallsOrSurfacesAndPlanesFromBehind) {
    HandMadeScene nothing;
    nothing.camera({0, -4, 1.5}, {0, 0, 0.4});
    const Image sky = nothing.paint(kPainterWidth, kPainterHeight);
    EXPECT_EQ(differing_pixels(floor_scene().paint(kPainterWidth, kPainterHeight), sky) > 1000,
              true);
    HandMadeScene from_below = floor_scene();
    from_below.camera({0, -4, -1.5}, {0, 0, 0.4});
    HandMadeScene below_nothing = nothing;
    below_nothing.camera({0, -4, -1.5}, {0, 0, 0.4});
    EXPECT_EQ(differing_pixels(from_below.paint(kPainterWidth, kPainterHeight),
                               below_nothing.paint(kPainterWidth, kPainterHeight)),
              0);
}

TEST(Painter, LooksTheSameAtEveryScale) {
    const auto at_scale = [](double s) {
        HandMadeScene scene;
        scene.camera(Vec3(0, -4, 1.5) * s, Vec3(0, 0, 0.4) * s, 36);
        Look floor;
        floor.style = LookStyle::kChecker;
        floor.tile_m = 0.5 * s;
        scene.scene.looks.push_back(floor);
        scene.surface(PlaneShape{}, 1);
        scene.surface(BoxShape{Vec3(0.6, 0, 0.2) * s, Vec3(0.4, 0.4, 0.4) * s, Quat::Identity()});
        scene.ball(Vec3(-0.4, 0, 0.3) * s, 0.2 * s, scene.look(LookStyle::kPlain, kRed));
        return scene.paint(kPainterWidth, kPainterHeight);
    };
    const Image metres = at_scale(1);
    for (const double s : {1e-3, 1e3}) {
        const ImageDifference d = compare_images(metres, at_scale(s));
        fmt::print("scale {}: largest {}, {:.3f} % differ\n", s, d.largest,
                   100 * d.differing_fraction());
        EXPECT_LE(d.largest, 6);
        EXPECT_LT(d.differing_fraction(), 0.02);
    }
}

TEST(Painter, DrawsAThousandBalls) {
    HandMadeScene scene = floor_scene();
    const int red = scene.look(LookStyle::kPlain, kRed);
    for (int i = 0; i < 1000; ++i)
        scene.ball({-1.0 + 0.2 * (i % 10), 0.2 * (i / 10 % 10), 0.05 + 0.11 * (i / 100)}, 0.05,
                   red);
    EXPECT_GT(differing_pixels(scene.paint(kPainterWidth, kPainterHeight),
                               floor_scene().paint(kPainterWidth, kPainterHeight)),
              5000);
}

TEST(Painter, SaysWhatItDrawsAndWhy) {
    HandMadeScene scene = floor_scene();
    const Painter alone(scene.scene, scene.motion, PainterOptions{64, 36});
    EXPECT_FALSE(alone.effects().at("shadows").on);
    HandMadeScene with_ball = floor_scene();
    with_ball.ball({0, 0, 1}, 0.1, with_ball.look(LookStyle::kTennis, kRed));
    const Painter painter(with_ball.scene, with_ball.motion, PainterOptions{64, 36});
    EXPECT_TRUE(painter.effects().at("shadows").on);
    EXPECT_TRUE(painter.effects().at("markings").on);
    EXPECT_FALSE(painter.effects().at("occlusion").on);
    EXPECT_FALSE(painter.effects().at("ruler").on);
    for (const auto& [name, effect] : painter.effects()) EXPECT_FALSE(effect.why.empty()) << name;
}

TEST(GlProgram, FailsWithTheDriversLog) {
    OffscreenContext context;
    GlProgram::Sources sources;
    sources.name = "broken";
    sources.vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    sources.fragment = "#version 330 core\nvoid main() { no_such_thing(); }\n";
    try {
        const GlProgram program(context.gl(), sources);
        FAIL() << "a broken shader was accepted";
    } catch (const Failure& failure) {
        const std::string text = failure.what();
        EXPECT_EQ(failure.kind(), FailureKind::kRun);
        EXPECT_NE(text.find("broken"), std::string::npos) << text;
        EXPECT_NE(text.find("no_such_thing"), std::string::npos) << text;
    }
}

TEST(Framebuffer, FailsWhenItIsIncomplete) {
    OffscreenContext context;
    const GlTexture none(context.gl());
    try {
        make_framebuffer(context.gl(), "a test", {&none});
        FAIL() << "a framebuffer without storage was accepted";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("GL_FRAMEBUFFER_INCOMPLETE"), std::string::npos)
            << failure.what();
    }
}

TEST(OffscreenContext, SeveralLiveInOneProcess) {
    HandMadeScene scene = floor_scene();
    scene.ball({0, 0, 0.5}, 0.3, scene.look(LookStyle::kPlain, kRed));
    Painter small(scene.scene, scene.motion, PainterOptions{64, 36});
    Painter large(scene.scene, scene.motion, PainterOptions{kPainterWidth, kPainterHeight});
    Image a, b, again;
    small.paint(0, a);
    large.paint(0, b);
    small.paint(0, again);
    EXPECT_TRUE(a == again);
    EXPECT_EQ(b.width_px, kPainterWidth);
}

}  // namespace
}  // namespace carom
