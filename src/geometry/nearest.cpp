#include "geometry/nearest.h"

#include <algorithm>

#include "geometry/around_axis.h"

namespace carom {

namespace {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    return a + std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) * d;
}

/// Of all points within `round` of a core, of which `core` is the nearest to the centre.
Nearest nearest_around(const Vec3& core, double round, const Vec3& center, double radius) {
    const Vec3 d = center - core;
    const double distance = d.norm();
    const Vec3 normal = distance > 0 ? Vec3(d / distance) : Vec3::UnitZ();
    return {distance - radius - round, normal, core + round * normal};
}

/// Of all points within `round` of a circle.
Nearest nearest_on_circle(const Vec3& middle, const Vec3& axis, double core_radius, double round,
                          const Vec3& center, double radius) {
    const AroundAxis at(middle, axis, center);
    if (at.away > kCentred * core_radius || radius + round <= core_radius)
        return nearest_around(middle + core_radius * at.outward, round, center, radius);
    const double gap = std::hypot(core_radius, at.along) - radius - round;
    const Vec3 normal = at.along < 0 ? Vec3(-axis) : axis;
    return {gap, normal, center - (gap + radius) * normal};
}

/// Of a round wall at `wall` [m] from `core`, from which the ball's centre lies at `from_core`;
/// where that is 0, the wall is met in the direction `else_out`.
Nearest nearest_on_wall(const Vec3& core, double wall, const Vec3& from_core, const Vec3& else_out,
                        double radius) {
    const double away = from_core.norm();
    const Vec3 out = away > 0 ? Vec3(from_core / away) : else_out;
    const bool inside = away < wall;
    return {(inside ? wall - away : away - wall) - radius, inside ? Vec3(-out) : out,
            core + wall * out};
}

}  // namespace

Nearest nearest_on(const PlaneShape& plane, const Vec3& center, double radius) {
    const double height = plane.normal.dot(center) - plane.offset_m;
    return {height - radius, plane.normal, center - height * plane.normal};
}

Nearest nearest_on(const BoxShape& box, const Vec3& center, double radius) {
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    const Vec3 half = 0.5 * box.size;
    const Vec3 local = world_from_box.transpose() * (center - box.center);
    Vec3 nearest = local.cwiseMax(-half).cwiseMin(half);
    Vec3 away = local - nearest;
    double distance = away.norm();
    if (distance == 0) {  // inside: out through the nearest face
        int axis = 0;
        (half - local.cwiseAbs()).minCoeff(&axis);
        const double side = local[axis] < 0 ? -1 : 1;
        distance = std::abs(local[axis]) - half[axis];
        away = side * Vec3::Unit(axis);
        nearest[axis] = side * half[axis];
    } else {
        away /= distance;
    }
    return {distance - radius, world_from_box * away, box.center + world_from_box * nearest};
}

Nearest nearest_on(const SphereShape& sphere, const Vec3& center, double radius) {
    return nearest_around(sphere.center, sphere.radius, center, radius);
}

Nearest nearest_on(const CapsuleShape& capsule, const Vec3& center, double radius) {
    const Vec3 core = nearest_on_segment(center, capsule.from, capsule.to);
    return nearest_around(core, capsule.radius, center, radius);
}

Nearest nearest_on(const CylinderShape& cylinder, const Vec3& center, double radius) {
    const Vec3 whole = cylinder.to - cylinder.from;
    const double half = 0.5 * whole.norm();
    const Vec3 axis = whole / (2 * half);
    const AroundAxis at(0.5 * (cylinder.from + cylinder.to), axis, center);
    const double side = at.along < 0 ? -1 : 1;
    const double beyond = side * at.along - half, out = at.away - cylinder.radius;
    double distance = 0;
    Vec3 normal;
    if (out <= 0 && beyond > out) {  // an end, also from within
        distance = beyond;
        normal = side * axis;
    } else if (beyond <= 0) {  // the shaft
        distance = out;
        normal = at.outward;
    } else {  // a rim
        distance = std::hypot(beyond, out);
        normal = (side * beyond / distance) * axis + (out / distance) * at.outward;
    }
    return {distance - radius, normal, center - distance * normal};
}

Nearest nearest_on(const RingShape& ring, const Vec3& center, double radius) {
    return nearest_on_circle(ring.center, ring.axis, ring.radius, ring.tube_radius, center, radius);
}

Nearest nearest_on(const BowlShape& bowl, const Vec3& center, double radius) {
    const Vec3 from_center = center - bowl.center;
    const double away = from_center.norm();
    if (bowl.opening.dot(from_center) * bowl.radius <= bowl.rim_height() * away)
        return nearest_on_wall(bowl.center, bowl.radius, from_center, -bowl.opening, radius);
    const Vec3 rim = bowl.center + bowl.rim_height() * bowl.opening;
    return nearest_on_circle(rim, bowl.opening, bowl.rim_radius(), 0, center, radius);
}

Nearest nearest_on(const PipeShape& pipe, const Vec3& center, double radius) {
    const Vec3 whole = pipe.to - pipe.from, axis = whole.normalized();
    const AroundAxis at(pipe.from, axis, center);
    const double along = std::clamp(at.along, 0.0, whole.norm());
    const Vec3 middle = pipe.from + along * axis;
    if (!pipe.is_tube() && -pipe.opening.dot(at.outward) < std::cos(0.5 * pipe.angle)) {
        // An edge, on the side where the centre is.
        const Vec3 across = axis.cross(pipe.opening);
        const double side = across.dot(center - pipe.from) < 0 ? -1 : 1;
        const Vec3 edge = -std::cos(0.5 * pipe.angle) * pipe.opening +
                          (side * std::sin(0.5 * pipe.angle)) * across;
        return nearest_around(middle + pipe.radius * edge, 0, center, radius);
    }
    if (along == at.along)
        return nearest_on_wall(middle, pipe.radius, at.away * at.outward, at.outward, radius);
    if (pipe.is_tube()) return nearest_on_circle(middle, axis, pipe.radius, 0, center, radius);
    return nearest_around(middle + pipe.radius * at.outward, 0, center, radius);
}

Nearest nearest_on(const SurfaceShape& shape, const Vec3& center, double radius) {
    return std::visit([&](const auto& s) { return nearest_on(s, center, radius); }, shape);
}

double signed_distance(const SurfaceShape& shape, const Vec3& point) {
    return nearest_on(shape, point, 0).gap;
}

}  // namespace carom
