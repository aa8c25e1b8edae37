#include "render/balls/surface_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/view/view_space.h"

namespace carom {

namespace {

constexpr double kReach = 3.0;  ///< radii within which a surface darkens a ball's near side

/// Orientations turn with the frame: a rotation that takes world axes to view axes.
Quat view_from_world(const View& view) {
    Mat3 m;
    for (int axis = 0; axis < 3; ++axis) m.col(axis) = view_direction(view, Vec3::Unit(axis));
    return Quat(m);
}

Vec3 nearest_point(const SurfaceShape& shape, const Vec3& p) {
    if (const auto* plane = std::get_if<PlaneShape>(&shape))
        return p - plane->normal * (plane->normal.dot(p) - plane->offset_m);
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        const Vec3 local = box->orientation.conjugate() * (p - box->center);
        const Vec3 half = 0.5 * box->size;
        return box->center + box->orientation * local.cwiseMax(-half).cwiseMin(half);
    }
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
        const Vec3 out = p - sphere->center;
        return sphere->center + out * (sphere->radius / std::max(out.norm(), 1e-300));
    }
    const auto& capsule = std::get<CapsuleShape>(shape);
    const Vec3 axis = capsule.to - capsule.from;
    const double length2 = std::max(axis.squaredNorm(), 1e-300);
    const double s = std::clamp((p - capsule.from).dot(axis) / length2, 0.0, 1.0);
    const Vec3 on_axis = capsule.from + s * axis;
    const Vec3 out = p - on_axis;
    return on_axis + out * (capsule.radius / std::max(out.norm(), 1e-300));
}

/// Does the ray from p along l meet the box?
bool meets_box(const BoxShape& box, const Vec3& p, const Vec3& l) {
    const Vec3 origin = box.orientation.conjugate() * (p - box.center);
    const Vec3 ray = box.orientation.conjugate() * l;
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * box.size[axis];
        if (std::abs(ray[axis]) < 1e-12) {
            if (std::abs(origin[axis]) > half) return false;
            continue;
        }
        const double a = (-half - origin[axis]) / ray[axis];
        const double b = (half - origin[axis]) / ray[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

/// Part of a disc of radius r that a disc-like obstacle of radius R hides, centres `across` apart:
/// a smooth ramp between apart (0) and one within the other (1).
double hidden_part(double across, double obstacle, double r) {
    const double x = std::clamp((obstacle + r - across) / (2 * r), 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

/// Distance between the ray p + s l, s >= 0, and the segment from a to b.
double ray_to_segment(const Vec3& p, const Vec3& l, const Vec3& a, const Vec3& b) {
    const Vec3 u = b - a, w = a - p;
    const double uu = u.squaredNorm(), ul = u.dot(l), det = uu - ul * ul;
    double s = det > 1e-12 * uu ? (ul * w.dot(l) - u.dot(w)) / det : 0.0;
    s = std::clamp(s, 0.0, 1.0);
    const Vec3 at = w + s * u;
    return (at - l * std::max(0.0, at.dot(l))).norm();
}

}  // namespace

SurfaceShade::SurfaceShade(const Scene& scene, const View& view, const Lights& lights)
    : to_light_(view_direction(view, lights.to_light)),
      side_(to_light_.unitOrthogonal()),
      side2_(to_light_.cross(side_)),
      tan_radius_(lights.tan_radius) {
    const Quat turn = view_from_world(view);
    for (const Surface& surface : scene.surfaces) {
        Body body{surface.shape, Vec3::Zero(), std::numeric_limits<double>::infinity()};
        if (auto* plane = std::get_if<PlaneShape>(&body.shape)) {
            plane->offset_m -= plane->normal.dot(view.eye());
            plane->normal = view_direction(view, plane->normal);
        } else if (auto* box = std::get_if<BoxShape>(&body.shape)) {
            body.center = box->center = view_point(view, box->center);
            box->orientation = turn * box->orientation;
            body.bound = 0.5 * box->size.norm();
        } else if (auto* sphere = std::get_if<SphereShape>(&body.shape)) {
            body.center = sphere->center = view_point(view, sphere->center);
            body.bound = sphere->radius;
        } else if (auto* capsule = std::get_if<CapsuleShape>(&body.shape)) {
            capsule->from = view_point(view, capsule->from);
            capsule->to = view_point(view, capsule->to);
            body.center = 0.5 * (capsule->from + capsule->to);
            body.bound = 0.5 * (capsule->to - capsule->from).norm() + capsule->radius;
        }
        bodies_.push_back(std::move(body));
    }
}

double SurfaceShade::key_past(const Body& body, const BallInView& ball) const {
    const Vec3 rel = body.center - ball.center;
    const double along = rel.dot(to_light_);
    // The penumbra at the ball widens the disc over which the obstacle is averaged.
    const double r = ball.radius + std::max(0.0, along) * tan_radius_;
    const double across = (rel - along * to_light_).norm();
    if (along < -body.bound || across > body.bound + r) return 1;

    if (const auto* sphere = std::get_if<SphereShape>(&body.shape))
        return along > 0 ? 1 - hidden_part(across, sphere->radius, r) : 1.0;
    if (const auto* capsule = std::get_if<CapsuleShape>(&body.shape))
        return 1 - hidden_part(ray_to_segment(ball.center, to_light_, capsule->from, capsule->to),
                               capsule->radius, r);
    // A box: parallel rays over the disc, on a sunflower spiral.
    const auto& box = std::get<BoxShape>(body.shape);
    constexpr int kRays = 48;
    constexpr double kGoldenTurn = 2.39996322972865332;
    int hidden = 0;
    for (int k = 0; k < kRays; ++k) {
        const double from_middle = r * std::sqrt((k + 0.5) / kRays);
        const Vec3 start = ball.center + from_middle * (std::cos(k * kGoldenTurn) * side_ +
                                                        std::sin(k * kGoldenTurn) * side2_);
        if (meets_box(box, start, to_light_)) ++hidden;
    }
    return 1 - static_cast<double>(hidden) / kRays;
}

BallShade SurfaceShade::on(const BallInView& ball) const {
    BallShade shade;
    for (const Body& body : bodies_) {
        const bool is_plane = std::holds_alternative<PlaneShape>(body.shape);
        const Vec3 to_body = body.center - ball.center;
        if (is_plane || to_body.norm() < body.bound + (1 + kReach) * ball.radius) {
            const Vec3 to = nearest_point(body.shape, ball.center) - ball.center;
            const double distance = to.norm();
            const double gap = std::max(0.0, distance / ball.radius - 1) / kReach;
            const double strength = gap < 1 ? (1 - gap) * (1 - gap) * (1 - gap) : 0.0;
            if (strength > shade.contact_strength && distance > 0) {
                shade.contact_strength = strength;
                shade.contact = to / distance;
            }
        }
        if (!is_plane) shade.key *= key_past(body, ball);
    }
    return shade;
}

}  // namespace carom
