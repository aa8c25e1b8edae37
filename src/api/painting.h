// What single pictures, films and layers have in common.
#pragma once

#include <carom/second_run.h>

#include <optional>
#include <string>
#include <vector>

#include "api/inner.h"
#include "render/layers/layer_kind.h"
#include "render/painter.h"

namespace carom::v1 {

/// Throws Error for the motion of another scene.
void require_own_motion(const Scene& scene, const Motion& motion);

/// The second run of a picture: the one that is given, or what the scene names, simulated; empty
/// where there is neither. Throws Error, SceneError, Stopped.
std::optional<SecondRun> run_to_show(const Scene& scene, const Motion& motion,
                                     const std::optional<Against>& against, const Control& control);

/// `second` must outlive the painter.
PainterOptions painter_options(const Scene& scene, const std::optional<SecondRun>& second);

/// Throws Error for an unknown name, for one that stands twice, and for two runs side by side.
std::vector<LayerKind> layer_kinds_of(const std::vector<std::string>& names,
                                      const std::optional<SecondRun>& second);

}  // namespace carom::v1
