// The outlines of the program's font, read by FreeType and independent of it otherwise.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.h"

namespace carom {

/// One character as filled curves: points in ems, x to the right from where the pen stands, y up
/// from the base line. The winding rule tells what is inside.
struct Glyph {
    struct Segment {
        enum class Kind { kMove, kLine, kCurve };  ///< with 1, 1, 3 points: Bézier's third order
        Kind kind = Kind::kMove;
        std::array<Vec2, 3> points;
    };
    std::vector<Segment> segments;
    double advance_em = 0;  ///< from where the pen stands to where the next one starts
};

/// Takes the first character off the text. A byte that begins no well-formed sequence (The Unicode
/// Standard, table 3-7) is U+FFFD. The text must not be empty.
char32_t take_character(std::string_view& utf8);

/// The font inside the program. Outlines are taken as the designer drew them, in the font's own
/// units, without hinting and without FreeType's rasterizer: the same numbers from every version.
class Typeface {
  public:
    /// Failure(kRun) with FreeType's number if the font cannot be read.
    Typeface();
    ~Typeface();
    Typeface(const Typeface&) = delete;
    Typeface& operator=(const Typeface&) = delete;

    /// Stays as long as the typeface. A character that the font lacks is its box with a cross; one
    /// that Unicode wants to be ignored where it is not known is nothing. Safe from any thread.
    const Glyph& glyph(char32_t character) const;

    /// Family and style by the font's own name table.
    std::string name() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// One for the process, read when text is first laid out.
const Typeface& overlay_typeface();

}  // namespace carom
