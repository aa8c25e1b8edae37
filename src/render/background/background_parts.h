// What the parts of a background have to do with, so that each is drawn by the shortest program.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "render/background/surface_table.h"
#include "render/background/surface_tiles.h"
#include "render/tile/tile_mask.h"

namespace carom {

/// Kinds of bodies, as bits.
inline constexpr unsigned kBoxes = 1, kSpheres = 2, kOthers = 4;
unsigned bodies_in(const SurfaceTable& table);

/// What is seen there, if it is not just anything: one plane, the sky, or both.
enum class PartView { kAny, kGround, kHorizon, kSky };

/// One program draws all parts of a kind.
struct PartKind {
    unsigned bodies = 0;
    PartView seen = PartView::kAny;
    bool detailed = true;  ///< with the G-buffer; without, the colour alone
    bool operator<(const PartKind& other) const {
        return std::tie(bodies, seen, detailed) <
               std::tie(other.bodies, other.seen, other.detailed);
    }
};

/// Rectangles as SurfaceTiles has them, by kind.
using BackgroundParts = std::map<PartKind, std::vector<float>>;

/// Where nothing but one plane is seen, the rectangles are divided further: `detailed` are the
/// tiles that need the G-buffer, null for all. Same pixels, however they are divided.
BackgroundParts divided(const SurfaceTiles& tiles, const SurfaceTable& table, const View& view,
                        const TileMask* detailed);

}  // namespace carom
