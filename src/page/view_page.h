// The pages that `carom view` serves: the viewer alone, or what is wrong with the scene.
#pragma once

#include <string>

#include "page/frame.h"
#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// Viewer, plots and bounces of a run; loads itself anew when the server has another revision.
/// `second`: null where there is no second run. `known` is kept from page to page. Failure(kRun) as
/// report_page().
std::string view_page(const Scene& scene, const SimulationResult& result, const SecondRun* second,
                      const std::string& version, int revision, KnownTextures& known);

/// Until the first run of a scene has been simulated.
std::string waiting_page(const std::string& file, int revision);

/// The messages, line by line, until the scene is right again.
std::string wrong_scene_page(const std::string& file, const std::string& messages, int revision);

}  // namespace carom
