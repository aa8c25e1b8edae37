// A hostile scene's motion, in bounded work.
#pragma once

#include <optional>
#include <string_view>

#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom::fuzz {

/// The scene of a text, small enough for a fuzzer: of few balls and of at most half a second, its
/// pictures 64x36. None where it is wrong, or large.
std::optional<Scene> small_scene(std::string_view text);

/// Its motion; none where the simulation refuses it, or has been asked to stop after a second and
/// has. One that does not end soon after is a broken promise.
std::optional<SimulationResult> bounded_motion(const Scene& scene);

}  // namespace carom::fuzz
