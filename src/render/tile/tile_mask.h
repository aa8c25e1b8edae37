// Square tiles of the picture in which something moves.
#pragma once

#include <vector>

#include "core/pixel_rect.h"

namespace carom {

class TileMask {
  public:
    TileMask(int width_px, int height_px, int tile_px);

    void add_all();
    void add_tile(int column, int row);

    /// Tiles that hang together.
    struct Part {
        PixelRect bounds;              ///< of all of them, within the picture
        std::vector<PixelRect> tiles;  ///< within the picture
    };
    /// All tiles, each in one part; bounds of parts may overlap.
    std::vector<Part> parts() const;

  private:
    PixelRect bounds_of(int column, int row) const;

    int width_px_, height_px_, tile_px_, columns_, rows_;
    std::vector<bool> set_;
};

}  // namespace carom
