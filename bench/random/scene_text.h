// A scene as the text of a scene file, with all digits.
#pragma once

#include <string>

#include "scene/scene.h"

namespace carom::bench {

/// What the motion depends on: simulation, materials, pairs, surfaces, balls.
std::string scene_text(const Scene& scene);

}  // namespace carom::bench
