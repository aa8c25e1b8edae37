#include "render/balls/balls_in_view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

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

Mat3 rotation_of(const View& view) {
    Mat3 view_from_world;
    for (int axis = 0; axis < 3; ++axis)
        view_from_world.col(axis) = view_direction(view, Vec3::Unit(axis));
    return view_from_world;
}

BallInView seen(const BallState& state, const Scene& scene, std::size_t i,
                const Mat3& view_from_world, const View& view) {
    BallInView ball;
    ball.center = view_point(view, state.position);
    ball.radius = scene.balls[i].radius;
    const Mat3 world_from_ball = state.orientation.toRotationMatrix();
    ball.ball_from_view = world_from_ball.transpose() * view_from_world.transpose();
    ball.index = static_cast<int>(i);
    ball.look = scene.balls[i].look;
    return ball;
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

std::optional<PictureBound> bound_of(const BallInView& ball, const View& view) {
    PictureBound bound{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Vec3& at : {swept_from(ball), swept_to(ball)}) {
        const Outline outline = project_sphere(at, ball.radius, view);
        if (!outline.is_ellipse) return std::nullopt;
        // Half extents of the ellipse along x and y, and a pixel for the soft edge.
        const double x = std::hypot(outline.major.x(), outline.minor.x()) + 1;
        const double y = std::hypot(outline.major.y(), outline.minor.y()) + 1;
        bound.left = std::min(bound.left, outline.center.x() - x);
        bound.top = std::min(bound.top, outline.center.y() - y);
        bound.right = std::max(bound.right, outline.center.x() + x);
        bound.bottom = std::max(bound.bottom, outline.center.y() + y);
        if (!ball.swept) break;
    }
    return bound;
}

std::vector<BallInView> balls_at(double t, const Scene& scene, const Motion& motion,
                                 const View& view) {
    return balls_at(std::vector<double>{t}, scene, motion, view);
}

std::vector<BallInView> balls_at(const std::vector<double>& instants, const Scene& scene,
                                 const Motion& motion, const View& view) {
    CAROM_CHECK(scene.balls.size(), ==, motion.balls.size());
    const Mat3 view_from_world = rotation_of(view);
    std::vector<BallInView> balls;
    balls.reserve(instants.size() * scene.balls.size());
    for (std::size_t k = 0; k < instants.size(); ++k) {
        for (std::size_t i = 0; i < scene.balls.size(); ++i) {
            const BallState state = motion.balls[i].at(instants[k]);
            if (k + 1 < instants.size() &&
                same_place(state, motion.balls[i].at(instants[k + 1]), scene.balls[i].radius))
                continue;
            BallInView& ball = balls.emplace_back(seen(state, scene, i, view_from_world, view));
            ball.instant = static_cast<int>(k);
        }
    }
    sort_for_drawing(balls, view);
    return balls;
}

std::vector<BallInView> balls_during(const OpenTime& open, const Scene& scene, const Motion& motion,
                                     const View& view) {
    CAROM_CHECK(scene.balls.size(), ==, motion.balls.size());
    const Mat3 view_from_world = rotation_of(view);
    std::vector<BallInView> balls;
    balls.reserve(scene.balls.size());
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Trajectory& path = motion.balls[i];
        const BallState middle = path.at(open.middle);
        const Vec3 from = path.at(open.begin).position, to = path.at(open.end).position;
        BallState mean = middle;
        // Of a parabola the mean lies two thirds of the way from the chord to its apex.
        mean.position = (from + to + 4 * middle.position) / 6;
        BallInView& ball = balls.emplace_back(seen(mean, scene, i, view_from_world, view));
        ball.sweep = view_from_world * (to - from);
        ball.turn = view_from_world * (middle.spin * (open.end - open.begin));
        constexpr double kUnseen = 1e-6;  // radii, and radians
        ball.swept = ball.sweep.norm() > kUnseen * ball.radius || ball.turn.norm() > kUnseen;
        if (!ball.swept) ball.sweep = ball.turn = Vec3::Zero();
    }
    sort_for_drawing(balls, view);
    return balls;
}

double bends_px(const OpenTime& open, const Motion& motion, const View& view,
                const std::vector<bool>& counts, std::size_t first) {
    double most = 0;
    for (std::size_t i = 0; i < motion.balls.size(); ++i) {
        if (!counts[first + i]) continue;
        const Trajectory& path = motion.balls[i];
        const Vec3 middle = path.at(open.middle).position;
        const Vec3 off = middle - 0.5 * (path.at(open.begin).position + path.at(open.end).position);
        const double depth = (middle - view.eye()).dot(view.forward());
        if (depth > 0) most = std::max(most, off.norm() * view.pixels_per_metre(depth));
    }
    return most;
}

Vec3 swept_from(const BallInView& ball) { return ball.center - 0.5 * ball.sweep; }
Vec3 swept_to(const BallInView& ball) { return ball.center + 0.5 * ball.sweep; }

void sort_for_drawing(std::vector<BallInView>& balls, const View& view) {
    // Parallel rays are those of an eye at infinity, whose power goes with the depth alone.
    const auto power = [&](const BallInView& b) {
        return view.orthographic() ? b.center.z() : b.center.squaredNorm() - b.radius * b.radius;
    };
    // Numbers are sorted, and each ball is moved once.
    std::vector<std::pair<double, std::size_t>> order;
    order.reserve(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) order.emplace_back(power(balls[i]), i);
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    std::vector<BallInView> sorted;
    sorted.reserve(balls.size());
    for (const auto& [of_ball, i] : order) sorted.push_back(balls[i]);
    balls = std::move(sorted);
}

PixelRect bounds_in_picture(const BallInView& ball, const View& view) {
    const PixelRect whole{0, 0, view.width_px(), view.height_px()};
    const std::optional<PictureBound> bound = bound_of(ball, view);
    if (!bound) return whole;
    const auto px = [](double at, int size) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    return {px(bound->left, whole.right), px(bound->top, whole.bottom),
            px(bound->right + 1, whole.right), px(bound->bottom + 1, whole.bottom)};
}

bool may_be_seen(const BallInView& ball, const View& view) {
    if (!ball.drawn) return false;
    const bool around_eye = !view.orthographic() && ball.center.norm() <= ball.radius;
    const double depth = std::max(swept_from(ball).z(), swept_to(ball).z());
    const bool behind = depth + (view.orthographic() ? 0 : ball.radius) <= 0;
    if (around_eye || behind) return false;
    const std::optional<PictureBound> bound = bound_of(ball, view);
    return !bound || (bound->right > 0 && bound->left < view.width_px() && bound->bottom > 0 &&
                      bound->top < view.height_px());
}

}  // namespace carom
