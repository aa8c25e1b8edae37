// How far one motion of a scene is from another.
#pragma once

#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// All over the time from 0 to `until`. What cannot be compared is NaN: peaks where there are none.
struct MotionError {
    double position_m = 0;            ///< largest distance of a ball from where it should be
    double position_rms_m = 0;        ///< root of its mean square over balls and instants
    double position_relative = 0;     ///< position_m over the extent of the reference
    double peak_relative = 0;         ///< largest relative error of a peak's height
    int peaks = 0;                    ///< compared
    double impact_time_s = 0;         ///< largest distance of an impact from its pair's nearest
    int impacts = 0;                  ///< compared
    int impacts_missed = 0;           ///< by which a pair has fewer, summed over the pairs
    double energy_relative = 0;       ///< rms over the instants, over the largest kinetic energy
    double penetration_relative = 0;  ///< deepest overlap over the radius, impacts included
};

struct ErrorOptions {
    double until = 0;     ///< s
    int instants = 1000;  ///< between 0 and `until`
    int penetration_instants = 200;
    double slowest_impact = 0;  ///< m/s: slower ones are not looked for
    /// Peaks below this fraction of the ball's highest are not compared.
    double smallest_peak = 1e-6;
};

/// The errors of `motion` against `reference`; both are motions of `scene`.
MotionError motion_error(const Scene& scene, const Motion& reference, const Motion& motion,
                         const ErrorOptions& options);

/// Per instant (equidistant from 0 to `until`), the largest distance between the same balls, m.
std::vector<double> distances(const Motion& a, const Motion& b, double until, int instants);

/// Diagonal of the box around the balls' centres from 0 to `until`, m; the smallest radius if
/// nothing moves.
double extent_of(const Scene& scene, const Motion& motion, double until, int instants);

}  // namespace carom
