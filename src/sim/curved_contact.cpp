#include "sim/curved_contact.h"

#include <cmath>

#include "sim/feature_side.h"

namespace carom {

namespace {

/// Part of gravity that tells a lift-off from rounding, for places no larger than their distances.
constexpr double kLeastPush = 4e-15;

Mat3 across_axis(const Vec3& axis) { return Mat3::Identity() - axis * axis.transpose(); }

void fill_plane(CurvedContact& c, const PlaneShape& plane) {
    c.origin = plane.offset_m * plane.normal;
    c.across = plane.normal * plane.normal.transpose();
    c.distance = c.radius;
}

void fill_capsule(CurvedContact& c, const CapsuleShape& capsule, const Vec3& x, const Vec3& v) {
    const Vec3 d = capsule.to - capsule.from;
    const Vec3 axis = d.normalized();
    const double half = 0.5 * d.norm(), along = axis.dot(x - capsule.from);
    const double border = kBorder * (x.cwiseAbs().maxCoeff() + c.radius);
    const int side =
        side_of({along - half, axis.dot(v), axis.dot(c.gravity)}, half, border, v.norm());
    c.distance = c.radius + capsule.radius;
    if (side < 0) {
        c.origin = capsule.from;
        c.add_gate(-axis, -axis.dot(capsule.from));
    } else if (side > 0) {
        c.origin = capsule.to;
        c.add_gate(axis, axis.dot(capsule.to));
    } else {
        c.origin = capsule.from;
        c.across = across_axis(axis);
        c.add_gate(axis, axis.dot(capsule.from));
        c.add_gate(-axis, -axis.dot(capsule.to));
    }
}

void fill_box(CurvedContact& c, const BoxShape& box, const Vec3& x, const Vec3& v) {
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    const double border = kBorder * (x.cwiseAbs().maxCoeff() + c.radius);
    const double speed = v.norm();
    c.origin = box.center;
    c.across = Mat3::Zero();
    c.distance = c.radius;
    for (int i = 0; i < 3; ++i) {
        const Vec3 axis = world_from_box.col(i);
        const double place = axis.dot(x - box.center), half = 0.5 * box.size[i];
        const double middle = axis.dot(box.center);
        const int sign = side_of({place, axis.dot(v), axis.dot(c.gravity)}, half, border, speed);
        if (sign != 0) {
            c.origin += (sign * half) * axis;
            c.across += axis * axis.transpose();
            c.add_gate(sign * axis, sign * middle + half);
        } else {
            c.add_gate(axis, middle - half);
            c.add_gate(-axis, -middle - half);
        }
    }
    // Through rounding all three may look inside; then the face that is nearest is the one.
    if (c.across.isZero(0)) {
        Vec3 place = box.orientation.conjugate() * (x - box.center);
        int nearest = 0;
        (place.cwiseAbs() - 0.5 * box.size).maxCoeff(&nearest);
        const Vec3 normal = (place[nearest] < 0 ? -1.0 : 1.0) * world_from_box.col(nearest);
        c.origin += 0.5 * box.size[nearest] * normal;
        c.across = normal * normal.transpose();
    }
}

}  // namespace

CurvedContact curved_contact(const SurfaceShape& shape, const Vec3& x, const Vec3& v, double radius,
                             const Vec3& gravity) {
    CurvedContact c;
    c.radius = radius;
    c.gravity = gravity;
    if (const auto* plane = std::get_if<PlaneShape>(&shape)) {
        fill_plane(c, *plane);
    } else if (const auto* box = std::get_if<BoxShape>(&shape)) {
        fill_box(c, *box, x, v);
    } else if (const auto* capsule = std::get_if<CapsuleShape>(&shape)) {
        fill_capsule(c, *capsule, x, v);
    } else {
        const auto& sphere = std::get<SphereShape>(shape);
        c.origin = sphere.center;
        c.distance = radius + sphere.radius;
    }
    return c;
}

CurvedForces curved_forces(const CurvedContact& c, CurvedMode mode, const CurvedState& state) {
    CurvedForces r;
    const Vec3 q = c.across * (state.x - c.origin);
    const double distance = q.norm();
    r.normal = q / distance;
    const Vec3& n = r.normal;
    const Vec3 turning = c.across * state.v;
    r.normal_rate = (turning - n.dot(turning) * n) / distance;
    const double g_n = -c.gravity.dot(n);
    r.push = g_n - state.v.dot(r.normal_rate);
    r.acceleration = c.gravity + r.push * n;
    if (mode == CurvedMode::kSmooth) return r;

    const double R = c.radius, k = c.inertia_factor;
    const double spin_n = state.w.dot(n);
    r.slip = state.v - n.dot(state.v) * n - R * state.w.cross(n);
    r.drive = c.gravity + g_n * n - (R * spin_n) * n.cross(r.normal_rate);
    if (mode == CurvedMode::kRolling) {
        r.friction = -(k / (1 + k)) * r.drive;
    } else {
        const Vec3& against = mode == CurvedMode::kSliding ? r.slip : r.drive;
        const double size = against.norm();
        if (size > 0) r.friction = (-c.friction * r.push / size) * against;
    }
    r.acceleration += r.friction;
    r.spin_rate = n.cross(r.friction) * (-1 / (k * R));
    return r;
}

double least_push(const CurvedContact& c, const Vec3& x) {
    const double size = 1 + (x.cwiseAbs().maxCoeff() + c.origin.cwiseAbs().maxCoeff()) / c.distance;
    return -kLeastPush * size * c.gravity.norm();
}

double grip_left(const CurvedContact& c, const CurvedForces& forces) {
    const double k = c.inertia_factor;
    return c.friction * forces.push - k / (1 + k) * forces.drive.norm();
}

void project(const CurvedContact& c, CurvedMode mode, CurvedState& state) {
    const Vec3 q = c.across * (state.x - c.origin);
    const double distance = q.norm();
    const Vec3 n = q / distance;
    state.x += (c.distance - distance) * n;
    state.v -= n.dot(state.v) * n;
    if (mode == CurvedMode::kRolling) state.w = state.w.dot(n) * n + n.cross(state.v) / c.radius;
}

}  // namespace carom
