// The program's font at one size, drawn by cairo as filled outlines: always the same pixels.
#pragma once

#include <string_view>
#include <vector>

#include "render/draw2d/canvas.h"

namespace carom {

struct Glyph;

/// Text as glyphs on a base line that starts at x = 0. Every digit takes the same width, so numbers
/// that change do not move what stands beside them.
struct TextRun {
    struct Place {
        const Glyph* glyph = nullptr;
        double x_px = 0;
    };
    std::vector<Place> glyphs;
    double width_px = 0;
};

/// Inter in weight Medium (src/render/fonts), without hinting and without any setting of the
/// machine. Text is UTF-8; what is not, and what the font lacks, is drawn as a box.
class Font {
  public:
    /// `size_px`: the em.
    explicit Font(double size_px);

    TextRun lay_out(std::string_view utf8) const;
    double digit_width_px() const { return digit_width_px_; }
    double size_px() const { return size_px_; }
    double cap_height_px() const { return cap_height_px_; }  ///< of H over the base line
    double descent_px() const { return 0.25 * size_px_; }    ///< room below it

    /// Fills the run with its base line starting at (x, y); a halo of `halo_px` first if any.
    void draw(Canvas& canvas, const TextRun& run, double x, double y, const Ink& ink,
              double halo_px = 0, const Ink& halo = {1, 1, 1, 1}) const;

  private:
    double size_px_ = 0;
    double digit_width_px_ = 0;
    double cap_height_px_ = 0;
};

}  // namespace carom
