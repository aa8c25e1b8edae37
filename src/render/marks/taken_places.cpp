#include "render/marks/taken_places.h"

#include <algorithm>

namespace carom {

namespace {

constexpr int kCellPx = 32;  // about a label

}  // namespace

TakenPlaces::TakenPlaces(int width_px, int height_px, const std::vector<PixelRect>& first)
    : columns_(std::max(1, (width_px + kCellPx - 1) / kCellPx)),
      rows_(std::max(1, (height_px + kCellPx - 1) / kCellPx)),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (const PixelRect& rect : first) add(rect);
}

/// What hangs out of the picture belongs to the cells at its edges.
TakenPlaces::Cells TakenPlaces::cells_of(const PixelRect& rect, int around) const {
    const auto clamped = [](int px, int count) {
        const int cell = px >= 0 ? px / kCellPx : -1;
        return std::clamp(cell, 0, count - 1);
    };
    return {clamped(rect.left - around, columns_), clamped(rect.right + around, columns_),
            clamped(rect.top - around, rows_), clamped(rect.bottom + around, rows_)};
}

std::vector<std::size_t>& TakenPlaces::cell(int column, int row) {
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
}

const std::vector<std::size_t>& TakenPlaces::cell(int column, int row) const {
    return const_cast<TakenPlaces*>(this)->cell(column, row);
}

void TakenPlaces::add(const PixelRect& rect) {
    const Cells cells = cells_of(rect, 0);
    for (int row = cells.first_row; row <= cells.last_row; ++row)
        for (int column = cells.first_column; column <= cells.last_column; ++column)
            cell(column, row).push_back(rects_.size());
    rects_.push_back(rect);
}

std::size_t TakenPlaces::first_near(const PixelRect& near, int around, std::size_t from,
                                    const std::function<bool(const PixelRect&)>& wanted) const {
    std::size_t found = rects_.size();
    const Cells cells = cells_of(near, around);
    for (int row = cells.first_row; row <= cells.last_row; ++row) {
        for (int column = cells.first_column; column <= cells.last_column; ++column) {
            const std::vector<std::size_t>& numbers = cell(column, row);
            for (auto number = std::lower_bound(numbers.begin(), numbers.end(), from);
                 number != numbers.end() && *number < found; ++number)
                if (wanted(rects_[*number])) found = *number;
        }
    }
    return found;
}

}  // namespace carom
