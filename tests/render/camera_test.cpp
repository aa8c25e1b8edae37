// The projection, and the camera that is framed around a motion.
#include "render/view/camera.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/view/framing.h"
#include "sample_motions.h"

namespace carom {
namespace {

using samples::Sample;

TEST(View, ProjectsTheAxesOfTheWorld) {
    Camera camera;
    camera.from = Vec3(1, -5, 2);
    camera.to = Vec3(1, 0, 2);
    camera.fov_deg = 90;
    const View view(camera, 800, 400);
    // tan(45 degrees) = 1: at depth 5 the picture is 10 m high, 40 px/m.
    EXPECT_NEAR(view.pixels_per_metre(5), 40, 1e-12);
    const auto middle = view.project(camera.to);
    EXPECT_NEAR(middle.x_px, 400, 1e-9);
    EXPECT_NEAR(middle.y_px, 200, 1e-9);
    EXPECT_NEAR(middle.depth_m, 5, 1e-12);
    const auto right_and_up = view.project(Vec3(2, 0, 4));
    EXPECT_NEAR(right_and_up.x_px, 440, 1e-9);
    EXPECT_NEAR(right_and_up.y_px, 120, 1e-9);
    EXPECT_LT(view.project(Vec3(1, -6, 2)).depth_m, 0);
}

TEST(View, AxesAreARightHandedFrame) {
    Camera camera;
    camera.from = Vec3(3, 1, 4);
    camera.to = Vec3(-1, 5, 0.5);
    const View view(camera, 64, 36);
    EXPECT_NEAR((view.right().cross(view.up()) + view.forward()).norm(), 0, 1e-14);
    EXPECT_NEAR(view.right().z(), 0, 1e-15);
    EXPECT_GT(view.up().z(), 0);
    EXPECT_NEAR(view.right().norm(), 1, 1e-14);
}

TEST(View, DegenerateCamerasStillHaveAxes) {
    for (const auto& [from, to] :
         {std::pair(Vec3(0, 0, 5), Vec3(0, 0, 0)), std::pair(Vec3(0, 0, 0), Vec3(0, 0, 7)),
          std::pair(Vec3(1, 2, 3), Vec3(1, 2, 3))}) {
        for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(0, 1, 0)}) {
            Camera camera;
            camera.from = from;
            camera.to = to;
            camera.up = up;
            const View view(camera, 64, 36);
            EXPECT_NEAR(view.right().norm(), 1, 1e-12);
            EXPECT_NEAR(view.up().norm(), 1, 1e-12);
            EXPECT_NEAR(view.forward().norm(), 1, 1e-12);
            EXPECT_NEAR(view.right().dot(view.forward()), 0, 1e-12);
        }
    }
}

TEST(ChooseCamera, KeepsTheScenesOwn) {
    Sample sample = samples::drop(1.8, 0.12, 4);
    sample.scene.camera = samples::pinhole(Vec3(1, 2, 3), Vec3(4, 5, 6), 55);
    const Camera camera = choose_camera(sample.scene, sample.motion, 16.0 / 9);
    EXPECT_EQ(camera.from, Vec3(1, 2, 3));
    EXPECT_EQ(camera.fov_deg, 55);
}

struct Framed {
    double least_margin = 1;  ///< of any ball's edge, in fractions of the picture
    double fill = 0;          ///< of the picture, by the balls' paths, in the fuller direction
};

Framed measure(const Sample& sample, double aspect, double until) {
    const int height = 720, width = static_cast<int>(std::lround(720 * aspect));
    const View view(choose_camera(sample.scene, sample.motion, aspect), width, height);
    Eigen::AlignedBox2d box;
    for (std::size_t b = 0; b < sample.scene.balls.size(); ++b) {
        for (int k = 0; k < 200; ++k) {
            const auto p = view.project(sample.motion.balls[b].at(until * k / 199).position);
            EXPECT_GT(p.depth_m, 0);
            const double r = sample.scene.balls[b].radius * view.pixels_per_metre(p.depth_m);
            box.extend(Vec2((p.x_px - r) / width, (p.y_px - r) / height));
            box.extend(Vec2((p.x_px + r) / width, (p.y_px + r) / height));
        }
    }
    Framed framed;
    framed.least_margin = std::min(box.min().minCoeff(), 1 - box.max().maxCoeff());
    framed.fill = box.sizes().maxCoeff();
    return framed;
}

Sample incline() {
    // 10 m down a plane of 20 degrees.
    Sample sample = samples::empty_floor(4);
    const double slope = 20 * std::numbers::pi / 180;
    const Vec3 normal(std::sin(slope), 0, std::cos(slope));
    sample.scene.surfaces[0].shape = PlaneShape{normal, 0};
    Piece piece;
    piece.position = Vec3(-5, 0, 5 * std::tan(slope)) + 0.1 * normal;
    piece.acceleration = 1.25 * Vec3(std::cos(slope), 0, -std::sin(slope));
    samples::add_ball(sample, "ball", 0.1, {piece});
    return sample;
}

