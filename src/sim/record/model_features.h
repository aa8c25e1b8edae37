// What of the model a scene needs, for --stats.
#pragma once

#include <map>
#include <string>

#include "scene/scene.h"
#include "sim/contact/restitution.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// gravity, surfaces, pairs (ball against ball), friction, spin, restitution_by_speed,
/// tangential_restitution, rolling, pivoting; each with the reason.
std::map<std::string, Effect> effects_of(const Scene& scene, const PairTable& pairs);

/// Adds islands (contacts that act on each other), collapse (heaps that nothing presses together,
/// which need free space) and last_resort (contacts that were given up on),
/// from the counts of the report.
void add_contact_effects(SimulationReport& report, bool in_free_space);

}  // namespace carom
