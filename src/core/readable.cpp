#include "core/readable.h"

#include <fmt/format.h>

namespace carom {

namespace {

/// A path may have 4096 bytes; a message holds one or two, and none needs all of it.
constexpr std::size_t kLongestMessage = 1000;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

char32_t decoded(std::string_view text, std::size_t i, std::size_t length) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (length == 1) return lead;
    char32_t code = lead & (0xFFU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k)
        code = code << 6U | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    return code;
}

/// Controls of C0 and C1, line separators, and what turns the direction of reading (Unicode
/// Standard Annex 9, section 2).
bool must_be_escaped(char32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
           code == 0x200E || code == 0x200F || code == 0x61C ||
           (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) ||
           code == 0xFEFF;
}

std::string escaped(char32_t code) {
    if (code == '\n') return "\\n";
    if (code == '\r') return "\\r";
    if (code == '\t') return "\\t";
    if (code < 0x80) return fmt::format("\\x{:02x}", static_cast<unsigned>(code));
    return fmt::format("\\u{:04x}", static_cast<unsigned>(code));
}

/// The text without its middle: two thirds of what may stay are from the front, where a message
/// says what was attempted; the reason stands at the end.
std::string shortened(const std::string& text, std::size_t longest) {
    if (text.size() <= longest) return text;
    std::size_t front = longest * 2 / 3, back = text.size() - (longest - front);
    while (front > 0 && is_continuation(text[front])) --front;
    while (back < text.size() && is_continuation(text[back])) ++back;
    return text.substr(0, front) + "..." + text.substr(back);
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t i) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (lead < 0x80) return 1;
    std::size_t length = 0;
    if (lead >= 0xC2 && lead <= 0xDF) length = 2;
    if (lead >= 0xE0 && lead <= 0xEF) length = 3;
    if (lead >= 0xF0 && lead <= 0xF4) length = 4;
    if (length == 0 || i + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if (!is_continuation(text[i + k])) return 0;
    const auto second = static_cast<unsigned char>(text[i + 1]);
    const bool wrong = (lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
                       (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F);
    return wrong ? 0 : length;
}

std::string readable(std::string_view text, std::size_t longest) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text, i);
        if (length == 0) {
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i++]));
            continue;
        }
        const char32_t code = decoded(text, i, length);
        if (must_be_escaped(code))
            result += escaped(code);
        else
            result += text.substr(i, length);
        i += length;
    }
    return shortened(result, longest);
}

std::string readable_message(std::string_view text) { return readable(text, kLongestMessage); }

}  // namespace carom
