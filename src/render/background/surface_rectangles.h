// Lists of bodies and planes tile by tile, as the background's shader reads them: rectangles of
// tiles with the same lists, and each list once.
#pragma once

#include <array>
#include <vector>

#include "render/background/plane_tiles.h"
#include "render/background/surface_tiles.h"
#include "render/tile/screen_tiles.h"

namespace carom {

/// One bit for each body, in the table's order.
using SurfaceSet = std::vector<bool>;

/// `seen` and `shading` are the two lists of SurfaceTiles for each tile of the grid, `planes` those
/// of planes, or null where they are few and need none; `size_px` is the picture's.
SurfaceTiles joined_rectangles(const SurfaceTable& table, const ScreenTiles& grid,
                               const std::array<int, 2>& size_px,
                               const std::vector<SurfaceSet>& seen,
                               const std::vector<SurfaceSet>& shading, const PlaneTiles* planes);

}  // namespace carom
