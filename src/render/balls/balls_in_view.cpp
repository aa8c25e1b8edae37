#include "render/balls/balls_in_view.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

/// Nothing of the difference could be seen.
bool same_place(const BallState& a, const BallState& b, double radius) {
    constexpr double kUnseen = 1e-6;  // radii, and radians
    return (a.position - b.position).norm() < kUnseen * radius &&
           a.orientation.angularDistance(b.orientation) < kUnseen;
}

}  // namespace

Outline project_sphere(const Vec3& center, double radius, const View& view) {
    // Nearer than this to the eye's plane, in radii, the ellipse grows beyond all bounds.
    constexpr double kClearance = 1.02;
    Outline outline;
    if (view.orthographic()) {
        const double radius_px = radius * view.pixels_per_metre(center.z());
        return {true, view_pixel(view, center), Vec2(radius_px, 0), Vec2(0, radius_px)};
    }
    if (center.z() <= kClearance * radius) return outline;

    // The cone of tangents cuts the plane z = 1 in an ellipse whose major axis points away from the
    // view axis; with D = cz^2 - r^2: centre c.xy cz / D, semi-axes r sqrt(|c|^2 - r^2) / D and
    // r / sqrt(D).
    const double d = center.z() * center.z() - radius * radius;
    const double per_unit = 1.0 / pixel_width(view);
    const Vec2 off(center.x(), center.y());
    const double off_axis = off.norm();
    const Vec2 outward = off_axis > 0 ? Vec2(off / off_axis) : Vec2(1, 0);
    const Vec2 middle(0.5 * view.width_px(), 0.5 * view.height_px());
    outline.is_ellipse = true;
    outline.center = middle + off * (center.z() / d * per_unit);
    outline.major =
        outward * (radius * std::sqrt(center.squaredNorm() - radius * radius) / d * per_unit);
    outline.minor = Vec2(-outward.y(), outward.x()) * (radius / std::sqrt(d) * per_unit);
    return outline;
}

std::vector<BallInView> balls_at(double t, const Scene& scene, const Motion& motion,
                                 const View& view) {
    return balls_at(std::vector<double>{t}, scene, motion, view);
}

std::vector<BallInView> balls_at(const std::vector<double>& instants, const Scene& scene,
                                 const Motion& motion, const View& view) {
    CAROM_CHECK(scene.balls.size(), ==, motion.balls.size());
    Mat3 view_from_world;
    for (int axis = 0; axis < 3; ++axis)
        view_from_world.col(axis) = view_direction(view, Vec3::Unit(axis));

    std::vector<BallInView> balls;
    balls.reserve(instants.size() * scene.balls.size());
    for (std::size_t k = 0; k < instants.size(); ++k) {
        for (std::size_t i = 0; i < scene.balls.size(); ++i) {
            const BallState state = motion.balls[i].at(instants[k]);
            if (k + 1 < instants.size() &&
                same_place(state, motion.balls[i].at(instants[k + 1]), scene.balls[i].radius))
                continue;
            BallInView& ball = balls.emplace_back();
            ball.center = view_point(view, state.position);
            ball.radius = scene.balls[i].radius;
            const Mat3 world_from_ball = state.orientation.toRotationMatrix();
            ball.ball_from_view = world_from_ball.transpose() * view_from_world.transpose();
            ball.index = static_cast<int>(i);
            ball.look = scene.balls[i].look;
            ball.instant = static_cast<int>(k);
        }
    }
    sort_for_drawing(balls, view);
    return balls;
}

void sort_for_drawing(std::vector<BallInView>& balls, const View& view) {
    // Parallel rays are those of an eye at infinity, whose power goes with the depth alone.
    const auto power = [&](const BallInView& b) {
        return view.orthographic() ? b.center.z() : b.center.squaredNorm() - b.radius * b.radius;
    };
    std::stable_sort(balls.begin(), balls.end(),
                     [&](const BallInView& a, const BallInView& b) { return power(a) > power(b); });
}

PixelRect bounds_in_picture(const BallInView& ball, const View& view) {
    const PixelRect whole{0, 0, view.width_px(), view.height_px()};
    const Outline outline = project_sphere(ball.center, ball.radius, view);
    if (!outline.is_ellipse) return whole;
    const double x = std::hypot(outline.major.x(), outline.minor.x()) + 1;
    const double y = std::hypot(outline.major.y(), outline.minor.y()) + 1;
    const auto px = [](double at, int size) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    return {px(outline.center.x() - x, whole.right), px(outline.center.y() - y, whole.bottom),
            px(outline.center.x() + x + 1, whole.right),
            px(outline.center.y() + y + 1, whole.bottom)};
}

bool may_be_seen(const BallInView& ball, const View& view) {
    if (!ball.drawn) return false;
    const bool around_eye = !view.orthographic() && ball.center.norm() <= ball.radius;
    const bool behind = ball.center.z() + (view.orthographic() ? 0 : ball.radius) <= 0;
    if (around_eye || behind) return false;
    const Outline outline = project_sphere(ball.center, ball.radius, view);
    if (!outline.is_ellipse) return true;
    // Half extents of the ellipse along x and y, and a pixel for the soft edge.
    const double half_x = std::hypot(outline.major.x(), outline.minor.x()) + 1;
    const double half_y = std::hypot(outline.major.y(), outline.minor.y()) + 1;
    return outline.center.x() + half_x > 0 && outline.center.x() - half_x < view.width_px() &&
           outline.center.y() + half_y > 0 && outline.center.y() - half_y < view.height_px();
}

}  // namespace carom
