// Lines with round ends, laid into one picture so that the order of drawing does not matter.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "core/types.h"
#include "render/draw2d/canvas.h"

namespace carom {

/// A pixel of one line has the largest opacity that any of its segments gives it, so joints leave
/// no mark; a pixel holds the two lines with the largest opacities, the lower number on top. Both
/// are maxima, so the picture depends on what was drawn and not on the order.
class TrailRaster {
  public:
    /// `inks` are the lines' colours; line i has colour i. Of more than 65,534 lines, neighbours
    /// share a number, and the colour of the first of them.
    TrailRaster(int width_px, int height_px, std::vector<Ink> inks);

    struct Segment {
        int line = 0;
        Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< px
        double opacity_from = 1, opacity_to = 1;      ///< 0 ... 1, linear between the ends
        double half_width = 1;                        ///< px
    };
    /// What is drawn for good stays until clear(); the rest goes with the next take_back().
    void draw(const Segment& segment, bool for_good);
    void take_back();
    void clear();

    const Image& picture() const { return picture_; }
    /// The rectangle that changed since the last call.
    PixelRect take_changed();

  private:
    struct Cell {
        std::array<std::uint16_t, 2> line{};  ///< plus 1; 0 is none
        std::array<std::uint8_t, 2> opacity{};
    };
    struct Saved {
        std::size_t index;
        Cell cell;
    };
    struct Span {
        int first, last;
    };

    static bool raise(Cell& cell, std::uint16_t line, std::uint8_t opacity);
    void blend(std::size_t index);

    std::vector<Ink> inks_;
    std::size_t lines_per_number_;
    std::vector<Cell> cells_;
    std::vector<Saved> saved_;
    Image picture_;
    PixelRect changed_;
    PixelRect passing_;  ///< what take_back() will change
};

}  // namespace carom
