// Rectangles of the picture that are taken, found by where they lie.
#pragma once

#include <functional>
#include <vector>

#include "core/pixel_rect.h"

namespace carom {

/// Keeps rectangles in the order in which they came, and asks only those near a place: the cost of
/// a question follows from what lies there, not from how many there are.
class TakenPlaces {
  public:
    /// `first`, in their order; they may hang out of the picture.
    TakenPlaces(int width_px, int height_px, const std::vector<PixelRect>& first);

    void add(const PixelRect& rect);
    std::size_t count() const { return rects_.size(); }

    /// The first from number `from` on that comes within `around` px of `near` and of which
    /// `wanted` is true; its number, or count().
    std::size_t first_near(const PixelRect& near, int around, std::size_t from,
                           const std::function<bool(const PixelRect&)>& wanted) const;
    const PixelRect& operator[](std::size_t number) const { return rects_[number]; }

  private:
    struct Cells {
        int first_column, last_column, first_row, last_row;
    };
    Cells cells_of(const PixelRect& rect, int around) const;
    std::vector<std::size_t>& cell(int column, int row);
    const std::vector<std::size_t>& cell(int column, int row) const;

    int columns_, rows_;
    std::vector<PixelRect> rects_;
    std::vector<std::vector<std::size_t>> cells_;  ///< numbers, increasing in each
};

}  // namespace carom
