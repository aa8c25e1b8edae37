// Small scenes, built as values.
#pragma once

#include <cmath>
#include <string>

#include "scene/scene.h"
#include "sim/simulate.h"

namespace carom::testing {

constexpr double kGravity = 9.81;   // m/s^2
constexpr double kSolid = 2.0 / 5;  // k of I = k m r^2
constexpr double kShell = 2.0 / 3;

/// `restitution: e` as the scene format stores it, for K = 4: x/v = -2 ln e / K with v = 1.
inline VirtualBody virtual_body(double restitution) {
    if (restitution == 0) return {INFINITY, 1};
    return {-2 * std::log(restitution) / 4.0, 1};
}

/// Materials: [0] the default one, [1] "ball" with the pair's whole restitution and friction, so
/// that it meets surfaces of [2] "surface" (restitution 1, friction 1) with just these numbers.
/// Two balls of [1] would meet with their squares: see use_pair().
inline Scene scene_of(double restitution, double friction, double gravity, double step) {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[1].name = "ball";
    scene.materials[1].virtual_body = virtual_body(restitution);
    scene.materials[2].name = "surface";
    if (friction > 0) {
        scene.materials[1].friction = friction;
        scene.materials[2].friction = 1;
    }
    scene.simulation.gravity = Vec3(0, 0, -gravity);
    scene.simulation.step = step;
    scene.simulation.method = Method::kFixed;
    return scene;
}

/// Sets what two balls of material [1] do to each other.
inline void use_pair(Scene& scene, double restitution, double friction = 0) {
    scene.pairs.push_back({{1, 1}, restitution, friction, {}});
}

inline void add_plane(Scene& scene, const Vec3& normal = Vec3::UnitZ(), double offset = 0) {
    Surface plane;
    plane.name = "plane" + std::to_string(scene.surfaces.size());
    plane.shape = PlaneShape{normal.normalized(), offset};
    plane.material = 2;
    scene.surfaces.push_back(plane);
}

inline Ball& add_ball(Scene& scene, const Vec3& position, const Vec3& velocity = Vec3::Zero(),
                      double radius = 0.1) {
    Ball ball;
    ball.name = "ball" + std::to_string(scene.balls.size());
    ball.radius = radius;
    ball.material = 1;
    ball.position = position;
    ball.velocity = velocity;
    scene.balls.push_back(ball);
    return scene.balls.back();
}

/// A plane through the origin that falls by `degrees` towards `azimuth_deg`: its normal.
inline Vec3 incline(double degrees, double azimuth_deg = 0) {
    const double a = degrees * M_PI / 180, b = azimuth_deg * M_PI / 180;
    return {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
}

inline SimulationResult run(Scene& scene, double duration) {
    scene.simulation.duration = duration;
    return simulate(scene);
}

/// Events of one kind.
inline std::vector<Event> events_of(const Motion& motion, EventKind kind) {
    std::vector<Event> chosen;
    for (const Event& e : motion.events)
        if (e.kind == kind) chosen.push_back(e);
    return chosen;
}

}  // namespace carom::testing
