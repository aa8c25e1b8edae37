// Square tiles of the picture in which something moves.
#pragma once

#include <cstddef>
#include <vector>

#include "core/pixel_rect.h"

namespace carom {

class TileMask {
  public:
    TileMask(int width_px, int height_px, int tile_px);

    void add_all();
    void add_tile(int column, int row);
    /// Every tile that a rectangle touches, which may reach beyond the picture.
    void add(const PixelRect& rect);

    bool has_tile(int column, int row) const;
    /// Whether a rectangle touches one of them.
    bool touches(const PixelRect& rect) const;
    bool empty() const { return tiles_ == 0; }
    /// Of the picture's tiles, 0 ... 1.
    double share() const { return static_cast<double>(tiles_) / static_cast<double>(set_.size()); }

    /// Tiles that hang together.
    struct Part {
        PixelRect bounds;              ///< of all of them, within the picture
        std::vector<PixelRect> tiles;  ///< within the picture
    };
    /// All tiles, each in one part; bounds of parts may overlap.
    std::vector<Part> parts() const;

    /// All tiles as rectangles that do not overlap, within the picture: runs of a row, joined with
    /// equal ones below.
    std::vector<PixelRect> rects() const;

  private:
    struct Window {
        int first_column, last_column, first_row, last_row;
    };
    Window window_of(const PixelRect& rect) const;
    PixelRect bounds_of(int column, int row) const;

    std::size_t tiles_ = 0;  ///< that are set
    int width_px_, height_px_, tile_px_, columns_, rows_;
    std::vector<bool> set_;
};

}  // namespace carom
