// Triangles of bodies, for programs that draw triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.h"
#include "geometry/shape.h"

namespace carom {

/// Corners with their normals, and triangles as triples of corners, anticlockwise from outside.
struct Mesh {
    std::vector<Vec3> positions;  ///< m
    std::vector<Vec3> normals;    ///< unit
    std::vector<Vec2> places;     ///< in a texture, 0 ... 1 from its top left corner; may be empty
    std::vector<std::uint32_t> triangles;
    bool two_sided = false;  ///< a wall without thickness
};

/// A ball of radius 1 with the places of BallTextures (render/texture/ball_texture.h).
Mesh unit_sphere();

/// A surface in world coordinates. Of a plane the square of which `middle` is the nearest point's
/// middle, `reach` [m] to each side. Round shapes have so many corners that the sagitta of a chord
/// is below 1 % of the radius.
Mesh surface_mesh(const SurfaceShape& shape, const Vec3& middle, double reach);

}  // namespace carom
