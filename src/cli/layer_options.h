// --layers: what the pixels show, in files beside the pictures.
#pragma once

#include <string>
#include <vector>

#include "cli/outputs.h"
#include "render/layers/layer_kind.h"
#include "report/layer_files.h"

namespace CLI {
class App;
}

namespace carom {

struct LayerOptions {
    std::vector<std::string> names;

    bool wanted() const { return !names.empty(); }
    /// Failure(kInput) for a name twice.
    std::vector<LayerKind> kinds() const;
};

void add_layer_option(CLI::App& command, LayerOptions& options);

/// Refuses two runs side by side, which are two pictures: Failure(kInput).
void require_one_picture(const LayerOptions& options, const SecondRun* second);

/// The first of the outputs that are frames in a folder, beside which layers go: Failure(kInput)
/// where there is none.
const OutputRequest& frames_for_layers(const std::vector<OutputRequest>& outputs);

/// "layers.json" in their folder, for a part of a film as one of several chunks
/// "layers.00120-00239.json".
std::string layer_index_path(const OutputRequest& frames, const FrameRanges& part, bool is_chunk);

/// Refuses files that exist, before any work: Failure(kOutput).
void require_new_layers(const LayerOptions& options, const OutputRequest& frames,
                        const FrameRanges& numbers, bool is_chunk, bool overwrite);

}  // namespace carom
