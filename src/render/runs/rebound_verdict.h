// Whether the ball of a drop test passes: printed by the commands, drawn in the last frames.
#pragma once

#include <optional>
#include <string>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// What became of a scene's test.
struct ReboundVerdict {
    bool rebounded = false;  ///< false: no rebound's top within the motion
    bool passes = false;
    double height_m = 0;  ///< of the first rebound, measured as the test says
    double time_s = 0;    ///< of its top
};

/// Empty where the scene has no test.
std::optional<ReboundVerdict> judge_rebound(const Scene& scene, const Motion& motion);

/// "basketball does not pass (FIBA): rebound to its top 1.529 m, not 1.2 to 1.4 m". `scene` has a
/// test.
std::string verdict_text(const Scene& scene, const ReboundVerdict& verdict);

}  // namespace carom
