#include "render/balls/surface_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/bounds.h"
#include "geometry/nearest.h"
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

/// Does the ray from p along l meet the body?
bool meets(const BoxShape& box, const Vec3& p, const Vec3& l) {
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

bool meets(const CylinderShape& cylinder, const Vec3& p, const Vec3& l) {
    const Vec3 whole = cylinder.to - cylinder.from, axis = whole.normalized();
    const Vec3 rel = 0.5 * (cylinder.from + cylinder.to) - p;
    const double z = axis.dot(rel), slope = axis.dot(l);
    const Vec3 across = rel - z * axis, ray = l - slope * axis;
    // Along the axis between the ends, and across it within the radius.
    const double half = 0.5 * whole.norm(), steep = std::max(std::abs(slope), 1e-12);
    const double rate = std::max(ray.squaredNorm(), 1e-24), middle = across.dot(ray) / rate;
    const double reach = cylinder.radius * cylinder.radius - (across - middle * ray).squaredNorm();
    if (reach <= 0) return false;
    const double side = std::sqrt(reach / rate), slab = half / steep;
    const double at = z / std::copysign(steep, slope);
    return std::max({middle - side, at - slab, 0.0}) < std::min(middle + side, at + slab);
}

/// Along the ray by its distance from the ring, which is how far it certainly does not meet it.
bool meets(const RingShape& ring, const Vec3& p, const Vec3& l) {
    constexpr int kMostSteps = 64;
    constexpr double kMet = 1e-3;  ///< of the tube: nearer counts as met
    const Vec3 rel = p - ring.center;
    const double around = ring.radius + ring.tube_radius, middle = -rel.dot(l);
    const double reach = around * around - (rel + middle * l).squaredNorm();
    if (reach <= 0) return false;
    const double end = middle + std::sqrt(reach);
    double s = std::max(middle - std::sqrt(reach), 0.0);
    for (int i = 0; i < kMostSteps && s < end; ++i) {
        const double gap = nearest_on(ring, p + s * l, 0).gap;
        if (gap < kMet * ring.tube_radius) return true;
        s += gap;
    }
    return false;
}

/// Does the ray from p along l, which is unit, meet the wall where `holds` says that it is one?
/// Both ways through its whole sphere or cylinder, seen across the axis, are looked at.
template <class Holds>
bool meets_wall(const Vec3& rel, const Vec3& l, double radius, const Holds& holds) {
    const double rate = l.squaredNorm();
    if (!(rate > 1e-24)) return false;
    const double middle = -rel.dot(l) / rate;
    const double reach = radius * radius - (rel + middle * l).squaredNorm();
    if (reach <= 0) return false;
    const double half = std::sqrt(reach / rate);
    return (middle - half > 0 && holds(middle - half)) ||
           (middle + half > 0 && holds(middle + half));
}

bool meets(const BowlShape& bowl, const Vec3& p, const Vec3& l) {
    const Vec3 rel = p - bowl.center;
    return meets_wall(rel, l, bowl.radius,
                      [&](double s) { return bowl.opening.dot(rel + s * l) <= bowl.rim_height(); });
}

bool meets(const PipeShape& pipe, const Vec3& p, const Vec3& l) {
    const Vec3 whole = pipe.to - pipe.from, axis = whole.normalized();
    const auto across = [&axis](const Vec3& v) -> Vec3 { return v - axis.dot(v) * axis; };
    const Vec3 rel = p - pipe.from;
    return meets_wall(across(rel), across(l), pipe.radius, [&](double s) {
        const Vec3 at = rel + s * l;
        const double along = axis.dot(at);
        if (along < 0 || along > whole.norm()) return false;
        return pipe.is_tube() || -pipe.opening.dot(at) >= pipe.radius * std::cos(0.5 * pipe.angle);
    });
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

/// The shape in view space; `turn` takes world axes to view axes.
SurfaceShape in_view(const PlaneShape& plane, const View& view, const Quat&) {
    return PlaneShape{view_direction(view, plane.normal),
                      plane.offset_m - plane.normal.dot(view.eye())};
}
SurfaceShape in_view(const BoxShape& box, const View& view, const Quat& turn) {
    return BoxShape{view_point(view, box.center), box.size, turn * box.orientation};
}
SurfaceShape in_view(const SphereShape& sphere, const View& view, const Quat&) {
    return SphereShape{view_point(view, sphere.center), sphere.radius};
}
SurfaceShape in_view(const CapsuleShape& c, const View& view, const Quat&) {
    return CapsuleShape{view_point(view, c.from), view_point(view, c.to), c.radius};
}
SurfaceShape in_view(const CylinderShape& c, const View& view, const Quat&) {
    return CylinderShape{view_point(view, c.from), view_point(view, c.to), c.radius};
}

SurfaceShape in_view(const RingShape& ring, const View& view, const Quat&) {
    return RingShape{view_point(view, ring.center), view_direction(view, ring.axis), ring.radius,
                     ring.tube_radius};
}

SurfaceShape in_view(const BowlShape& bowl, const View& view, const Quat&) {
    return BowlShape{view_point(view, bowl.center), bowl.radius, view_direction(view, bowl.opening),
                     bowl.depth};
}
SurfaceShape in_view(const PipeShape& pipe, const View& view, const Quat&) {
    return PipeShape{view_point(view, pipe.from), view_point(view, pipe.to), pipe.radius,
                     view_direction(view, pipe.opening), pipe.angle};
}

/// A ball in the light of the lamp, past a body whose middle is at `along` towards the lamp and at
/// `across` from the line to it.
struct InLight {
    const BallInView& ball;
    const Vec3 &to_light, &side, &side2;
    double along, across;
    double radius;  ///< of the disc over which what hides the lamp is averaged
};

/// Parallel rays over the disc, on a sunflower spiral.
template <class Shape>
double hidden_of_rays(const Shape& shape, const InLight& at) {
    constexpr int kRays = 48;
    constexpr double kGoldenTurn = 2.39996322972865332;
    int hidden = 0;
    for (int k = 0; k < kRays; ++k) {
        const double from_middle = at.radius * std::sqrt((k + 0.5) / kRays);
        const Vec3 start = at.ball.center + from_middle * (std::cos(k * kGoldenTurn) * at.side +
                                                           std::sin(k * kGoldenTurn) * at.side2);
        if (meets(shape, start, at.to_light)) ++hidden;
    }
    return static_cast<double>(hidden) / kRays;
}

/// The part of the lamp that the body hides. Planes hide nothing: see surface_light.glsl.
double hidden_by(const PlaneShape&, const InLight&) { return 0; }
double hidden_by(const BoxShape& box, const InLight& at) { return hidden_of_rays(box, at); }
double hidden_by(const SphereShape& sphere, const InLight& at) {
    return at.along > 0 ? hidden_part(at.across, sphere.radius, at.radius) : 0.0;
}
double hidden_by(const CapsuleShape& capsule, const InLight& at) {
    return hidden_part(ray_to_segment(at.ball.center, at.to_light, capsule.from, capsule.to),
                       capsule.radius, at.radius);
}
double hidden_by(const CylinderShape& cylinder, const InLight& at) {
    return hidden_of_rays(cylinder, at);
}
double hidden_by(const RingShape& ring, const InLight& at) { return hidden_of_rays(ring, at); }
double hidden_by(const BowlShape& bowl, const InLight& at) { return hidden_of_rays(bowl, at); }
double hidden_by(const PipeShape& pipe, const InLight& at) { return hidden_of_rays(pipe, at); }

}  // namespace

SurfaceShade::SurfaceShade(const Scene& scene, const View& view, const Lights& lights)
    : to_light_(view_direction(view, lights.to_light)),
      side_(to_light_.unitOrthogonal()),
      side2_(to_light_.cross(side_)),
      tan_radius_(lights.tan_radius) {
    const Quat turn = view_from_world(view);
    for (const Surface& surface : scene.surfaces) {
        Body body;
        body.shape = std::visit([&](const auto& shape) { return in_view(shape, view, turn); },
                                surface.shape);
        const SphereAround around = sphere_around(body.shape);
        body.center = around.center;
        body.bound = around.radius;
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

    const InLight at{ball, to_light_, side_, side2_, along, across, r};
    return 1 - std::visit([&](const auto& shape) { return hidden_by(shape, at); }, body.shape);
}

BallShade SurfaceShade::on(const BallInView& ball) const {
    BallShade shade;
    for (const Body& body : bodies_) {
        const bool is_plane = is_unbounded(body.shape);
        const Vec3 to_body = body.center - ball.center;
        if (is_plane || to_body.norm() < body.bound + (1 + kReach) * ball.radius) {
            const Vec3 to = nearest_on(body.shape, ball.center, 0).point - ball.center;
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
