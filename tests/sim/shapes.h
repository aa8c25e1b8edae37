// Surfaces of any shape.
#pragma once

#include <string>

#include "scene/scene.h"

namespace carom::testing {

/// Of the material [2] of scene_of(); without a name it is numbered.
inline Surface& add_shape(Scene& scene, const SurfaceShape& shape, std::string name = "") {
    Surface surface;
    surface.name = name.empty() ? "surface" + std::to_string(scene.surfaces.size()) : name;
    surface.shape = shape;
    surface.material = 2;
    scene.surfaces.push_back(surface);
    return scene.surfaces.back();
}

}  // namespace carom::testing
