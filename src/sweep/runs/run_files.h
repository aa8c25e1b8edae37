// The files of one run, as the sweep's `outputs` say.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "render/painter.h"
#include "scene/document.h"
#include "scene/scene.h"
#include "sim/record/simulation_result.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// What they are made from.
struct RunContents {
    const SweepOutputs& outputs;
    const Scene& scene;
    const Node& root;  ///< the scene's document
    const SimulationResult& simulated;
};

/// To draw the pictures of many runs with, on one thread.
std::shared_ptr<DrawingContexts> make_contexts();

/// Into a folder that is there. The same bytes for the same run, on one machine. Ends early, with
/// half of it done, after a request to stop. Throws what painters and writers throw.
void write_run_files(const RunContents& run, const std::string& folder,
                     const std::shared_ptr<DrawingContexts>& contexts, const std::stop_token& stop);

/// Refuses before any run what no run can have: an encoder or library that is missing.
void require_run_files(const SweepOutputs& outputs, const Scene& scene);

}  // namespace carom
