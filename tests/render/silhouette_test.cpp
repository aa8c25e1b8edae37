// The outline of a ball: its area against the projected ellipse, its pixels against 64 samples
// each.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edge_quality.h"
#include "hand_made_scene.h"
#include "render/balls/balls_in_view.h"

namespace carom {
namespace {

using testing::HandMadeScene;
using testing::linear_of;

/// Pixels that the ball covers: how far each has come from the background to the ball's red. The
/// ball reflects red light alone and the background is measured, so green tells the coverage.
double covered_area(const HandMadeScene& with_ball, const HandMadeScene& without, int width,
                    int height) {
    const Image ball = with_ball.paint(width, height), empty = without.paint(width, height);
    double area = 0;
    for (std::size_t i = 1; i < ball.bgra.size(); i += 4)
        area += 1 - linear_of(ball.bgra[i]) / linear_of(empty.bgra[i]);
    return area;
}

struct Placement {
    const char* name;
    Vec3 center;
    double radius;
};

class SilhouetteArea : public ::testing::TestWithParam<Placement> {};

// A sphere at c of radius r before a pinhole: with D = cz^2 - r^2 an ellipse with the semi-axes
// r sqrt(|c|^2 - r^2) / D and r / sqrt(D) on the plane z = 1.
TEST_P(SilhouetteArea, IsThatOfTheProjectedEllipse) {
    const Placement& place = GetParam();
    constexpr int kWidth = 640, kHeight = 360;
    HandMadeScene empty;
    empty.camera({0, 0, 0}, {0, 1, 0}, 50);
    HandMadeScene scene = empty;
    // Black but for the highlight, which is kept out of the measure by its weakness.
    scene.ball(place.center, place.radius, scene.look(LookStyle::kTennis, {0, 0, 0}, {0, 0, 0}));

    const double measured = covered_area(scene, empty, kWidth, kHeight);
    const double pixel = 2 * std::tan(25 * M_PI / 180) / kHeight;
    const double depth = place.center.y(), r = place.radius;
    const double d = depth * depth - r * r;
    const double expected = M_PI * r * std::sqrt(place.center.squaredNorm() - r * r) / d * r /
                            std::sqrt(d) / (pixel * pixel);
    fmt::print("{}: {:.2f} pixels, closed form {:.2f}, off by {:.4f} %\n", place.name, measured,
               expected, 100 * (measured / expected - 1));
    ASSERT_GT(expected, 10);
    EXPECT_NEAR(measured / expected, 1, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Places, SilhouetteArea,
                         ::testing::Values(Placement{"middle", {0, 5, 0}, 0.5},
                                           Placement{"corner", {1.5, 3, 0.8}, 0.3},
                                           Placement{"large", {0.1, 2, 0.05}, 0.6},
                                           Placement{"four pixels", {0.3, 40, 0.2}, 0.21},
                                           Placement{"kilometres", {300, 2000, 100}, 250},
                                           Placement{"millimetres", {2e-4, 2e-3, 1e-4}, 2e-4}),
                         [](const auto& test) {
                             std::string name = test.param.name;
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name;
                         });

/// Against the same picture drawn eight times as large.
void expect_like_reference(const HandMadeScene& scene) {
    constexpr int kWidth = 320, kHeight = 180;
    testing::expect_good(testing::edge_errors(scene.paint(kWidth, kHeight),
                                              testing::reference_of(scene, kWidth, kHeight)),
                         "picture");
}

HandMadeScene floor_with_balls(LookStyle style, const Color& color, const Color& second) {
    HandMadeScene scene;
    scene.camera({0, -4, 1.2}, {0, 0, 0.5}, 32);
    const int floor = scene.look(LookStyle::kChecker, {0.9, 0.9, 0.88}, {0.82, 0.82, 0.82});
    scene.surface(PlaneShape{}, floor);
    const int look = scene.look(style, color, second);
    const Vec3 spin(1, 2, 3);  // painted at 0, where nothing has turned yet
    scene.ball({-1.0, 0, 0.3}, 0.3, look, spin);
    scene.ball({-0.2, 0, 0.6}, 0.15, look, spin);
    scene.ball({0.2, 0, 0.1}, 0.1, look, spin);
    scene.ball({0.5, 0, 0.5}, 0.05, look, spin);
    scene.ball({0.7, 0, 0.8}, 0.03, look, spin);
    scene.ball({0.9, 0, 0.3}, 0.026, look, spin);  // four pixels
    return scene;
}

TEST(EdgeQuality, PlainDarkBallsMatchSixtyFourSamples) {
    expect_like_reference(floor_with_balls(LookStyle::kPlain, {0.1, 0.1, 0.2}, {}));
}

TEST(EdgeQuality, PlainLightBallsMatchSixtyFourSamples) {
    expect_like_reference(floor_with_balls(LookStyle::kPlain, {0.95, 0.3, 0.2}, {}));
}

struct MarkedBall {
    const char* name;
    LookStyle style;
    Color color, second;
};

class MarkedEdgeQuality : public ::testing::TestWithParam<MarkedBall> {};

TEST_P(MarkedEdgeQuality, MatchesSixtyFourSamples) {
    const MarkedBall& ball = GetParam();
    expect_like_reference(floor_with_balls(ball.style, ball.color, ball.second));
}

const Color kWhite{0.95, 0.95, 0.93}, kDark{0.06, 0.06, 0.06}, kOrange{0.85, 0.4, 0.17};

INSTANTIATE_TEST_SUITE_P(
    Styles, MarkedEdgeQuality,
    ::testing::Values(MarkedBall{"striped", LookStyle::kStriped, {0.8, 0.1, 0.15}, kWhite},
                      MarkedBall{"basketball", LookStyle::kBasketball, kOrange, kDark},
                      MarkedBall{"volleyball", LookStyle::kVolleyball, kWhite, {0.14, 0.31, 0.61}},
                      MarkedBall{"football", LookStyle::kFootball, kWhite, kDark},
                      MarkedBall{"tennis", LookStyle::kTennis, {0.8, 0.88, 0.2}, kWhite},
                      MarkedBall{"table_tennis", LookStyle::kTableTennis, kWhite, {0.8, 0.1, 0.1}}),
    [](const auto& test) { return test.param.name; });

TEST(EdgeQuality, BodiesMatchSixtyFourSamples) {
    HandMadeScene scene;
    scene.camera({0.6, -4, 1.6}, {0, 0, 0.3}, 32);
    const int floor = scene.look(LookStyle::kGrid, {0.9, 0.9, 0.88}, {0.5, 0.55, 0.6});
    const int body = scene.look(LookStyle::kPlain, {0.3, 0.4, 0.5});
    scene.surface(PlaneShape{}, floor);
    const Quat turned(Eigen::AngleAxisd(0.5, Vec3(0.2, 0.3, 1).normalized()));
    scene.surface(BoxShape{{0.5, 0.3, 0.3}, {0.6, 0.5, 0.5}, turned}, body);
    scene.surface(BoxShape{{-0.8, 0.4, 0.6}, {0.9, 0.6, 0.01}, turned}, body);
    scene.surface(SphereShape{{1.2, 0.1, 0}, 0.3}, body);
    scene.surface(CapsuleShape{{-1.2, -0.5, 0.05}, {0.2, -0.9, 0.05}, 0.05}, body);
    scene.ball({0.3, 0.9, 0.35}, 0.3, scene.look(LookStyle::kPlain, {0.8, 0.2, 0.1}));
    expect_like_reference(scene);
}

TEST(EdgeQuality, RimsMatchSixtyFourSamples) {
    HandMadeScene scene;
    scene.camera({0.6, -4, 1.6}, {0, 0, 0.3}, 32);
    const int floor = scene.look(LookStyle::kGrid, {0.9, 0.9, 0.88}, {0.5, 0.55, 0.6});
    const int body = scene.look(LookStyle::kPlain, {0.3, 0.4, 0.5});
    scene.surface(PlaneShape{}, floor);
    scene.surface(CylinderShape{{0.5, 0.3, 0}, {0.5, 0.3, 0.6}, 0.3}, body);
    scene.surface(CylinderShape{{-0.9, 0.2, 0.3}, {-0.4, -0.3, 0.5}, 0.25}, body);
    scene.surface(CylinderShape{{1.3, 0, 0.5}, {1.3, 0.01, 0.52}, 0.3}, body);
    scene.surface(RingShape{{-0.2, -0.6, 0.3}, Vec3(0.3, -0.5, 0.8).normalized(), 0.3, 0.02}, body);
    scene.surface(RingShape{{-0.3, 0.6, 0.9}, Vec3(0.1, -0.9, 0.3).normalized(), 0.25, 0.1}, body);
    scene.ball({0.3, 0.9, 0.35}, 0.3, scene.look(LookStyle::kPlain, {0.8, 0.2, 0.1}));
    expect_like_reference(scene);
}

TEST(EdgeQuality, HollowBodiesMatchSixtyFourSamples) {
    HandMadeScene scene;
    scene.camera({0.6, -4, 1.6}, {0, 0, 0.3}, 32);
    const int floor = scene.look(LookStyle::kGrid, {0.9, 0.9, 0.88}, {0.5, 0.55, 0.6});
    const int body = scene.look(LookStyle::kPlain, {0.3, 0.4, 0.5});
    scene.surface(PlaneShape{}, floor);
    scene.surface(BowlShape{{0.6, 0, 0.4}, 0.4, Vec3(-0.2, -0.3, 0.9).normalized(), 0.35}, body);
    scene.surface(PipeShape{{-1.1, 0.3, 0.3}, {-0.2, -0.2, 0.4}, 0.25, Vec3::UnitZ(), 7}, body);
    scene.surface(
        PipeShape{{-0.8, 0.6, 0.9}, {0.6, 0.6, 1.0}, 0.15, Vec3(-0.1, 0, 1.4).normalized(), 3.2},
        body);
    scene.ball({0.6, 0, 0.2}, 0.1, scene.look(LookStyle::kPlain, {0.8, 0.2, 0.1}));
    expect_like_reference(scene);
}

TEST(ProjectedSphere, HasNoEllipseAroundTheEye) {
    Camera camera;
    camera.from = Vec3::Zero();
    camera.to = Vec3::UnitY();
    const View view(camera, 640, 360);
    EXPECT_TRUE(project_sphere({0, 0, 5}, 1, view).is_ellipse);
    EXPECT_FALSE(project_sphere({2, 0, 0.5}, 1, view).is_ellipse);
    EXPECT_FALSE(project_sphere({0, 0, -5}, 1, view).is_ellipse);
}

}  // namespace
}  // namespace carom
