// A picture of one scene: of one run, or of two of which the second is drawn as ghosts.
#pragma once

#include <memory>

#include "motion/motion.h"
#include "render/picture/options.h"
#include "render/picture/picture.h"
#include "scene/scene.h"

namespace carom {

/// `half`, if any, says that it is one of two, side by side. All must outlive the picture.
/// Failures: see Painter.
std::unique_ptr<Picture> make_single_picture(const Scene& scene, const Motion& motion,
                                             const PainterOptions& options,
                                             const PictureHalf* half = nullptr);

}  // namespace carom
