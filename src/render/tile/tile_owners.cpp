#include "render/tile/tile_owners.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/check.h"

namespace carom {

TileOwners::TileOwners(int width_px, int height_px, int tile_px, std::size_t bodies)
    : width_px_(width_px),
      height_px_(height_px),
      tile_px_(tile_px),
      columns_((width_px + tile_px - 1) / tile_px),
      rows_((height_px + tile_px - 1) / tile_px),
      owner_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNobody),
      parent_(bodies) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
}

std::size_t TileOwners::group(std::size_t body) const {
    while (parent_[body] != body) body = parent_[body];
    return body;
}

void TileOwners::add_tile(std::size_t body, int column, int row) {
    CAROM_CHECK(column, <, columns_);
    CAROM_CHECK(row, <, rows_);
    std::size_t& owner = owner_[static_cast<std::size_t>(row * columns_ + column)];
    if (owner == kNobody) owner = body;
    if (owner == body) return;
    const std::size_t one = group(owner), other = group(body);
    parent_[std::max(one, other)] = std::min(one, other);
    owner = parent_[body] = std::min(one, other);
}

void TileOwners::add_all(std::size_t body) { add(body, 0, 0, width_px_, height_px_); }

void TileOwners::add(std::size_t body, double left_px, double top_px, double right_px,
                     double bottom_px) {
    const auto tile = [&](double px, int most) {
        return static_cast<int>(std::clamp(std::floor(px / tile_px_), -1.0, double(most)));
    };
    const int first = std::max(0, tile(left_px, columns_));
    const int last = std::min(columns_ - 1, tile(right_px, columns_));
    const int bottom = std::min(rows_ - 1, tile(bottom_px, rows_));
    for (int row = std::max(0, tile(top_px, rows_)); row <= bottom; ++row)
        for (int column = first; column <= last; ++column) add_tile(body, column, row);
}

TileMask TileOwners::tiles(const std::vector<bool>& wanted) const {
    TileMask mask(width_px_, height_px_, tile_px_);
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const std::size_t owner = owner_[static_cast<std::size_t>(row * columns_ + column)];
            if (owner != kNobody && wanted[group(owner)]) mask.add_tile(column, row);
        }
    }
    return mask;
}

}  // namespace carom
