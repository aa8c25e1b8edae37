// Convex bounds of the bodies of a surface table.
#pragma once

#include <array>
#include <vector>

#include "render/background/surface_table.h"

namespace carom {

/// A body in view space: the convex hull of cores, widened by `thick`.
struct SurfaceBound {
    std::vector<Vec3>
        cores;  ///< corners of a box or around a cylinder, middle of a sphere, ends of a capsule
    std::array<Vec3, 3> axes{};  ///< unit: those of the body, or of view space
    double thick = 0;            ///< 0 for a box
    Vec3 center = Vec3::Zero();
    double radius = 0;  ///< of a sphere around everything
    bool box = false;
    bool mirrors = false;
    bool shades_itself = false;  ///< a hollow body

    /// Points whose hull holds the body made wider by `around` [m].
    std::vector<Vec3> corners(double around) const;
};

/// In the table's order: boxes, spheres, others.
std::vector<SurfaceBound> surface_bounds(const SurfaceTable& table);

}  // namespace carom
