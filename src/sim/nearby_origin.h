// Scenes far from the origin of their coordinates: they are simulated as seen from a place nearby.
#pragma once

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// The place from which a scene is best seen [m]: zero where its bodies stand about the origin, as
/// far as their distances go; else the middle of its balls and bounded surfaces, so that what
/// happens does not drown in the rounding of large coordinates. Its coordinates are
/// multiples of a power of two, so that subtracting them loses nothing.
Vec3 nearby_origin(const Scene& scene);

/// The same scene in coordinates that count from `origin`: balls and surfaces, nothing else.
Scene seen_from(const Scene& scene, const Vec3& origin);

/// A motion seen from there, in the scene's own coordinates again.
void move_back(Motion& motion, const Vec3& origin);

/// m: what the rounding of a scene's own coordinates leaves open about its bodies' places when they
/// are seen from `origin`.
double place_rounding(const Vec3& origin);

}  // namespace carom
