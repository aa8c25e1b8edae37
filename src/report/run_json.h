// What statistics tell of a run, as JSON.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "motion/motion.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// Name -> `on` and `why`.
nlohmann::ordered_json effects_json(const std::map<std::string, Effect>& effects);
/// Ball -> `peaks`: a list of `time` [s] and `height` [m].
nlohmann::ordered_json peaks_json(const Motion& motion);

}  // namespace carom
