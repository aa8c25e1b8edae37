// The page of `carom report`: one run in one file that asks nothing of any network.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "render/runs/second_run.h"
#include "report/accuracy.h"
#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// What is shown of a run besides what follows from its scene and motion.
struct ReportParts {
    std::string scene_text;                       ///< the file's
    std::string film_mp4;                         ///< bytes
    std::string strobe_png;                       ///< bytes
    std::string strobe_caption;                   ///< which instants it shows
    std::map<std::string, Effect> effects;        ///< of the simulation and of the picture
    std::map<std::string, std::string> versions;  ///< of carom ("carom") and its libraries
    std::string renderer;
    std::optional<AccuracyReport> accuracy;
};

/// The whole page; `second`: null where there is no second run. The same parts give the same bytes.
/// Markings of balls are drawn with OpenGL: Failure(kRun) as painters have it.
std::string report_page(const Scene& scene, const SimulationResult& result,
                        const ReportParts& parts, const SecondRun* second);

}  // namespace carom
