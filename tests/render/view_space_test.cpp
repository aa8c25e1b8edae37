// View space: the same places as the camera's own, and the light that comes with a view.
#include "render/view/view_space.h"

#include <gtest/gtest.h>

#include <random>

#include "render/view/lights.h"
#include "sample_views.h"

namespace carom {
namespace {

TEST(ViewSpace, SeesPointsWhereTheCameraDoes) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-2, 2);
    for (const bool orthographic : {false, true}) {
        Camera camera = samples::pinhole(Vec3(1, -9, 4), Vec3(0.5, 0, 1), 35);
        if (orthographic) camera.orthographic_m = 4;
        const View view(camera, 640, 360);
        for (int i = 0; i < 100; ++i) {
            const Vec3 world(place(random), place(random), place(random));
            const Vec3 seen = view_point(view, world);
            const View::Projected expected = view.project(world);
            EXPECT_NEAR(expected.depth_m, seen.z(), 1e-12);
            const Vec2 px = view_pixel(view, seen);
            EXPECT_NEAR(expected.x_px, px.x(), 1e-9);
            EXPECT_NEAR(expected.y_px, px.y(), 1e-9);
        }
    }
}

TEST(ViewSpace, APixelIsAsWideAsItSays) {
    const View view(samples::pinhole(Vec3(0, -5, 0), Vec3(0, 0, 0), 30), 640, 360);
    // At a depth of one metre a step of that width moves the picture by one pixel.
    const Vec2 middle = view_pixel(view, {0, 0, 1});
    const Vec2 beside = view_pixel(view, {pixel_width(view), 0, 1});
    EXPECT_NEAR(1, beside.x() - middle.x(), 1e-12);
}

TEST(ViewSpace, IsExactFarFromTheOrigin) {
    const Vec3 far(1e7, -1e7, 0);
    const View view(samples::pinhole(far + Vec3(0, -5, 1), far + Vec3(0, 0, 1), 30), 640, 360);
    const Vec3 seen = view_point(view, far + Vec3(0.25, 0, 1));
    EXPECT_NEAR(0.25, seen.x(), 1e-8);
    EXPECT_NEAR(0, seen.y(), 1e-8);
    EXPECT_NEAR(5, seen.z(), 1e-8);
}

// The lamp goes round with the camera's heading and stays above the floor.
TEST(Lights, ComeFromTheUpperLeft) {
    for (const Vec3& from : {Vec3(0, -6, 1), Vec3(6, 0, 1), Vec3(-3, 4, 2), Vec3(0, 0, 9)}) {
        const View view(samples::pinhole(from, Vec3(0, 0, 0.5), 30), 640, 360);
        const Lights lights = choose_lights(view);
        EXPECT_NEAR(1, lights.to_light.norm(), 1e-12);
        EXPECT_GT(lights.to_light.z(), 0.5);
        EXPECT_LT(view_direction(view, lights.to_light).x(), -0.2);
    }
}

}  // namespace
}  // namespace carom
