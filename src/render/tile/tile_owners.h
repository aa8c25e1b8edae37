// Which bodies a tile of the picture shows while the shutter is open, and so which blur together.
#pragma once

#include <cstddef>
#include <vector>

#include "render/tile/tile_mask.h"

namespace carom {

/// Joins bodies into groups: two that are seen in one tile, themselves or by their shadows or
/// mirror images, are in the same.
class TileOwners {
  public:
    TileOwners(int width_px, int height_px, int tile_px, std::size_t bodies);

    std::size_t bodies() const { return parent_.size(); }
    int tile_px() const { return tile_px_; }

    /// Everything that a rectangle touches; may reach beyond the picture.
    void add(std::size_t body, double left_px, double top_px, double right_px, double bottom_px);
    void add_all(std::size_t body);
    void add_tile(std::size_t body, int column, int row);

    /// The same for all bodies of a group.
    std::size_t group(std::size_t body) const;

    /// The tiles of the groups that are `wanted`.
    TileMask tiles(const std::vector<bool>& wanted) const;

  private:
    static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
    int width_px_, height_px_, tile_px_, columns_, rows_;
    std::vector<std::size_t> owner_;   ///< per tile: a body of its group
    std::vector<std::size_t> parent_;  ///< per body: of its group, nearer to the group's first
};

}  // namespace carom
