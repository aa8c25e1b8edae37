// What layers.json says (docs/layers.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "report/layer_files.h"

namespace carom {

/// All but the frames: size, what the layers are, which body has which id.
std::string layer_index_head(const Scene& scene, const LayerSettings& settings);

/// One picture: files, instants, camera and balls, as one line of JSON.
std::string layer_index_frame(const Scene& scene, const Motion& motion,
                              const LayerSettings& settings, const LayerPainter& painter,
                              const std::string& picture_path,
                              const std::optional<std::int64_t>& frame,
                              const LayerInstants& instants);

/// The whole file.
std::string layer_index(const std::string& head, const std::vector<std::string>& frames);

}  // namespace carom
