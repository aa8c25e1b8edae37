// Which bodies and planes the background's shader has to look at, part of the picture by part.
#pragma once

#include <vector>

#include "render/background/surface_table.h"
#include "render/view/lights.h"
#include "render/view/picture_scale.h"

namespace carom {

/// Rectangles that cover the picture once, each with two lists of bodies (boxes, spheres, others
/// of the table): those that rays through its pixels may meet or pass by within a pixel, and those
/// that may take light from what is seen there. Bodies that are not listed would change
/// nothing.
struct SurfaceTiles {
    /// Per rectangle: left, top, right, bottom [px]; of either list the first entry and where its
    /// boxes, spheres and others end (whole numbers); first entry and end of either list of
    /// planes. Planes are listed where there are more than kFewPlanes.
    std::vector<float> rectangles;
    static constexpr int kRectangleFloats = 16;
    /// A vec4 per entry: x is the record in the table. One more at the end, so that the shader can
    /// read where an empty list begins.
    std::vector<float> entries;
};

SurfaceTiles sort_into_tiles(const SurfaceTable& table, const View& view, const Lights& lights,
                             const PictureScale& scale);

/// One rectangle, in which all bodies count.
SurfaceTiles all_bodies_everywhere(const SurfaceTable& table, const View& view);

}  // namespace carom
