// The features of shapes: a ball's centre keeps its distance from the core of the one that it
// touches, which is a point (a sphere, the end of a capsule, a corner), a line (a shaft, a straight
// edge), a plane (a face) or a circle (a ring, a
// round edge).
#pragma once

#include <array>
#include <cstddef>

#include "geometry/around_axis.h"
#include "geometry/shape.h"

namespace carom {

/// Where the ball's centre is on the same feature: direction . x + slant |x - axis| >= offset, a
/// half-space, or the inside or the outside of a cylinder or cone around an axis.
struct FeatureBorder {
    Vec3 direction = Vec3::UnitX();
    double offset = 0;           ///< m
    double slant = 0;            ///< 0: a half-space
    Vec3 origin = Vec3::Zero();  ///< on the axis
    Vec3 axis = Vec3::UnitZ();   ///< unit

    double margin(const Vec3& x) const;
    /// The border of what is on its other side.
    FeatureBorder reversed() const { return {-direction, -offset, -slant, origin, axis}; }
};

/// Of the feature itself, and of others that meet the ball in the same place (seams.h).
inline constexpr int kMostBorders = 18;

/// How a ball's centre moves around the core of a feature.
struct FeatureMotion {
    double gap = 0;  ///< m
    Vec3 normal = Vec3::UnitZ();
    Vec3 normal_rate = Vec3::Zero();  ///< 1/s
    double distance = 0;              ///< of the centre from the core, m
    /// The part of the velocity that turns the normal [m/s]: the normal acceleration of a centre
    /// that keeps its distance is -turning_speed . normal_rate.
    Vec3 turning_speed = Vec3::Zero();
};

struct Feature {
    Vec3 origin = Vec3::Zero();      ///< on the core; of a circle its middle
    Mat3 across = Mat3::Identity();  ///< takes away what lies along a core that is straight
    double distance = 1;             ///< of a touching ball's centre from the core, m
    double core_radius = 0;          ///< of a core that is a circle, m; 0 for all others
    Vec3 core_axis = Vec3::UnitZ();  ///< of such a circle, unit
    /// Of a circle that the ball may cross over: which half of it is met, so that the law goes on
    /// smoothly up to where the border in the middle ends it; 0 for all others.
    Vec3 half = Vec3::Zero();
    bool hollow = false;  ///< the ball is inside: the normal points towards the core
    /// Of a place that holds a ball from all sides, such as a hole that is too small for it: what
    /// pulls along it moves nothing up to this part of what presses. 0 for all others.
    double hold = 0;
    std::array<FeatureBorder, kMostBorders> borders{};
    int border_count = 0;

    bool has_circle() const { return core_radius > 0; }
    /// Of a core that is a circle.
    AroundAxis around_axis(const Vec3& x) const {
        return AroundAxis(origin, core_axis, x).seen_from_side(half);
    }
    /// From the core's nearest point to x, m.
    Vec3 from_core(const Vec3& x) const;
    Vec3 normal_at(const Vec3& x) const {
        return hollow ? Vec3(-from_core(x).normalized()) : Vec3(from_core(x).normalized());
    }
    /// Of a ball's centre at x from where it touches, m.
    double gap_at(const Vec3& x) const {
        const double away = from_core(x).norm();
        return hollow ? distance - away : away - distance;
    }
    /// What the gap grows by on a way from x, m: without the rounding of either gap.
    double gap_growth(const Vec3& x, const Vec3& way) const;
    /// Of a centre at x [m] that moves by v [m/s].
    FeatureMotion motion_at(const Vec3& x, const Vec3& v) const;

    void add_border(const FeatureBorder& border) {
        borders[static_cast<std::size_t>(border_count++)] = border;
    }
    void add_border(const Vec3& direction, double at) {
        FeatureBorder& border = borders[static_cast<std::size_t>(border_count++)];
        border.direction = direction;
        border.offset = at;
    }
    /// Beyond (`side` 1) or within (-1) `radius` [m] of an axis.
    void add_round_border(const Vec3& on_axis, const Vec3& axis, double radius, int side) {
        borders[static_cast<std::size_t>(border_count++)] = {
            Vec3::Zero(), side * radius, static_cast<double>(side), on_axis, axis};
    }
};

/// A ball's centre and what moves it.
struct CenterMotion {
    Vec3 x = Vec3::Zero();     ///< m
    Vec3 v = Vec3::Zero();     ///< m/s
    Vec3 pull = Vec3::Zero();  ///< m/s^2
};

/// The feature that a ball of `radius` [m] which touches `shape` is on. On the border of two
/// features the velocity decides, and the pull where that has no part across the border.
Feature feature_at(const SurfaceShape& shape, const CenterMotion& center, double radius);

/// Whether a normal is that of a flat part of a shape: anything of a plane, a face of a box, an end
/// of a cylinder.
bool is_flat(const SurfaceShape& shape, const Vec3& normal);

}  // namespace carom
