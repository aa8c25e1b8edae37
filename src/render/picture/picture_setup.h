// What a picture is made from before a driver is asked: where it is seen from, light, surfaces and
// what is written over it.
#pragma once

#include <optional>

#include "motion/motion.h"
#include "render/background/background_picture.h"
#include "render/background/surface_table.h"
#include "render/overlay/overlay.h"
#include "render/picture/options.h"
#include "render/runs/second_run.h"
#include "render/view/camera.h"
#include "render/view/lights.h"
#include "render/view/picture_scale.h"
#include "scene/scene.h"

namespace carom {

/// Stays where it was made: the overlay looks at its other members.
struct PictureSetup {
    /// `half` may be null. `scene`, `motion` and what `options` and `half` point to must outlive
    /// it.
    PictureSetup(const Scene& scene, const Motion& motion, const PainterOptions& options,
                 const PictureHalf* half);
    PictureSetup(const PictureSetup&) = delete;
    PictureSetup& operator=(const PictureSetup&) = delete;

    std::optional<BothRuns> both;  ///< where a second run is drawn as ghosts
    Camera camera;                 ///< at the motion's start
    bool moving;                   ///< the camera, from picture to picture
    Camera first;                  ///< where it is in the first picture
    View view;                     ///< of the first picture
    /// The lamp stays where it is, however the camera moves.
    Lights lights;
    SurfaceTable surfaces;
    BackgroundKind kind;  ///< of the background, wherever the camera goes
    PictureScale scale;
    OverlayPainter overlay;
};

}  // namespace carom
