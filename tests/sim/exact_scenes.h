// Scenes of the method `exact`, and what a bouncing ball does in closed form.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scenes.h"
#include "sim/simulate.h"

namespace carom::testing {

inline Scene exact_scene(double restitution, double friction, double gravity) {
    Scene scene = scene_of(restitution, friction, gravity, 1e-3);
    scene.simulation.method = Method::kExact;
    return scene;
}

inline std::vector<Event> impacts_of(const Motion& motion) {
    return events_of(motion, EventKind::kImpact);
}

/// |value / expected - 1|; |value| where 0 is expected.
inline double relative_error(double value, double expected) {
    return expected == 0 ? std::abs(value) : std::abs(value / expected - 1);
}

inline double kinetic_energy(const Scene& scene, const Motion& motion, double t) {
    double sum = 0;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Ball& b = scene.balls[i];
        const BallState s = motion.balls[i].at(t);
        sum += 0.5 * b.mass *
               (s.velocity.squaredNorm() +
                b.inertia_factor * b.radius * b.radius * s.spin.squaredNorm());
    }
    return sum;
}

/// Kinetic and potential energy over z = 0 [J].
inline double total_energy(const Scene& scene, const Motion& motion, double t) {
    double sum = kinetic_energy(scene, motion, t);
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        sum -= scene.balls[i].mass * scene.simulation.gravity.dot(motion.balls[i].at(t).position);
    return sum;
}

inline Vec3 momentum(const Scene& scene, const Motion& motion, double t) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        sum += scene.balls[i].mass * motion.balls[i].at(t).velocity;
    return sum;
}

}  // namespace carom::testing
