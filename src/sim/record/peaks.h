// How high the balls came between two impacts.
#pragma once

#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// Per ball, the tops of the gap under it: after each impact with a surface that faces up (normal
/// n, -g . n > 0) the largest n . (x(t) - point) - r until the ball's next impact or the end, if
/// that is a true top (the speed along n passes through 0 there; the last one must lie before the
/// end). For a ball in free flight that is v^2 / (2 g_n), v its separation speed along n and g_n =
/// -g . n. Reads the motion's pieces and events (in order of time), nothing else.
std::vector<std::vector<Peak>> find_peaks(const Scene& scene, const Motion& motion);

}  // namespace carom
