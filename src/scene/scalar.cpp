#include "scene/scalar.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace carom {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Number of digits at the front of `text`.
std::size_t digits_at_front(std::string_view text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
    return static_cast<std::size_t>(end - text.begin());
}

/// [-+]? ( \. [0-9]+ | [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?
bool is_decimal(std::string_view text) {
    if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
    const std::size_t whole = digits_at_front(text);
    text.remove_prefix(whole);
    std::size_t fraction = 0;
    if (!text.empty() && text[0] == '.') {
        text.remove_prefix(1);
        fraction = digits_at_front(text);
        text.remove_prefix(fraction);
    }
    if (whole + fraction == 0) return false;
    if (text.empty()) return true;
    if (text[0] != 'e' && text[0] != 'E') return false;
    text.remove_prefix(1);
    if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
    return !text.empty() && digits_at_front(text) == text.size();
}

/// 0o17 and 0x1F; false if `text` is neither.
bool read_based_integer(std::string_view text, Scalar& scalar) {
    if (text.size() < 3 || text[0] != '0' || (text[1] != 'o' && text[1] != 'x')) return false;
    const int base = text[1] == 'o' ? 8 : 16;
    unsigned long long value = 0;
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data() + 2, end, value, base);
    if (result.ptr != end) return false;
    const bool fits = result.ec == std::errc();
    scalar.kind = fits ? Scalar::Kind::kNumber : Scalar::Kind::kNotFinite;
    scalar.number = static_cast<double>(value);
    return true;
}

void read_decimal(std::string_view text, Scalar& scalar) {
    if (text[0] == '+') text.remove_prefix(1);  // from_chars takes no plus sign
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool fits = result.ec == std::errc() && std::isfinite(value);
    scalar.kind = fits ? Scalar::Kind::kNumber : Scalar::Kind::kNotFinite;
    scalar.number = value;
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

}  // namespace

bool Scalar::integral() const { return kind == Kind::kNumber && number == std::floor(number); }

Scalar resolve_scalar(const std::string& text, bool quoted) {
    Scalar scalar;
    if (quoted || text.empty()) return scalar;
    if (is_one_of(text, {"true", "True", "TRUE", "false", "False", "FALSE"})) {
        scalar.kind = Scalar::Kind::kBool;
        scalar.boolean = text[0] == 't' || text[0] == 'T';
        return scalar;
    }
    std::string_view unsigned_text = text;
    if (text[0] == '-' || text[0] == '+') unsigned_text.remove_prefix(1);
    if (is_one_of(unsigned_text, {".inf", ".Inf", ".INF"}) ||
        is_one_of(text, {".nan", ".NaN", ".NAN"})) {
        scalar.kind = Scalar::Kind::kNotFinite;
        return scalar;
    }
    if (read_based_integer(text, scalar)) return scalar;
    if (is_decimal(text)) read_decimal(text, scalar);
    return scalar;
}

std::string number_text(double value) {
    const std::string plain = fmt::format("{}", value);
    std::string powers = fmt::format("{:g}", value);  // 1e+09, of which people write 1e9
    const std::size_t e = powers.find('e');
    if (e == std::string::npos) return plain;
    const std::size_t digits = powers.find_first_not_of("+-0", e + 1);
    powers = powers.substr(0, e + 1) + (powers[e + 1] == '-' ? "-" : "") + powers.substr(digits);
    double back = 0;
    std::from_chars(powers.data(), powers.data() + powers.size(), back);
    return back == value && powers.size() <= plain.size() ? powers : plain;
}

std::string quoted_excerpt(const std::string& text) {
    constexpr std::size_t kLongest = 80;
    std::string excerpt = text.substr(0, kLongest);
    // Never end inside a UTF-8 sequence.
    while (excerpt.size() < text.size() && !excerpt.empty() &&
           (static_cast<unsigned char>(text[excerpt.size()]) & 0xC0U) == 0x80U)
        excerpt.pop_back();
    const bool cut = excerpt.size() < text.size();
    std::replace(excerpt.begin(), excerpt.end(), '\n', ' ');
    return fmt::format("'{}{}'", excerpt, cut ? "..." : "");
}

bool is_name(const std::string& text) {
    if (text.empty() || text.size() > kMaxNameLength || is_digit(text[0]) || text[0] == '-')
        return false;
    return std::all_of(text.begin(), text.end(), [](char c) {
        return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
               c == '-';
    });
}

}  // namespace carom