Sample billiard() {
    Sample sample = samples::empty_floor(2);
    for (int i = 0; i < 4; ++i) {
        const double angle = 0.25 * std::numbers::pi * (2 * i + 1);
        samples::add_ball(
            sample, fmt::format("b{}", i), 0.03,
            {samples::straight(0, Vec3(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.03),
                               Vec3(std::cos(angle), std::sin(angle), 0))});
    }
    return sample;
}

Sample towards_the_viewer() {
    Sample sample = samples::empty_floor(4);
    samples::add_bouncing(sample, "ball", 0.1, Vec3(0, 3, 1), Vec3(0, -1.5, 0), 0.8);
    return sample;
}

class FramedMotion : public ::testing::TestWithParam<double> {};

TEST_P(FramedMotion, HoldsEveryBallAtEveryTime) {
    const double aspect = GetParam();
    const std::pair<const char*, Sample> cases[] = {
        {"drop of 1.8 m", samples::drop(1.8, 0.12, 4)},
        {"five balls", samples::five_balls()},
        {"incline of 10 m", incline()},
        {"ball of 1 mm", samples::drop(0.02, 0.0005, 0.5)},
        {"drop of 10 km", samples::drop(10000, 0.1, 80)},
        {"billiard", billiard()},
        {"towards the viewer", towards_the_viewer()},
        {"meeting", samples::meeting()},
    };
    for (auto [name, sample] : cases) {
        for (const bool ruler : {false, true}) {
            if (ruler) sample.scene.overlay.ruler = RulerOptions{};
            const Framed framed = measure(sample, aspect, sample.motion.duration);
            fmt::print("aspect {:.2f}, {}{}: margin {:.3f} (at least 0.055), fill {:.2f}\n", aspect,
                       name, ruler ? " with ruler" : "", framed.least_margin, framed.fill);
            EXPECT_GT(framed.least_margin, 0.055) << name;
            // An upright picture of a wide motion gives a good part of its width to the numbers.
            EXPECT_GT(framed.fill, ruler && aspect < 1.5 ? 0.45 : 0.6) << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Aspects, FramedMotion,
                         ::testing::Values(16.0 / 9, 4.0 / 3, 1.0, 9.0 / 16, 2.4));

TEST(ChooseCamera, LeavesRoomAtTheTopForTheClock) {
    const Sample sample = samples::drop(1.8, 0.12, 4);
    const View view(choose_camera(sample.scene, sample.motion, 16.0 / 9), 1280, 720);
    const double top = view.project(Vec3(0, 0, 2.04)).y_px, floor = view.project(Vec3::Zero()).y_px;
    fmt::print("top of the ball at {:.1f} px, floor at {:.1f} px of 720\n", top, floor);
    EXPECT_GT(top, 0.1 * 720);
    EXPECT_LT(top, 0.2 * 720);
    EXPECT_GT(floor, 0.8 * 720);
    EXPECT_LT(floor, 0.95 * 720);
}

TEST(ChooseCamera, StartsWithTheFilm) {
    Sample sample = samples::drop(20, 0.1, 24);
    const double whole = choose_camera(sample.scene, sample.motion, 1).from.norm();
    sample.scene.film.start = 20;  // only low hops are left
    const double late = choose_camera(sample.scene, sample.motion, 1).from.norm();
    fmt::print("distance {:.1f} m for all, {:.1f} m from 20 s on\n", whole, late);
    EXPECT_LT(late, 0.25 * whole);
}

TEST(ChooseCamera, BallsThatFlyAwayForeverDoNotShrinkTheRest) {
    // Two balls meet at 1 s without gravity and part for an hour and a half.
    Sample sample = samples::empty_floor(5000);
    sample.scene.surfaces.clear();
    for (const double side : {-1.0, 1.0})
        samples::add_ball(sample, side < 0 ? "a" : "b", 0.1,
                          {samples::straight(0, Vec3(2.1 * side, 0, 0), Vec3(-2 * side, 0, 0)),
                           samples::straight(1, Vec3(0.1 * side, 0, 0), Vec3(2 * side, 0, 0))});
    Event event;
    event.time = 1;
    event.ball = 0;
    event.other = {false, 1};
    sample.motion.events.push_back(event);

    const MotionExtent extent(sample.scene, sample.motion);
    const double width = extent.ball_box().sizes().x();
    fmt::print("held width {:.1f} m of {:.0f} m\n", width, 4.0 * 4999);
    EXPECT_GT(width, 2 * MotionExtent::kDepartureRadii * 0.1);
    EXPECT_LT(width, 3 * MotionExtent::kDepartureRadii * 0.1);
    const View view(choose_camera(sample.scene, sample.motion, 16.0 / 9), 1280, 720);
    EXPECT_GT(view.project(Vec3(-2.2, 0, 0)).x_px, 0);
    const double radius_px = 0.1 * view.pixels_per_metre(view.project(Vec3::Zero()).depth_m);
    fmt::print("radius at the collision {:.1f} px\n", radius_px);
    EXPECT_GT(radius_px, 2);
}

TEST(ChooseCamera, FlightWithoutEventsIsCutWhereABallIsAPixel) {
    Sample sample = samples::empty_floor(1e6);
    sample.scene.surfaces.clear();
    samples::add_ball(sample, "a", 0.1, {samples::straight(0, Vec3::Zero(), Vec3(10, 0, 0))});
    const Camera camera = choose_camera(sample.scene, sample.motion, 16.0 / 9);
    ASSERT_TRUE(camera.from.allFinite());
    const MotionExtent extent(sample.scene, sample.motion);
    EXPECT_NEAR(extent.ball_box().max().x(), MotionExtent::kFlightRadii * 0.1, 1);
}

TEST(ChooseCamera, OneBallAtRestDoesNotFillThePicture) {
    Sample sample = samples::empty_floor(1);
    samples::add_ball(sample, "a", 0.1, {samples::straight(0, Vec3(3, 1, 0.1), Vec3::Zero())});
    const Framed framed = measure(sample, 16.0 / 9, 1);
    fmt::print("a resting ball takes {:.2f} of the height\n", framed.fill);
    EXPECT_GT(framed.fill, 0.15);
    EXPECT_LT(framed.fill, 0.45);
}

TEST(ChooseCamera, StaysOnTheSideOfEveryPlane) {
    // A wall in front of the balls: the front is no place to look from.
    Sample sample = samples::five_balls();
    Surface wall;
    wall.shape = PlaneShape{Vec3(0, 1, 0), -1};
    sample.scene.surfaces.push_back(wall);
    const Camera camera = choose_camera(sample.scene, sample.motion, 16.0 / 9);
    EXPECT_GT(camera.from.y(), -1);
    EXPECT_GT(camera.from.z(), 0);
}

TEST(ChooseCamera, HoldsABoxNearTheBallsButNoEndlessSlab) {
    Sample sample = samples::drop(1.8, 0.12, 4);
    const double alone = choose_camera(sample.scene, sample.motion, 1).from.norm();
    Surface slab;
    slab.shape = BoxShape{Vec3(0, 0, -50), Vec3(1000, 1000, 100), Quat::Identity()};
    sample.scene.surfaces.push_back(slab);
    const double on_slab = choose_camera(sample.scene, sample.motion, 1).from.norm();
    Surface step;
    step.shape = BoxShape{Vec3(0.8, 0, 0.2), Vec3(0.4, 0.4, 0.4), Quat::Identity()};
    sample.scene.surfaces = {step};
    const View view(choose_camera(sample.scene, sample.motion, 1), 720, 720);
    const double edge = view.project(Vec3(1.0, 0, 0.2)).x_px;
    fmt::print("distance {:.2f} m, {:.2f} m on an endless slab; the step's edge at {:.0f} of 720\n",
               alone, on_slab, edge);
    EXPECT_LT(on_slab, 4 * alone);
    EXPECT_GT(edge, 360);
    EXPECT_LT(edge, 0.95 * 720);
}

TEST(MotionExtent, IsExactForAParabola) {
    Sample sample = samples::empty_floor(1);
    Piece piece;
    piece.position = Vec3(0, 0, 1);
    piece.velocity = Vec3(1, 0, 3);
    piece.acceleration = Vec3(0, 0, -9.81);
    samples::add_ball(sample, "a", 0.1, {piece});
    const MotionExtent extent(sample.scene, sample.motion);
    // The vertex lies v^2 / 2 g above the start.
    EXPECT_NEAR(extent.ball_box().max().z(), 1 + 9 / (2 * 9.81) + 0.1, 1e-12);
    EXPECT_NEAR(extent.highest_bottom(), 1 + 9 / (2 * 9.81) - 0.1, 1e-12);
    // In any direction: against 100,000 instants.
    const Vec3 n = Vec3(0.4, -0.3, 0.5);
    double sampled = -1e300;
    for (int k = 0; k <= 100000; ++k)
        sampled = std::max(sampled, n.dot(sample.motion.balls[0].at(k * 1e-5).position));
    EXPECT_NEAR(extent.upright_support(n, 1e9), sampled + 0.1 * n.norm(), 1e-9);
}

}  // namespace
}  // namespace carom
