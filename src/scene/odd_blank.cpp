#include "scene/odd_blank.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace carom {

namespace {

struct Blank {
    std::string_view bytes;
    const char* name;
};

// The blanks of Unicode that editors and web pages put in place of a space (general category Zs,
// and the one without width).
constexpr std::array kBlanks = {
    Blank{"\xC2\xA0", "a no-break space (U+00A0)"},
    Blank{"\xE2\x80\xAF", "a narrow no-break space (U+202F)"},
    Blank{"\xE2\x80\x83", "an em space (U+2003)"},
    Blank{"\xE2\x80\x82", "an en space (U+2002)"},
    Blank{"\xE2\x80\x89", "a thin space (U+2009)"},
    Blank{"\xE2\x80\x87", "a figure space (U+2007)"},
    Blank{"\xE2\x80\x8B", "a zero-width space (U+200B)"},
    Blank{"\xE3\x80\x80", "an ideographic space (U+3000)"},
    Blank{"\xEF\xBB\xBF", "a zero-width no-break space (U+FEFF)"},
};

std::string_view line_of(std::string_view text, int line) {
    for (int i = 1; i < line; ++i) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

std::optional<OddBlank> in_line(std::string_view line, int number) {
    char quote = 0;
    bool indenting = true;
    int column = 1;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (indenting && c == '\t') return OddBlank{number, column, "a tab"};
        const bool outside = quote == 0;
        if (outside && c == '#' && (i == 0 || line[i - 1] == ' ')) return std::nullopt;
        if (outside && static_cast<unsigned char>(c) >= 0x80U)  // as all of them begin
            for (const Blank& blank : kBlanks)
                if (line.substr(i).starts_with(blank.bytes))
                    return OddBlank{number, column, blank.name};
        if (c == '\'' || c == '"') quote = outside ? c : c == quote ? 0 : quote;
        indenting = indenting && c == ' ';
        if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) ++column;
    }
    return std::nullopt;
}

}  // namespace

std::optional<OddBlank> odd_blank_in_line(std::string_view text, int line) {
    return line < 1 ? std::nullopt : in_line(line_of(text, line), line);
}

std::optional<OddBlank> odd_blank_before(std::string_view text, int line) {
    if (const auto here = odd_blank_in_line(text, line)) return here;
    std::optional<OddBlank> last;
    for (int i = 1; i < line && !text.empty(); ++i) {
        const std::size_t end = text.find('\n');
        const auto found = in_line(text.substr(0, end), i);
        // Where a tab is the mistake, the parser says so in its line.
        if (found && found->name != "a tab") last = found;
        text.remove_prefix(std::min(end, text.size() - 1) + 1);
    }
    return last;
}

}  // namespace carom
