// What pictures and films say of where they come from.
#pragma once

#include <string>

#include "media/png.h"
#include "scene/scene.h"

namespace carom {

/// "carom 0.1.0, scene 0123456789abcdef": the comment of a film.
std::string made_from(const Scene& scene);

/// Title, maker, scene and instant [s of the motion], to nine digits: instants that agree but for
/// rounding have one text.
PngNotes picture_notes(const Scene& scene, double time_s);

}  // namespace carom
