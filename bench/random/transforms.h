// The same scene elsewhere: moved, turned, mirrored, its parts listed in another order, or with
// the last digits of its numbers changed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom::bench {

struct Transform {
    std::string name;
    Mat3 linear = Mat3::Identity();  ///< orthogonal, of determinant 1 or -1
    Vec3 shift = Vec3::Zero();       ///< m
    bool reorder = false;            ///< balls and surfaces backwards

    Vec3 place(const Vec3& p) const { return linear * p + shift; }
    Vec3 place_back(const Vec3& p) const { return linear.transpose() * (p - shift); }
    /// A spin is an axial vector.
    Vec3 spin(const Vec3& w) const { return linear.determinant() * (linear * w); }
    Vec3 spin_back(const Vec3& w) const { return linear.determinant() * (linear.transpose() * w); }
};

/// "moved by 1 m", "... 1e3 m", "... 1e6 m", "turned", "mirrored", "reordered", in directions of
/// this seed.
std::vector<Transform> transforms(std::uint64_t seed);

Scene transformed(const Scene& scene, const Transform& transform);

/// Coordinates changed by -1, 0 or 1 units in the last place that they have at distances of
/// `far` [m] from the origin or at their own, velocities, spins and directions in their own.
Scene perturbed(const Scene& scene, double far, std::uint64_t seed);

}  // namespace carom::bench
