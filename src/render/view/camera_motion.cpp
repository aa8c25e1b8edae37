#include "render/view/camera_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

constexpr int kNumbers = 7;  // of a key: from, to, fov_deg
using KeyNumbers = std::array<double, kNumbers>;

KeyNumbers numbers_of(const CameraKey& key) {
    return {key.from.x(), key.from.y(), key.from.z(), key.to.x(),
            key.to.y(),   key.to.z(),   key.fov_deg};
}

/// Steffen's slope at the key between two intervals h with slopes s, eq. 11 of his paper.
double steffen_slope(double h0, double s0, double h1, double s1) {
    if (s0 * s1 <= 0) return 0;
    const double parabola = std::abs(s0 * h1 + s1 * h0) / (h0 + h1);
    return std::copysign(2 * std::min({std::abs(s0), std::abs(s1), 0.5 * parabola}), s0);
}

/// Coordinate k of the path at t, between the keys i and i + 1.
double on_path(const std::vector<CameraKey>& path, std::size_t i, std::size_t k, double t) {
    const auto value = [&](std::size_t key) { return numbers_of(path[key])[k]; };
    const auto h = [&](std::size_t from) { return path[from + 1].time - path[from].time; };
    const auto s = [&](std::size_t from) { return (value(from + 1) - value(from)) / h(from); };
    const auto slope = [&](std::size_t key) {
        if (key == 0 || key + 1 == path.size()) return 0.0;
        return steffen_slope(h(key - 1), s(key - 1), h(key), s(key));
    };
    // Hermite's cubic over the interval.
    const double u = (t - path[i].time) / h(i), m0 = h(i) * slope(i), m1 = h(i) * slope(i + 1);
    const double step = u * u * (3 - 2 * u);
    return value(i) + step * (value(i + 1) - value(i)) + u * (1 - u) * ((1 - u) * m0 - u * m1);
}

Camera along_path(Camera camera, double t) {
    const std::vector<CameraKey>& path = camera.path;
    KeyNumbers at = numbers_of(t < path.front().time ? path.front() : path.back());
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
        if (path[i].time <= t && t < path[i + 1].time)
            for (std::size_t k = 0; k < at.size(); ++k) at[k] = on_path(path, i, k, t);
    camera.from = Vec3(at[0], at[1], at[2]);
    camera.to = Vec3(at[3], at[4], at[5]);
    camera.fov_deg = at[6];
    return camera;
}

/// The ball's centre; the mean of `smooth_s` around t is a sum over fixed fractions of that time.
Vec3 followed_point(const Trajectory& ball, double duration, double smooth_s, double t) {
    const auto at = [&](double time) { return ball.at(std::clamp(time, 0.0, duration)).position; };
    if (smooth_s <= 0) return at(t);
    constexpr int kPoints = 64;
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double x = (2.0 * i + 1) / kPoints - 1;  // -1 ... 1
        const double weight = 1 + std::cos(std::numbers::pi * x);
        sum += weight * at(t + 0.5 * smooth_s * x);
        weights += weight;
    }
    return sum / weights;
}

}  // namespace

bool camera_moves(const Camera& camera) {
    return camera.follow || camera.orbit_deg_per_s != 0 || !camera.path.empty();
}

Camera camera_at(const Camera& camera, const Motion& motion, double t) {
    Camera now = camera;
    if (!camera.path.empty()) now = along_path(camera, t);
    Vec3 offset = camera.from - camera.to;
    if (camera.orbit_deg_per_s != 0) {
        const double turn = camera.orbit_deg_per_s * t * std::numbers::pi / 180;
        const Eigen::AngleAxisd rotation(turn, Vec3::UnitZ());
        offset = rotation * offset;
        now.up = rotation * camera.up;
    }
    if (camera.follow)
        now.to = followed_point(motion.balls.at(static_cast<std::size_t>(*camera.follow)),
                                motion.duration, camera.smooth_s, t);
    if (camera.path.empty()) now.from = now.to + offset;
    now.follow.reset();
    now.orbit_deg_per_s = 0;
    now.path.clear();
    return now;
}

}  // namespace carom
