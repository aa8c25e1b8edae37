// Scenes put together from parts.
#pragma once

#include <fmt/core.h>

#include <optional>

#include "scene/scene.h"
#include "scene/virtual_body.h"

namespace carom::bench {

/// Adds a material; its index. Friction of none is not named at all.
inline int add_material(Scene& scene, double restitution, std::optional<double> friction) {
    Material m;
    m.name = fmt::format("m{}", scene.materials.size());
    m.virtual_body = virtual_body_for(restitution, scene.simulation.restitution_constant);
    m.friction = friction;
    scene.materials.push_back(m);
    return static_cast<int>(scene.materials.size()) - 1;
}

/// A scene with the default material alone.
inline Scene empty_scene(double duration, const Vec3& gravity) {
    Scene scene;
    scene.materials.resize(1);
    scene.simulation.duration = duration;
    scene.simulation.gravity = gravity;
    return scene;
}

inline void add_surface(Scene& scene, const SurfaceShape& shape, int material) {
    Surface s;
    s.name = fmt::format("s{}", scene.surfaces.size());
    s.shape = shape;
    s.material = material;
    scene.surfaces.push_back(s);
}

inline Ball& add_ball(Scene& scene, double radius, const Vec3& position, int material) {
    Ball b;
    b.name = fmt::format("b{}", scene.balls.size());
    b.radius = radius;
    b.position = position;
    b.material = material;
    scene.balls.push_back(b);
    return scene.balls.back();
}

}  // namespace carom::bench
