// The method `exact`: closed-form motion between contacts, impacts located in time and resolved by
// ODE's contact solver. Its cost follows the events, not the seconds.
#pragma once

#include <stop_token>

#include "scene/scene.h"
#include "sim/simulate.h"

namespace carom {

/// What it models exactly: flight; impacts with planes, boxes, spheres, capsules and balls, one or
/// many at an instant; a lasting contact with a flat surface (rest, slide, roll); bouncing series
/// that end in finite time.
/// What it refuses, with Failure(kRun) naming the bodies and the time: lasting contacts that
/// are curved (sphere, capsule, edge), slip that turns, and lasting contacts that act on each other
/// (stacks, piles, grooves). Method `fixed` steps those.
SimulationResult simulate_exact(const Scene& scene, const std::stop_token& stop,
                                const SimulationProgress& progress);

}  // namespace carom
