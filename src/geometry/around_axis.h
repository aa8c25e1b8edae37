// A place seen from an axis.
#pragma once

#include "core/types.h"

namespace carom {

/// A ball whose centre is no farther from the axis of a hole than this part of the hole's radius is
/// in its middle. Beyond, the direction from the axis is known to 1e-7.
inline constexpr double kCentred = 1e-9;

struct AroundAxis {
    double along = 0;  ///< m, from the origin along the axis
    double away = 0;   ///< m, from the axis
    /// Unit, across the axis, towards the place; on the axis itself every direction is as good.
    Vec3 outward = Vec3::UnitX();

    AroundAxis(const Vec3& origin, const Vec3& axis, const Vec3& place) {
        const Vec3 from_origin = place - origin;
        along = axis.dot(from_origin);
        const Vec3 across = from_origin - along * axis;
        away = across.norm();
        outward = away > 0 ? Vec3(across / away) : Vec3(axis.unitOrthogonal());
    }

    /// As seen from the half-space that `side` points into: beyond the axis `away` is negative.
    AroundAxis seen_from_side(const Vec3& side) const {
        AroundAxis seen = *this;
        if (outward.dot(side) < 0) {
            seen.away = -away;
            seen.outward = -outward;
        }
        return seen;
    }
};

}  // namespace carom
