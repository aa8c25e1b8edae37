#include "scene/looks.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/check.h"

namespace carom {

namespace {

struct StyleRow {
    LookStyle style;
    const char* word;
    const char* color;
    const char* second_color;
    double tile_m = 0.5;
};

constexpr std::array<StyleRow, 11> kStyles = {{
    {LookStyle::kPlain, "plain", "#a8adb4", "#6f757d"},
    {LookStyle::kStriped, "striped", "#c8102e", "#ffffff"},
    {LookStyle::kBasketball, "basketball", "#cf6526", "#1b1614"},
    {LookStyle::kVolleyball, "volleyball", "#f6f3e8", "#24509c"},
    {LookStyle::kFootball, "football", "#f5f5f5", "#17181a"},
    {LookStyle::kTennis, "tennis", "#c8df3f", "#fbfbf4"},
    {LookStyle::kTableTennis, "table_tennis", "#fbfbf8", "#c62f3b"},
    {LookStyle::kChecker, "checker", "#eae7e0", "#d6d2c8"},
    {LookStyle::kGrid, "grid", "#eceae4", "#b4b0a6"},
    {LookStyle::kWood, "wood", "#c39a6b", "#8a6440", 0.12},
    {LookStyle::kCourt, "court", "#d9b27c", "#f7f5f0", 0.07},
}};

/// Okabe and Ito, Color Universal Design (2008): told apart with any common colour blindness.
/// Black is left out, because it hides shading.
constexpr std::array<const char*, kPaletteSize> kPalette = {
    "#0072b2", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#56b4e9", "#f0e442"};

double hex_channel(std::string_view digits) {
    int value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value / 255.0;
}

}  // namespace

Color parse_color(const std::string& text) {
    std::string digits = text.substr(1);
    if (digits.size() == 3)
        digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
    const std::string_view view = digits;
    return {hex_channel(view.substr(0, 2)), hex_channel(view.substr(2, 2)),
            hex_channel(view.substr(4, 2))};
}

std::string color_text(const Color& color) {
    const auto code = [](double channel) { return std::lround(255 * channel); };
    return fmt::format("#{:02x}{:02x}{:02x}", code(color.r), code(color.g), code(color.b));
}

const char* style_word(LookStyle style) {
    for (const StyleRow& row : kStyles)
        if (row.style == style) return row.word;
    CAROM_CHECK(static_cast<int>(style), ==, -1);
    return "";
}

LookStyle parse_style(const std::string& word) {
    for (const StyleRow& row : kStyles)
        if (word == row.word) return row.style;
    throw Bug("no look has the style '" + word + "'");
}

Look style_look(LookStyle style) {
    for (const StyleRow& row : kStyles) {
        if (row.style != style) continue;
        Look look;
        look.style = style;
        look.color = parse_color(row.color);
        look.second_color = parse_color(row.second_color);
        look.tile_m = row.tile_m;
        return look;
    }
    throw Bug("a style of looks has no colours");
}

Look default_plane_look() { return style_look(LookStyle::kChecker); }

Look default_solid_look() { return style_look(LookStyle::kPlain); }

Look palette_look(int index) {
    Look look = style_look(LookStyle::kPlain);
    look.color = parse_color(kPalette[static_cast<std::size_t>(index % kPaletteSize)]);
    return look;
}

}  // namespace carom
