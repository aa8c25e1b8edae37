// Which planes the background's shader has to look at, tile by tile.
#pragma once

#include <vector>

#include "render/background/surface_table.h"
#include "render/view/picture_scale.h"

namespace carom {

/// With more planes than this it is worth looking them up: reading a list takes as long as a plane
/// or two.
inline constexpr int kFewPlanes = 8;

/// Numbers of planes (records of the table), increasing, for each tile of ScreenTiles.
struct PlaneTiles {
    std::vector<std::vector<int>> seen;     ///< that may be the nearest one there
    std::vector<std::vector<int>> shading;  ///< that may darken a crevice there
};

/// A plane that is left out is hidden by one that is listed, all over the tile and a few pixels
/// around it. Where something mirrors, all planes count everywhere.
PlaneTiles sort_planes_into_tiles(const SurfaceTable& table, const View& view,
                                  const PictureScale& scale);

}  // namespace carom
