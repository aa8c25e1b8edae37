// A motion as JSON: pieces and events, from which every instant follows exactly. The format is
// described in docs/exports.md; the viewer of reports reads it.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "motion/csv.h"
#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// Writes the scene's bodies, its camera, and all pieces and events of its motion, in parts of some
/// kilobytes. Numbers have the shortest digits that read back exactly; -0 is written as 0.
/// `version` is carom's.
void write_motion_json(const Scene& scene, const Motion& motion, std::string_view version,
                       const TextSink& sink);

}  // namespace carom
