// What a scene may say about its camera, and the messages for what it may not.
#include <cmath>

#include "scene_testing.h"

namespace carom {
namespace {

Camera camera_of(const std::string& keys) {
    return *scene_of("carom: 1\nballs: [{name: a, radius: 0.1, position: [0, 0, 1]}]\ncamera: {" +
                     keys + "}")
                .camera;
}

std::string camera_errors(const std::string& keys) {
    return errors_of("carom: 1\ncamera: {" + keys + "}");
}

TEST(SceneCamera, FocalLengthIsThatOf35MillimetreFilm) {
    // 24 mm of film behind 12 mm of focal length: 45 degrees to either side.
    EXPECT_NEAR(camera_of("from: [0, -6, 1], to: [0, 0, 1], focal_mm: 12").fov_deg, 90, 1e-12);
    EXPECT_NEAR(camera_of("from: [0, -6, 1], to: [0, 0, 1], focal_mm: 50").fov_deg, 26.9915, 1e-4);
}

TEST(SceneCamera, ParallelRays) {
    EXPECT_EQ(camera_of("from: [0, -6, 1], to: [0, 0, 1], orthographic: 2.5").orthographic_m, 2.5);
    EXPECT_FALSE(camera_of("from: [0, -6, 1], to: [0, 0, 1]").orthographic_m);
}

TEST(SceneCamera, Moves) {
    const Camera follows =
        camera_of("from: [0, -6, 1], to: [0, 0, 1], follow: a, smooth_s: 0.5, orbit_deg_per_s: 10");
    EXPECT_EQ(follows.follow, 0);
    EXPECT_EQ(follows.smooth_s, 0.5);
    EXPECT_EQ(follows.orbit_deg_per_s, 10);
    const Camera path = camera_of(
        "fov_deg: 30, path: [{time: 0, from: [0, -6, 1], to: [0, 0, 1]}, "
        "{time: 2, from: [0, -3, 1], to: [0, 0, 2], fov_deg: 20}]");
    ASSERT_EQ(path.path.size(), 2U);
    EXPECT_EQ(path.path[0].fov_deg, 30);
    EXPECT_EQ(path.path[1].fov_deg, 20);
    EXPECT_EQ(path.path[1].to, Vec3(0, 0, 2));
    EXPECT_EQ(path.from, Vec3(0, -6, 1));
}

TEST(SceneCamera, WrongOnesAreRefused) {
    const std::string still = "from: [0, -6, 1], to: [0, 0, 1], ";
    EXPECT_NE(camera_errors(still + "fov_deg: 30, focal_mm: 50"), "");
    EXPECT_NE(camera_errors(still + "focal_mm: 50, orthographic: 2"), "");
    EXPECT_NE(camera_errors("from: [0, -6, 1]"), "");
    EXPECT_NE(camera_errors(still + "path: [{time: 0, from: [0, -6, 1], to: [0, 0, 1]}]"), "");
    EXPECT_EQ(camera_errors(still + "follow: nobody"),
              "t.yaml:2:51: error: there is no ball 'nobody'\n");
    EXPECT_EQ(camera_errors(still + "smooth_s: 1"),
              "t.yaml:2:53: error: 'smooth_s' smooths what 'follow' follows, which is not given\n");
    EXPECT_EQ(camera_errors("path: []"), "t.yaml:2:16: error: the camera's path has no entries\n");
    EXPECT_EQ(camera_errors("path: [{time: 1, from: [0, -6, 1], to: [0, 0, 1]}, "
                            "{time: 1, from: [0, -6, 1], to: [0, 0, 1]}]"),
              "t.yaml:2:68: error: the times of a camera's path must increase\n");
}

}  // namespace
}  // namespace carom
