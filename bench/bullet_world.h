// Bullet (double precision) with a scene in it, set up for bouncing balls as its author advises.
//
// Settings: Erwin Coumans' answer in bulletphysics/bullet3 issue 3094 ("updated script that
// produces proper restitution"): restitution velocity threshold 0, no warm starting, split impulse,
// contact processing threshold 0, no damping. Besides: split impulse at every depth (its threshold
// 0, so that position correction never enters velocities), 50 iterations of the solver, steps of
// one size without sub-steps. Restitution and friction of a pair are products, as Bullet combines
// them by default; where the scene overrides a pair, Bullet's own hook for that is used. Sleeping
// below 1e-3 m/s and rad/s, so that what rests can rest. Where a ball crosses more than its radius
// in a step Bullet's continuous detection is on (motion threshold half the radius, swept sphere 0.9
// of it).
#pragma once

#include <memory>
#include <string>

#include "scene/scene.h"
#include "sim/simulate.h"
#include "stepped_world.h"

namespace carom::bench {

/// World of btDiscreteDynamicsWorld with btSequentialImpulseConstraintSolver. One at a time:
/// Bullet's hook for pairs is one function pointer of the process.
std::unique_ptr<SteppedWorld> make_bullet_world(const Scene& scene, double step);

/// The scene's motion by Bullet, with the steps joined to pieces as those of `fixed` are (its
/// integrator is semi-implicit Euler, too). No events and no peaks.
SimulationResult simulate_bullet(const Scene& scene, double step,
                                 const SimulationProgress& progress);

std::string bullet_version();

}  // namespace carom::bench
