#include "core/excerpt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/readable.h"

namespace carom {

namespace {

constexpr std::size_t kMostShown = 100;  // characters of a line
constexpr std::size_t kBefore = 60;      // of these before the place, where both ends are cut

/// The characters of a line, each as it may be shown in one column.
std::vector<std::string> shown_characters(std::string_view line) {
    std::vector<std::string> characters;
    for (std::size_t i = 0; i < line.size();) {
        const std::size_t length = utf8_length(line, i);
        const std::string_view character = line.substr(i, std::max<std::size_t>(1, length));
        if (character == "\t")
            characters.emplace_back(" ");
        else
            characters.emplace_back(readable(character) == character ? character : "?");
        i += character.size();
    }
    return characters;
}

bool is_word(const std::string& character) {
    const auto c = static_cast<unsigned char>(character.front());
    return character.size() > 1 || std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
}

/// A line of which only a part may be worth looking at, and the column that the part begins with.
struct LinePart {
    std::string_view text;
    int from = 1;
};

/// Of a line of megabytes as much as is shown on either side of the place, and more.
LinePart part_around(std::string_view line, int column) {
    constexpr std::size_t kEnough = 4 * 2 * kMostShown;  // characters have up to four bytes
    const auto length = [line](std::size_t at) {
        return std::max<std::size_t>(1, utf8_length(line, at));
    };
    const auto is_inside = [line](std::size_t at) {
        return at < line.size() && (static_cast<unsigned char>(line[at]) & 0xC0U) == 0x80U;
    };
    std::size_t at = 0;
    int here = 1;
    for (; here < column && at < line.size(); ++here) at += length(at);
    std::size_t first = at - std::min(at, kEnough), last = std::min(line.size(), at + kEnough);
    while (first > 0 && first < at && is_inside(first)) ++first;
    while (last < line.size() && is_inside(last)) ++last;
    for (std::size_t i = first; i < at; i += length(i)) --here;
    return {line.substr(first, last - first), here};
}

}  // namespace

std::string_view first_line(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return text.substr(0, text.find_first_of("\r\n"));
}

std::string_view after_first_line(std::string_view text) {
    const std::size_t end = text.find_first_of("\r\n");
    if (end == std::string_view::npos) return {};
    return text.substr(end + (text.substr(end, 2) == "\r\n" ? 2 : 1));
}

std::string excerpt(std::string_view line, SourceMark mark) {
    if (line.empty() || mark.line <= 0 || mark.column <= 0) return "";
    const LinePart part = part_around(line, mark.column);
    const std::vector<std::string> all = shown_characters(part.text);
    const std::size_t at = std::min(static_cast<std::size_t>(mark.column - part.from), all.size());
    std::size_t first = 0, last = all.size();
    if (all.size() > kMostShown) {
        first = std::min(at - std::min(at, kBefore), all.size() - kMostShown);
        last = first + kMostShown;
    }
    std::string shown = first > 0 ? "..." : "", under(shown.size(), ' ');
    for (std::size_t i = first; i < last; ++i) shown += all[i];
    if (last < all.size()) shown += "...";
    under += std::string(at - first, ' ') + "^";
    for (std::size_t i = at; i + 1 < last && is_word(all[i]) && is_word(all[i + 1]); ++i)
        under += '~';
    const std::string number = fmt::format("{:>5}", mark.line);
    return fmt::format("{} | {}\n{} | {}\n", number, shown, std::string(number.size(), ' '), under);
}

}  // namespace carom
