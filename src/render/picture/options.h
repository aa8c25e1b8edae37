// What a picture is to be like, besides its scene and motion.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/element/element.h"
#include "render/runs/second_run.h"
#include "scene/scene.h"

namespace carom {

struct DrawingContexts;

struct PainterOptions {
    int width_px = 1280;
    int height_px = 720;
    const SecondRun* second = nullptr;  ///< a run to show with the first; must outlive the painter
    /// To draw with, shared with other painters of the thread; of its own if there is none.
    std::shared_ptr<DrawingContexts> contexts = {};
    bool few_pictures = false;  ///< programs that compile soon rather than draw fast; same pixels
    /// s: no other instant will be painted last (paint_strobe()).
    std::optional<double> only_at = {};
};

/// What a half of a picture is told by the whole.
struct PictureHalf {
    PicturePart part = PicturePart::kFirstHalf;
    const SecondRun* second = nullptr;
    const BothRuns* both = nullptr;         ///< the ruler stands beside both motions
    Camera camera;                          ///< of both halves, at the motion's start
    const Motion* camera_motion = nullptr;  ///< what `camera` follows
    std::vector<PixelRect> taken{};         ///< by the whole picture, in the half's pixels
};

}  // namespace carom
