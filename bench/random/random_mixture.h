// Random scenes of all shapes: what a user may write.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace carom::bench {

/// 1 to 8 balls among planes and bodies or in free space; friction up to 5,
/// spin, any coefficient, gravity in any direction or none. With `touching` some balls begin on a
/// surface or on each other; without, all begin at gaps of at least 1e-3 m.
enum class Bodies {
    kPlain,  ///< boxes, spheres, capsules
    kRimmed  ///< shapes with round edges, at least one
};
Scene random_mixture(std::uint64_t seed, bool touching = true, Bodies bodies = Bodies::kPlain);

}  // namespace carom::bench
