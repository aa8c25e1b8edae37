// Blanks that look like spaces and are none: tabs in front of a line, no-break spaces.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace carom {

struct OddBlank {
    int line = 0;      ///< from 1
    int column = 0;    ///< in characters, from 1
    std::string name;  ///< "a tab", "a no-break space (U+00A0)" ...
};

/// The first one in a line (counted from 1) outside quotes and comments; a tab only where the line
/// is indented with it.
std::optional<OddBlank> odd_blank_in_line(std::string_view text, int line);

/// Of a syntax error that a parser has found in `line`: the blank that it most likely stumbled
/// over, in that line, or a no-break space in one before it.
std::optional<OddBlank> odd_blank_before(std::string_view text, int line);

}  // namespace carom
