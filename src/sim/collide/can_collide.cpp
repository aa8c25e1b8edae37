#include "sim/collide/can_collide.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

/// Pairs are looked at one by one only in scenes of at most so many balls.
constexpr std::size_t kMostBalls = 2000;

/// Normals are parallel up to the rounding of their products.
constexpr double kParallel = 1e-14;

/// Paths that pass each other must do so by this fraction of the radii, above their rounding.
constexpr double kClearance = 1e-9;

/// The directions along which no surface pushes: what is left of space across all normals.
Mat3 across_normals(const Scene& scene) {
    Mat3 free = Mat3::Identity();
    for (const Surface& s : scene.surfaces) {
        const Vec3 rest = free * std::get<PlaneShape>(s.shape).normal;
        if (rest.norm() <= kParallel) continue;
        const Vec3 axis = rest.normalized();
        free -= axis * axis.transpose() * free;
    }
    return free;
}

/// Friction finds nothing to do: planes across gravity, and no motion along them.
bool friction_is_idle(const Scene& scene, const Mat3& free) {
    const Vec3 pull = free * scene.simulation.gravity;
    if (pull.norm() > kParallel * scene.simulation.gravity.norm()) return false;
    const bool parallel = free.trace() > 1.5;  // one direction is taken: two are left
    return parallel && std::all_of(scene.balls.begin(), scene.balls.end(), [&free](const Ball& b) {
               return (free * b.velocity).isZero(0) && b.spin.isZero(0);
           });
}

/// A ball's motion across all normals.
struct FreeMotion {
    Vec3 position, velocity;
    double radius = 0;
};

/// Whether two balls at constant relative velocity come closer than their radii in `duration`.
bool pass_close(const FreeMotion& a, const FreeMotion& b, double duration) {
    const Vec3 x = a.position - b.position, v = a.velocity - b.velocity;
    const double speed2 = v.squaredNorm();
    const double nearest = speed2 > 0 ? std::clamp(-x.dot(v) / speed2, 0.0, duration) : 0;
    const double reach = (a.radius + b.radius) * (1 + kClearance);
    return (x + nearest * v).squaredNorm() <= reach * reach;
}

}  // namespace

CanCollide can_collide(const Scene& scene, const PairTable& pairs, double duration) {
    const std::size_t balls = scene.balls.size();
    if (balls < 2) return {false, "one ball at most: nothing to meet but surfaces"};
    const CanCollide can{true, fmt::format("the scene has {} balls, which can meet", balls)};
    const bool planes =
        std::all_of(scene.surfaces.begin(), scene.surfaces.end(),
                    [](const Surface& s) { return std::holds_alternative<PlaneShape>(s.shape); });
    if (!planes || balls > kMostBalls || scene.air) return can;
    const Mat3 free = across_normals(scene);
    if (pairs.any_friction() && !friction_is_idle(scene, free)) return can;
    std::vector<FreeMotion> motions;
    motions.reserve(balls);
    for (const Ball& b : scene.balls)
        motions.push_back({free * b.position, free * b.velocity, b.radius});
    for (std::size_t i = 0; i < balls; ++i)
        for (std::size_t j = i + 1; j < balls; ++j)
            if (pass_close(motions[i], motions[j], duration)) return can;
    return {false, fmt::format("the paths of the {} balls pass each other at a distance", balls)};
}

}  // namespace carom
