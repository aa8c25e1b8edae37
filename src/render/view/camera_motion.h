// A camera that moves: what it shows as a function of the motion's time alone.
#pragma once

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// False for a camera that stands still.
bool camera_moves(const Camera& camera);

/// The camera at the instant `t` [s of the motion], one that stands still:
/// - `path`: each coordinate goes from key to key by the monotone cubic of Steffen (A simple method
///   for monotonic interpolation in one dimension, 1990): continuous with its first derivative, no
///   overshoot; at rest before the first key and after the last.
/// - `follow`: `to` is the ball's centre; with `smooth_s` its mean over smooth_s around t, weighted
///   1 + cos. `from` keeps its offset from it at the start.
/// - `orbit_deg_per_s`: that offset turns about the world's z, anticlockwise seen from above.
Camera camera_at(const Camera& camera, const Motion& motion, double t);

}  // namespace carom
