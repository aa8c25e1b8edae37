// What the tests of curved contacts share.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "exact_scenes.h"

namespace carom::testing {

/// Of places, speeds and cosines of normals, where the issue asks for 1e-10 and 1e-9.
inline constexpr double kBound = 1e-12;

inline Surface& add_surface(Scene& scene, const char* name, const SurfaceShape& shape) {
    Surface s;
    s.name = name;
    s.shape = shape;
    s.material = 2;
    scene.surfaces.push_back(s);
    return scene.surfaces.back();
}

/// Kinetic and potential energy per mass of ball 0, m^2/s^2.
inline double energy(const Scene& scene, const BallState& s) {
    const Ball& b = scene.balls[0];
    return 0.5 * s.velocity.squaredNorm() +
           0.5 * b.inertia_factor * b.radius * b.radius * s.spin.squaredNorm() -
           scene.simulation.gravity.dot(s.position);
}

inline Vec3 slip_of(const Ball& ball, const BallState& s, const Vec3& normal) {
    const Vec3 v = s.velocity - ball.radius * s.spin.cross(normal);
    return v - v.dot(normal) * normal;
}

/// The only row of a kind.
inline Event only(const Motion& motion, EventKind kind) {
    const std::vector<Event> rows = events_of(motion, kind);
    EXPECT_EQ(rows.size(), 1u) << event_kind_name(kind);
    return rows.empty() ? Event{} : rows.front();
}

}  // namespace carom::testing
