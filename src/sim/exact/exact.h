// The method `exact`: closed-form motion between contacts, impacts located in time and resolved by
// ODE's contact solver. Its cost follows the events, not the seconds.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <vector>

#include "motion/motion_log.h"
#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// Takes the pieces that there are, if it wants them now: all that begin before `now` [s], and some
/// that begin at it, which later ones of the same beginning replace; and of the events those before
/// `now`. Called often.
using PieceTap = std::function<void(MotionLog& pieces, std::vector<Event>& events, double now)>;

struct ExactOptions {
    /// From this many balls on a grid tells who is near whom. The motion does not depend on it.
    std::size_t balls_for_grid = 32;
    /// From this many surfaces but planes on a tree tells which ones are near; likewise.
    std::size_t surfaces_for_tree = 2;
    /// m: gaps up to this may be the rounding of the coordinates that the scene came with
    /// (nearby_origin.h), above that of the coordinates it has here.
    double place_rounding = 0;
    /// If there is one, it gets all pieces and events; the result has none, nor peaks. Then only
    /// what it leaves counts as kept (record/kept_limit.h).
    PieceTap tap = {};
};

/// What it models exactly: flight; impacts with surfaces and balls, one or many at an instant; a
/// lasting contact with a flat surface (rest, slide, roll); bouncing series that end in finite
/// time. What it integrates (single_motion.h): one ball on what is round, an edge, a corner or a
/// rim, or with a slip that turns, right to 1e-12 of its size and speeds, some tens of pieces a
/// second. What it steps: from 24 balls on that hang together, or where impacts come too thick to
/// be told apart, a pile (pile.h), in steps of at most 1/1000 s and 3 % of a radius. With ODE
/// (island_step.h): fewer lasting contacts that act on each other (stacks, grooves), in steps of
/// 1/4000 s. What comes to rest there costs
/// nothing until something touches it. Fails with Failure(kRun) naming the bodies and the time if a
/// bound on iterations or on events at one instant is hit, or a state is not finite.
SimulationResult simulate_exact(const Scene& scene, const std::stop_token& stop = {},
                                const SimulationProgress& progress = {},
                                const ExactOptions& options = {});

}  // namespace carom
