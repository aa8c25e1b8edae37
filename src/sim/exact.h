// The method `exact`: closed-form motion between contacts, impacts located in time and resolved by
// ODE's contact solver. Its cost follows the events, not the seconds.
#pragma once

#include <cstddef>
#include <stop_token>

#include "scene/scene.h"
#include "sim/simulate.h"

namespace carom {

struct ExactOptions {
    /// From this many balls on a grid tells who is near whom. The motion does not depend on it.
    std::size_t balls_for_grid = 32;
};

/// What it models exactly: flight; impacts with planes, boxes, spheres, capsules and balls, one or
/// many at an instant; a lasting contact with a flat surface (rest, slide, roll); bouncing series
/// that end in finite time.
/// What it steps with ODE (island_step.h): lasting contacts that act on each other (stacks, piles,
/// grooves), in steps of 1/4000 s; one ball on a sphere, a capsule or an edge, or with a slip that
/// turns, in steps of 1/32000 s, right to second order (1e-10 m in a quarter of a second of slip
/// across a slope); a lift-off there is up to two steps late. What comes to rest there costs
/// nothing until something touches it. Fails with Failure(kRun) naming the bodies and the time if a
/// bound on iterations or on events at one instant is hit, or a state is not finite.
SimulationResult simulate_exact(const Scene& scene, const std::stop_token& stop = {},
                                const SimulationProgress& progress = {},
                                const ExactOptions& options = {});

}  // namespace carom
