#include "render/view/camera.h"

#include <cmath>
#include <numbers>

#include "core/check.h"
#include "render/view/framing.h"

namespace carom {

Camera choose_camera(const Scene& scene, const Motion& motion, double aspect) {
    return scene.camera ? *scene.camera : frame_motion(scene, motion, aspect);
}

namespace {

/// `v` as a unit vector, or `fallback` where it has no direction.
Vec3 unit_or(const Vec3& v, const Vec3& fallback) {
    const double length = v.norm();
    return length > 0 && std::isfinite(length) ? Vec3(v / length) : fallback;
}

}  // namespace

View::View(const Camera& camera, int width_px, int height_px)
    : eye_(camera.from),
      orthographic_(camera.orthographic_m.has_value()),
      width_px_(width_px),
      height_px_(height_px) {
    CAROM_CHECK(width_px, >, 0);
    CAROM_CHECK(height_px, >, 0);
    forward_ = unit_or(camera.to - camera.from, Vec3::UnitY());
    // Looking along `up` leaves the roll open: the world's y, else x, then points up the picture.
    Vec3 up = unit_or(camera.up, Vec3::UnitZ());
    constexpr double kParallel = 1e-6;  // sine of an angle below which the roll would be noise
    for (const Vec3& next : {Vec3(Vec3::UnitY()), Vec3(Vec3::UnitX())}) {
        if (forward_.cross(up).norm() > kParallel) break;
        up = next;
    }
    right_ = forward_.cross(up).normalized();
    up_ = right_.cross(forward_);
    constexpr double kHalfDegree = std::numbers::pi / 360;
    tan_half_fov_y_ = std::tan(camera.fov_deg * kHalfDegree);
    if (orthographic_) {
        metre_px_ = height_px_ / *camera.orthographic_m;
        tan_half_fov_y_ = 0.5 * *camera.orthographic_m / (camera.to - camera.from).norm();
    }
}

View::Projected View::project(const Vec3& world) const {
    const Vec3 from_eye = world - eye_;
    const double depth = from_eye.dot(forward_);
    const double scale = pixels_per_metre(depth);
    return {0.5 * width_px_ + scale * from_eye.dot(right_),
            0.5 * height_px_ - scale * from_eye.dot(up_), depth};
}

double View::pixels_per_metre(double depth_m) const {
    return orthographic_ ? metre_px_ : 0.5 * height_px_ / (tan_half_fov_y_ * depth_m);
}

}  // namespace carom
