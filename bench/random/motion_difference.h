// How far two motions of the same balls are apart.
#pragma once

#include <string>
#include <vector>

#include "motion/motion.h"
#include "motion_checks.h"
#include "scene/scene.h"
#include "transforms.h"

namespace carom::bench {

/// The largest over all balls, m and m/s; speed: of centres, and radius times spin.
struct StateDifference {
    double place = 0, speed = 0;
};

/// Of `moved`, whose scene is that of `base` transformed, brought back. Balls go by names.
StateDifference difference(const Scene& scene, const Motion& base, const Motion& moved,
                           const Transform& transform, double t);

/// The first row of events that `other` lacks, has at another time (by more than `apart` [s]), or
/// has for another ball or kind; value is 0 if there is none, else 1. Partners do not count.
Worst first_other_row(const Motion& base, const Motion& other, double apart);

/// The largest ratio of a difference to the spread.
struct Deviation {
    double ratio = 0, time = 0;    ///< s
    double found = 0, spread = 0;  ///< m, or m/s
    std::string what = "m";
};

/// Of `moved` against `base` at `times`, until the `spread` of the perturbed motions exceeds
/// kLargestSpread. The spread at t is the largest up to t, and at least some roundings.
Deviation deviation(const Scene& scene, const Motion& base, const std::vector<Motion>& spread,
                    const Motion& moved, const Transform& transform,
                    const std::vector<double>& times);

}  // namespace carom::bench
