#include "geometry/bounds.h"

#include <cmath>
#include <limits>

namespace carom {

namespace {

Box3 around(const PlaneShape&) { return {}; }

Box3 around(const BoxShape& box) {
    const Vec3 half = box.orientation.toRotationMatrix().cwiseAbs() * (0.5 * box.size);
    return {box.center - half, box.center + half};
}

Box3 around(const SphereShape& sphere) {
    const Vec3 r = Vec3::Constant(sphere.radius);
    return {sphere.center - r, sphere.center + r};
}

Box3 around(const CapsuleShape& capsule) {
    const Vec3 r = Vec3::Constant(capsule.radius);
    return {capsule.from.cwiseMin(capsule.to) - r, capsule.from.cwiseMax(capsule.to) + r};
}

/// How far a disc of radius 1 across a unit axis reaches along x, y and z.
Vec3 reach_across(const Vec3& axis) {
    return (1 - axis.cwiseAbs2().array()).cwiseMax(0).sqrt().matrix();
}

Box3 around(const CylinderShape& cylinder) {
    const Vec3 r = cylinder.radius * reach_across((cylinder.to - cylinder.from).normalized());
    return {cylinder.from.cwiseMin(cylinder.to) - r, cylinder.from.cwiseMax(cylinder.to) + r};
}

Box3 around(const RingShape& ring) {
    const Vec3 r = ring.radius * reach_across(ring.axis) + Vec3::Constant(ring.tube_radius);
    return {ring.center - r, ring.center + r};
}

SphereAround ball_around(const PlaneShape&) {
    return {Vec3::Zero(), std::numeric_limits<double>::infinity()};
}
SphereAround ball_around(const BoxShape& box) { return {box.center, 0.5 * box.size.norm()}; }
SphereAround ball_around(const SphereShape& sphere) { return {sphere.center, sphere.radius}; }
SphereAround ball_around(const CapsuleShape& capsule) {
    return {0.5 * (capsule.from + capsule.to),
            0.5 * (capsule.to - capsule.from).norm() + capsule.radius};
}
SphereAround ball_around(const CylinderShape& cylinder) {
    return {0.5 * (cylinder.from + cylinder.to),
            std::hypot(0.5 * (cylinder.to - cylinder.from).norm(), cylinder.radius)};
}
SphereAround ball_around(const RingShape& ring) {
    return {ring.center, ring.radius + ring.tube_radius};
}

}  // namespace

Box3 bounds_of(const SurfaceShape& shape) {
    return std::visit([](const auto& s) { return around(s); }, shape);
}

SphereAround sphere_around(const SurfaceShape& shape) {
    return std::visit([](const auto& s) { return ball_around(s); }, shape);
}

}  // namespace carom
