// One face of a font, found by fontconfig and drawn by cairo, always the same pixels.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/canvas.h"

struct _cairo_font_face;
struct _cairo_scaled_font;

namespace carom {

inline constexpr const char* kOverlayFontFamily = "Inter";

/// Text as glyphs on a base line that starts at x = 0. Every digit takes the same width, so numbers
/// that change do not move what stands beside them.
struct TextRun {
    struct Glyph {
        unsigned long index = 0;
        double x_px = 0;
    };
    std::vector<Glyph> glyphs;
    double width_px = 0;
};

/// Grey antialiasing, no hinting, no settings of the user's font configuration.
class Font {
  public:
    /// The family in weight Medium at `size_px` (the em). Throws Failure(kRun) that names the
    /// package to install if fontconfig answers with another family.
    Font(const std::string& family, double size_px);
    ~Font();
    Font(Font&&) noexcept;
    Font& operator=(Font&&) noexcept;

    TextRun lay_out(std::string_view utf8) const;
    double digit_width_px() const { return digit_width_px_; }
    double size_px() const { return size_px_; }
    double cap_height_px() const { return cap_height_px_; }  ///< of H over the base line
    double descent_px() const { return 0.25 * size_px_; }    ///< room below it

    /// Fills the run with its base line starting at (x, y); a halo of `halo_px` first if any.
    void draw(Canvas& canvas, const TextRun& run, double x, double y, const Ink& ink,
              double halo_px = 0, const Ink& halo = {1, 1, 1, 1}) const;

  private:
    struct DestroyFace {
        void operator()(_cairo_font_face* face) const;
    };
    struct DestroyScaled {
        void operator()(_cairo_scaled_font* font) const;
    };
    std::unique_ptr<_cairo_font_face, DestroyFace> face_;
    std::unique_ptr<_cairo_scaled_font, DestroyScaled> scaled_;
    double size_px_ = 0;
    double digit_width_px_ = 0;
    double cap_height_px_ = 0;
};

}  // namespace carom
