// What single pictures and films have in common.
#pragma once

#include "api/inner.h"
#include "render/painter.h"

namespace carom::v1 {

/// Throws Error for a scene that shows a second run, and for the motion of another scene.
PainterOptions painter_options(const Scene& scene, const Motion& motion);

}  // namespace carom::v1
