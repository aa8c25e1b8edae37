// Cameras that move: the view at an instant against closed forms, and the same picture whatever
// was drawn before.
#include "render/view/camera_motion.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hand_made_scene.h"

namespace carom {
namespace {

using testing::HandMadeScene;

HandMadeScene flying_ball() {
    HandMadeScene scene;
    scene.camera({0, -4, 1.5}, {0, 0, 0.5}, 36);
    scene.surface(PlaneShape{}, scene.look(LookStyle::kChecker, {0.9, 0.9, 0.9}, {0.6, 0.6, 0.6}));
    scene.ball({0, 0, 0.5}, 0.2, scene.look(LookStyle::kStriped, {0.8, 0.1, 0.1}, {1, 1, 1}),
               Vec3::Zero(), {1, 0, 0});
    return scene;
}

TEST(CameraMotion, ACameraThatStandsStillIsLeftAlone) {
    const HandMadeScene scene = flying_ball();
    EXPECT_FALSE(camera_moves(*scene.scene.camera));
    EXPECT_EQ(camera_at(*scene.scene.camera, scene.motion, 3).from, Vec3(0, -4, 1.5));
}

TEST(CameraMotion, FollowKeepsTheOffset) {
    HandMadeScene scene = flying_ball();
    Camera& camera = *scene.scene.camera;
    camera.follow = 0;
    ASSERT_TRUE(camera_moves(camera));
    for (const double smooth : {0.0, 0.8}) {  // the mean of a straight path is the path
        camera.smooth_s = smooth;
        const Camera at = camera_at(camera, scene.motion, 2);
        EXPECT_NEAR((at.to - Vec3(2, 0, 0.5)).norm(), 0, 1e-12);
        EXPECT_NEAR((at.from - Vec3(2, -4, 1.5)).norm(), 0, 1e-12);
        EXPECT_FALSE(camera_moves(at));
    }
}

TEST(CameraMotion, OrbitTurnsAboutTheUpright) {
    HandMadeScene scene = flying_ball();
    Camera& camera = *scene.scene.camera;
    camera.orbit_deg_per_s = 30;
    const Camera at = camera_at(camera, scene.motion, 3);  // a quarter, anticlockwise from above
    EXPECT_NEAR((at.from - Vec3(4, 0, 1.5)).norm(), 0, 1e-12);
    EXPECT_EQ(at.to, camera.to);
}

TEST(CameraMotion, APathIsSmoothAndMeetsItsKeys) {
    HandMadeScene scene = flying_ball();
    Camera& camera = *scene.scene.camera;
    camera.path = {{1, {0, -4, 1}, {0, 0, 1}, 40},
                   {2, {1, -4, 2}, {0, 0, 1}, 30},
                   {4, {5, -2, 2}, {1, 0, 1}, 20}};
    const auto x = [&](double t) { return camera_at(camera, scene.motion, t).from.x(); };
    for (const CameraKey& key : camera.path) {
        const Camera at = camera_at(camera, scene.motion, key.time);
        EXPECT_NEAR((at.from - key.from).norm(), 0, 1e-12);
        EXPECT_NEAR((at.to - key.to).norm(), 0, 1e-12);
        EXPECT_NEAR(at.fov_deg, key.fov_deg, 1e-12);
    }
    EXPECT_EQ(x(0), 0);
    EXPECT_EQ(x(9), 5);
    // Slopes of 1 and 2 over 1 and 2 s: the parabola's is 4/3 at the key, below twice the smaller.
    const double h = 1e-5;
    double worst = 0, most_back = 0;
    EXPECT_NEAR((x(2 + h) - x(2 - h)) / (2 * h), 4.0 / 3, 1e-4);
    for (double t = 0.5; t < 4.5; t += 1e-3) {
        const double left = (x(t) - x(t - h)) / h, right = (x(t + h) - x(t)) / h;
        worst = std::max(worst, std::abs(right - left));
        most_back = std::min(most_back, right);
        EXPECT_LE(camera_at(camera, scene.motion, t).from.z(), 2 + 1e-12) << "overshoots";
    }
    fmt::print("largest jump of the slope {:.1e} (at most 1e-3), least slope {:.1e}\n", worst,
               most_back);
    EXPECT_LT(worst, 1e-3);
    EXPECT_GE(most_back, -1e-9);
}

TEST(CameraMotion, AFrameOfAMovingCameraIsTheStillFromThere) {
    HandMadeScene scene = flying_ball();
    BoxShape box;
    box.center = Vec3(1.2, 0.4, 0.2);
    box.size = Vec3(0.3, 0.3, 0.4);
    scene.surface(box);
    scene.scene.overlay.trail = TrailOptions{};
    scene.scene.camera->orbit_deg_per_s = 40;
    scene.scene.camera->follow = 0;
    const HandMadeScene moving = scene;
    Painter painter(moving.scene, moving.motion, PainterOptions{320, 180});
    Image first, later, again;
    painter.paint(0, first);
    painter.paint(1.5, later);
    painter.paint(0, again);
    EXPECT_EQ(first.bgra, again.bgra) << "depends on what was drawn before";
    EXPECT_GT(compare_images(first, later).differing, 5000U);
    const Image fresh = moving.paint(320, 180, 1.5);
    EXPECT_EQ(fresh.bgra, later.bgra);

    // The ball stays in the middle of the picture.
    const std::uint8_t* middle = later.row(90) + 4 * 160;
    const std::uint8_t* middle_first = first.row(90) + 4 * 160;
    EXPECT_GT(middle_first[2] + middle[2], middle_first[0] + middle[0]);
}

}  // namespace
}  // namespace carom
