// Scenes of many balls for benches of the picture, with motions that need no simulation.
#pragma once

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

struct Crowd {
    int balls = 100;
    int width_px = 1280, height_px = 720;
    double fps = 60;
    bool moving_camera = false;
    double shutter_deg = 0;
};

/// A square of striped balls over a checkered floor, all in view, with room between them.
Scene crowd_scene(const Crowd& crowd);

/// Each ball goes its own way at the same speed [m/s], and turns; 2 s long.
Motion crowd_motion(const Scene& scene, double speed);

}  // namespace carom
