// The shapes of surfaces, in one frame, SI units. What depends on the kind of a shape is a set of
// overloads that std::visit calls, without a default: a new shape does not compile until each has
// been told of it.
#pragma once

#include <cmath>
#include <numbers>
#include <variant>

#include "core/types.h"

namespace carom {

/// A half-space; solid below.
struct PlaneShape {
    Vec3 normal = Vec3::UnitZ();  ///< unit
    double offset_m = 0;          ///< points p with normal . p = offset

    bool operator==(const PlaneShape&) const = default;
};

struct BoxShape {
    Vec3 center = Vec3::Zero();
    Vec3 size = Vec3::Ones();             ///< full edges, m
    Quat orientation = Quat::Identity();  ///< world from box

    bool operator==(const BoxShape& other) const {
        return center == other.center && size == other.size &&
               orientation.coeffs() == other.orientation.coeffs();
    }
};

struct SphereShape {
    Vec3 center = Vec3::Zero();
    double radius = 1;  ///< m

    bool operator==(const SphereShape&) const = default;
};

/// All points within `radius` of a segment.
struct CapsuleShape {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::UnitX();
    double radius = 0.1;  ///< m

    bool operator==(const CapsuleShape&) const = default;
};

/// A solid cylinder with flat ends, whose edges are circles.
struct CylinderShape {
    Vec3 from = Vec3::Zero();  ///< middle of one end
    Vec3 to = Vec3::UnitX();   ///< middle of the other
    double radius = 0.1;       ///< m

    bool operator==(const CylinderShape&) const = default;
};

/// A torus: all points within `tube_radius` of a circle.
struct RingShape {
    Vec3 center = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();  ///< unit, across the circle
    double radius = 1;          ///< of the circle, m
    double tube_radius = 0.1;   ///< m, below `radius`

    bool operator==(const RingShape&) const = default;
};

/// The part of a sphere up to `depth` along `opening` from its lowest point: a wall without
/// thickness, which balls meet from inside, from outside and at its rim.
struct BowlShape {
    Vec3 center = Vec3::Zero();    ///< of the sphere
    double radius = 1;             ///< of the sphere, m
    Vec3 opening = Vec3::UnitZ();  ///< unit
    double depth = 1;              ///< m, at most twice the radius

    /// Of the rim's plane over the centre along `opening`, m.
    double rim_height() const { return depth - radius; }
    double rim_radius() const { return std::sqrt(depth * (2 * radius - depth)); }
    bool is_closed() const { return depth >= 2 * radius; }
    bool operator==(const BowlShape&) const = default;
};

/// The part of a cylinder around a segment that is within `angle` / 2 of the direction opposite to
/// `opening`: a wall without thickness, as that of a bowl.
struct PipeShape {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::UnitX();
    double radius = 0.1;           ///< m
    Vec3 opening = Vec3::UnitZ();  ///< unit, across the segment
    double angle = 3;              ///< rad; 2 pi and more is a tube

    bool is_tube() const { return angle >= 2 * std::numbers::pi; }
    bool operator==(const PipeShape&) const = default;
};

using SurfaceShape = std::variant<PlaneShape, BoxShape, SphereShape, CapsuleShape, CylinderShape,
                                  RingShape, BowlShape, PipeShape>;

/// Of a set of lambdas, one overloaded function for std::visit.
template <class... Cases>
struct PerShape : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
PerShape(Cases...) -> PerShape<Cases...>;

/// Whether a shape goes on without end: a plane.
inline bool is_unbounded(const SurfaceShape& shape) {
    return std::visit(
        PerShape{[](const PlaneShape&) { return true; }, [](const BoxShape&) { return false; },
                 [](const SphereShape&) { return false; },
                 [](const CapsuleShape&) { return false; },
                 [](const CylinderShape&) { return false; }, [](const RingShape&) { return false; },
                 [](const BowlShape&) { return false; }, [](const PipeShape&) { return false; }},
        shape);
}

}  // namespace carom
