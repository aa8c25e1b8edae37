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

/// Along each axis the farthest point of the sphere, if it belongs to the bowl, else of the rim.
Box3 around(const BowlShape& bowl) {
    const Vec3 rim = bowl.center + bowl.rim_height() * bowl.opening;
    const Vec3 r = bowl.is_closed() ? Vec3(Vec3::Zero())
                                    : Vec3(bowl.rim_radius() * reach_across(bowl.opening));
    Box3 box(rim - r, rim + r);
    for (int i = 0; i < 3; ++i)
        for (const double side : {-1.0, 1.0})
            if (side * bowl.opening[i] * bowl.radius <= bowl.rim_height())
                box.extend(bowl.center + side * bowl.radius * Vec3::Unit(i));
    return box;
}

/// Of both ends; along each axis the farthest point of the whole circle if it belongs to the wall,
/// else an edge.
Box3 around(const PipeShape& pipe) {
    const Vec3 axis = (pipe.to - pipe.from).normalized(), across = axis.cross(pipe.opening);
    const double half = 0.5 * pipe.angle;
    Box3 box;
    const auto extend = [&](const Vec3& out) {
        box.extend(pipe.from + pipe.radius * out);
        box.extend(pipe.to + pipe.radius * out);
    };
    if (!pipe.is_tube())
        for (const double side : {-1.0, 1.0})
            extend(-std::cos(half) * pipe.opening + side * std::sin(half) * across);
    for (int i = 0; i < 3; ++i) {
        const Vec3 out = Vec3::Unit(i) - axis[i] * axis;
        if (out.norm() < 1e-12) continue;
        for (const double side : {-1.0, 1.0}) {
            const Vec3 there = side * out.normalized();
            if (pipe.is_tube() || -there.dot(pipe.opening) >= std::cos(half)) extend(there);
        }
    }
    return box;
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
SphereAround ball_around(const BowlShape& bowl) { return {bowl.center, bowl.radius}; }
SphereAround ball_around(const PipeShape& pipe) {
    return {0.5 * (pipe.from + pipe.to),
            std::hypot(0.5 * (pipe.to - pipe.from).norm(), pipe.radius)};
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
