// One scene's run for a page: simulated, filmed, measured.
#pragma once

#include <optional>
#include <string>

#include "cli/interrupt.h"
#include "cli/options.h"
#include "page/report_page.h"
#include "render/runs/second_run.h"
#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

struct ReportedRun {
    Scene scene;
    SimulationResult result;
    ReportParts parts;
    std::optional<SecondRun> ghosts;  ///< the second run, where it has the same surfaces
};

struct ReportWishes {
    bool film = true;  ///< false: the picture alone
    int width_px = 0;  ///< the largest of pictures; 0: the scene's
    bool accuracy = false;
    double budget_s = 5;  ///< CPU seconds of a row of it
};

/// Simulates and films a scene in memory, with all that the page shows; empty where the scene is
/// invalid, which has been said. Progress and findings go to standard error.
std::optional<ReportedRun> run_for_report(const std::string& path, const CommonOptions& options,
                                          const ReportWishes& wishes, const Interrupt& interrupt);

}  // namespace carom
