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
    const auto tile = static_cast<std::size_t>(row * columns_ + column);
    tiles_ += set_[tile] ? 0 : 1;
    set_[tile] = true;
}

void TileMask::add_all() {
    set_.assign(set_.size(), true);
    tiles_ = set_.size();
}

TileMask::Window TileMask::window_of(const PixelRect& rect) const {
    const PixelRect within = rect.common({0, 0, width_px_, height_px_});
    if (within.empty()) return {0, -1, 0, -1};
    return {within.left / tile_px_, (within.right - 1) / tile_px_, within.top / tile_px_,
            (within.bottom - 1) / tile_px_};
}

void TileMask::add(const PixelRect& rect) {
    const Window window = window_of(rect);
    for (int row = window.first_row; row <= window.last_row; ++row)
        for (int column = window.first_column; column <= window.last_column; ++column)
            add_tile(column, row);
}

bool TileMask::has_tile(int column, int row) const {
    return set_[static_cast<std::size_t>(row * columns_ + column)];
}

bool TileMask::touches(const PixelRect& rect) const {
    const Window window = window_of(rect);
    for (int row = window.first_row; row <= window.last_row; ++row)
        for (int column = window.first_column; column <= window.last_column; ++column)
            if (has_tile(column, row)) return true;
    return false;
}

std::vector<PixelRect> TileMask::rects() const {
    std::vector<PixelRect> all;
    std::vector<std::size_t> above, here;  // of the row before, and of this one
    for (int row = 0; row < rows_; ++row) {
        here.clear();
        for (int column = 0; column < columns_; ++column) {
            if (!has_tile(column, row)) continue;
            PixelRect run = bounds_of(column, row);
            while (column + 1 < columns_ && has_tile(column + 1, row)) ++column;
            run.right = bounds_of(column, row).right;
            const auto joins = std::find_if(above.begin(), above.end(), [&](std::size_t i) {
                return all[i].left == run.left && all[i].right == run.right;
            });
            if (joins != above.end()) {
                all[*joins].bottom = run.bottom;
                here.push_back(*joins);
            } else {
                here.push_back(all.size());
                all.push_back(run);
            }
        }
        above.swap(here);
    }
    return all;
}

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
