// Random scenes in air.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace carom::bench {

/// random_mixture() in still air: any density up to that of a thick gas, with or without buoyancy,
/// each ball with a law of drag and of lift, some with a spin that decays.
Scene random_air(std::uint64_t seed);

}  // namespace carom::bench
