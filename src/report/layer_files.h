// Layers as files beside the pictures that they belong to (docs/layers.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "media/output_file.h"
#include "render/layers/layer_painter.h"

namespace carom {

/// One picture's instants, s of the motion.
struct LayerInstants {
    double time = 0;
    std::optional<double> next, previous;  ///< of the frames after and before it
};

/// Of frame k of a film of `count` frames; of a picture at the instant t beside no film, those that
/// are a frame's time away, within the motion.
LayerInstants instants_of_frame(const Film& film, std::int64_t k, std::int64_t count);
LayerInstants instants_of_still(const Film& film, double t, double duration);

/// Refuses before the work what cannot be written: Failure(kRun) that names the package.
void require_layer_libraries(const std::vector<LayerKind>& kinds);

/// "out/frame_00012.png" and depth: "out/frame_00012.depth.exr".
std::string layer_path(const std::string& picture_path, const LayerKindInfo& kind);

class LayerFiles {
  public:
    /// `index_path`: of layers.json. `scene` and `motion` must outlive it. Fails as
    /// require_layer_libraries() and LayerPainter do.
    LayerFiles(const Scene& scene, const Motion& motion, const LayerSettings& settings,
               std::string index_path, Existing existing, Durability durability);
    ~LayerFiles();
    LayerFiles(const LayerFiles&) = delete;
    LayerFiles& operator=(const LayerFiles&) = delete;

    /// The layers of one picture; `frame`: its number, for one that has any. May be left in the
    /// middle for good: finish() knows nothing of it before add_to_index().
    void write(const std::string& picture_path, const std::optional<std::int64_t>& frame,
               const LayerInstants& instants);
    /// The picture that was written last belongs to layers.json.
    void add_to_index();
    /// Writes layers.json; must be called.
    void finish();
    double cpu_s() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace carom
