#include "render/tile/tile_mask.h"

#include <algorithm>
#include <utility>

#include "core/check.h"

namespace carom {

TileMask::TileMask(int width_px, int height_px, int tile_px)
    : width_px_(width_px),
      height_px_(height_px),
      tile_px_(tile_px),
      columns_((width_px + tile_px - 1) / tile_px),
      rows_((height_px + tile_px - 1) / tile_px),
      set_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

void TileMask::add_tile(int column, int row) {
    CAROM_CHECK(column, <, columns_);
    CAROM_CHECK(row, <, rows_);
    set_[static_cast<std::size_t>(row * columns_ + column)] = true;
}

void TileMask::add_all() { set_.assign(set_.size(), true); }

PixelRect TileMask::bounds_of(int column, int row) const {
    return {column * tile_px_, row * tile_px_, std::min(width_px_, (column + 1) * tile_px_),
            std::min(height_px_, (row + 1) * tile_px_)};
}

std::vector<TileMask::Part> TileMask::parts() const {
    std::vector<Part> parts;
    std::vector<bool> open = set_;
    std::vector<std::pair<int, int>> next;  // column, row
    const auto reach = [&](int column, int row) {
        if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
        const auto tile = static_cast<std::size_t>(row * columns_ + column);
        if (!open[tile]) return;
        open[tile] = false;
        next.emplace_back(column, row);
    };
    for (int start = 0; start < columns_ * rows_; ++start) {
        reach(start % columns_, start / columns_);
        if (next.empty()) continue;
        Part& part = parts.emplace_back();
        while (!next.empty()) {
            const auto [column, row] = next.back();
            next.pop_back();
            const PixelRect tile = bounds_of(column, row);
            part.tiles.push_back(tile);
            part.bounds = part.bounds.joined(tile);
            reach(column - 1, row);
            reach(column + 1, row);
            reach(column, row - 1);
            reach(column, row + 1);
        }
    }
    return parts;
}

}  // namespace carom
