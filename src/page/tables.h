// Tables of a page: what happened and what it follows from.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "motion/motion.h"
#include "report/accuracy.h"
#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// A row an impact in order of time, the first kMostBounces: instant, ball, what it met, the top of
/// the gap under it afterwards, coefficient, approach speed; where the scene has a closed form, how
/// far instant and top are from it. With a sentence about that.
std::string bounce_table(const Scene& scene, const Motion& motion);
inline constexpr std::size_t kMostBounces = 3000;

/// A row for each two materials that met: how often, the coefficient, and where it comes from.
std::string pair_table(const Scene& scene, const Motion& motion);

/// What was modelled and drawn and what was not, with the reasons.
std::string effect_table(const std::map<std::string, Effect>& effects);

/// Speed beside error of each method.
std::string accuracy_table(const AccuracyReport& report);

}  // namespace carom
