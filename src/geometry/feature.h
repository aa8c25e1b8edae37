// The features of shapes: a ball's centre keeps its distance from the core of the one that it
// touches, which is a point (a sphere, the end of a capsule, a corner), a line (a capsule's shaft,
// an edge) or a plane (a face).
#pragma once

#include <array>
#include <cstddef>

#include "geometry/shape.h"

namespace carom {

/// A half-space in which the ball's centre is on the same feature: direction . x >= offset.
struct FeatureBorder {
    Vec3 direction = Vec3::UnitX();
    double offset = 0;  ///< m

    double margin(const Vec3& x) const { return direction.dot(x) - offset; }
};

/// Of the feature itself, and of others that meet the ball in the same place (seams.h).
inline constexpr int kMostBorders = 18;

struct Feature {
    Vec3 origin = Vec3::Zero();      ///< on the core
    Mat3 across = Mat3::Identity();  ///< takes away what lies along the core
    double distance = 1;             ///< of a touching ball's centre from the core, m
    std::array<FeatureBorder, kMostBorders> borders{};
    int border_count = 0;

    Vec3 normal_at(const Vec3& x) const { return (across * (x - origin)).normalized(); }
    void add_border(const Vec3& direction, double at) {
        borders[static_cast<std::size_t>(border_count++)] = {direction, at};
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

/// Whether a normal is that of a flat part of a shape: anything of a plane, a face of a box.
bool is_flat(const SurfaceShape& shape, const Vec3& normal);

}  // namespace carom
