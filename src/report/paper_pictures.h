// Figures 8 and 9 of the paper as films and pictures, from the scenes inside the program.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "core/image.h"
#include "media/output_file.h"
#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// A scene of the paper and its motion by the exact method.
struct PaperRun {
    Scene scene;
    Motion motion;
};
PaperRun run_paper_scene(const std::string& name, const std::stop_token& stop);

/// Films the whole motion to `path`. Throws Failure(kRun) once `stop` is requested; what was filmed
/// until then stays as a partial film.
void film_motion(const PaperRun& run, const std::string& path, Existing existing,
                 const std::stop_token& stop);

/// Figure 8 as under a stroboscope: the fall, every tenth of a second, beside the ruler.
Image figure8_picture(const PaperRun& run);

/// Figure 9: instants side by side, left to right and then down.
Image figure9_montage(PaperRun run);

}  // namespace carom
