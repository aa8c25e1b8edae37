// What a picture is made from before a driver is asked: where it is seen from, light, surfaces and
// what is written over it.
#pragma once

#include <optional>

#include "motion/motion.h"
#include "render/camera.h"
#include "render/lights.h"
#include "render/overlay.h"
#include "render/painter.h"
#include "render/picture_scale.h"
#include "render/static_picture.h"
#include "render/surface_table.h"
#include "render/two_runs.h"
#include "scene/scene.h"

namespace carom {

/// Stays where it was made: the overlay looks at its other members.
struct PictureSetup {
    /// `scene`, `motion` and what `options` point to must outlive it.
    PictureSetup(const Scene& scene, const Motion& motion, const PainterOptions& options);
    PictureSetup(const PictureSetup&) = delete;
    PictureSetup& operator=(const PictureSetup&) = delete;

    std::optional<JoinedRuns> joined;  ///< where a second run is drawn as ghosts
    Camera camera;                     ///< at the motion's start
    bool moving;                       ///< the camera, from picture to picture
    Camera first;                      ///< where it is in the first picture
    View view;                         ///< of the first picture
    /// The lamp stays where it is, however the camera moves.
    Lights lights;
    SurfaceTable surfaces;
    StaticKind kind;  ///< of the static picture, wherever the camera goes
    PictureScale scale;
    OverlayPainter overlay;
};

}  // namespace carom
