// The shapes of surfaces, in one frame, SI units. What depends on the kind of a shape is a set of
// overloads that std::visit calls, without a default: a new shape does not compile until each has
// been told of it.
#pragma once

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

using SurfaceShape =
    std::variant<PlaneShape, BoxShape, SphereShape, CapsuleShape, CylinderShape, RingShape>;

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
        PerShape{
            [](const PlaneShape&) { return true; }, [](const BoxShape&) { return false; },
            [](const SphereShape&) { return false; }, [](const CapsuleShape&) { return false; },
            [](const CylinderShape&) { return false; }, [](const RingShape&) { return false; }},
        shape);
}

}  // namespace carom
