// The font inside the program: its outlines, and text drawn with them.
#include "render/draw2d/font.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <thread>

#include "render/draw2d/embedded_font.h"
#include "render/draw2d/typeface.h"

namespace carom {
namespace {

/// Twice the area within a curve, by Green's theorem; exact for Bézier's third order.
double twice_area(const Glyph& glyph) {
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    double sum = 0;
    Vec2 pen = Vec2::Zero();
    for (const Glyph::Segment& segment : glyph.segments) {
        const auto& [a, b, d] = segment.points;
        switch (segment.kind) {
            case Glyph::Segment::Kind::kMove:
                pen = a;
                break;
            case Glyph::Segment::Kind::kLine:
                sum += cross(pen, a);
                pen = a;
                break;
            case Glyph::Segment::Kind::kCurve:
                sum += (6 * cross(pen, a) + 3 * cross(pen, b) + cross(pen, d) + 3 * cross(a, b) +
                        3 * cross(a, d) + 6 * cross(b, d)) /
                       10;
                pen = d;
                break;
        }
    }
    return sum;
}

struct Inked {
    double area = 0;  ///< px^2
    Vec2 center = Vec2::Zero();
};

Inked drawn(const std::string& text, double size, double x, double y) {
    Image picture(200, 200);
    Canvas canvas(picture);
    const Font font(size);
    font.draw(canvas, font.lay_out(text), x, y, {0, 0, 0, 1});
    canvas.finish();
    Inked inked;
    for (int row = 0; row < picture.height_px; ++row)
        for (int column = 0; column < picture.width_px; ++column) {
            const double cover = picture.row(row)[4 * column + 3] / 255.0;
            inked.area += cover;
            inked.center += cover * Vec2(column + 0.5, row + 0.5);
        }
    inked.center /= std::max(inked.area, 1e-9);
    return inked;
}

bool is_box(char32_t character) {
    const Glyph& glyph = overlay_typeface().glyph(character);
    const Glyph& box = overlay_typeface().glyph(0xFFFF);  // never a character
    if (glyph.segments.size() != box.segments.size()) return false;
    for (std::size_t i = 0; i < box.segments.size(); ++i)
        if (glyph.segments[i].points[0] != box.segments[i].points[0]) return false;
    return true;
}

TEST(Font, IsTheFileOfTheSourceTree) {
    std::ifstream file(CAROM_SOURCE_DIR "/src/render/fonts/Inter-Medium.otf", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    ASSERT_EQ(bytes.size(), 269'692u);
    const auto inside = embedded_font();
    EXPECT_TRUE(
        std::equal(inside.begin(), inside.end(), bytes.begin(), bytes.end(),
                   [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); }));
}

TEST(Font, HasTheDesignersMeasures) {
    // Of the file's own tables: 2816 units an em, capitals 2048 high, H 2088 wide, a digit 0 1824.
    const Font font(28.16);
    EXPECT_DOUBLE_EQ(font.cap_height_px(), 20.48);
    const Glyph& h = overlay_typeface().glyph(U'H');
    double left = 1, right = 0;
    for (const auto& segment : h.segments) {
        left = std::min(left, segment.points[0].x());
        right = std::max(right, segment.points[0].x());
    }
    fmt::print("H: advance {} units, from {} to {}\n", 2816 * h.advance_em, 2816 * left,
               2816 * right);
    EXPECT_NEAR(2816 * (h.advance_em - right), 2816 * left, 1e-9) << "H is symmetric";
    EXPECT_DOUBLE_EQ(font.lay_out("HH").width_px, 2 * 28.16 * h.advance_em);
}

TEST(Font, FillsTheAreaOfItsOutlinesAtEverySizeAndPlace) {
    // Hinting would move stems to whole pixels: areas and centres off by tenths of a pixel.
    for (const char32_t character : {U'H', U'o', U'7', U'\u2026', U'\u00b2', U'\u03b5'}) {
        std::string text(1, static_cast<char>(character));
        if (character == U'\u2026') text = "\u2026";
        if (character == U'\u00b2') text = "\u00b2";
        if (character == U'\u03b5') text = "\u03b5";
        const double em2 = 0.5 * std::abs(twice_area(overlay_typeface().glyph(character)));
        ASSERT_GT(em2, 0.005);
        for (const double size : {9.5, 13.0, 17.3, 48.0}) {
            const Inked here = drawn(text, size, 60, 120);
            const Inked moved = drawn(text, size, 60.37, 120.21);
            // cairo counts 15 x 17 points a pixel: an edge is off by up to a 30th, and outlines
            // are up to 2.4 em long. Hinted stems would be off by ten times as much.
            const double bound = 0.08 * size;
            EXPECT_NEAR(here.area, em2 * size * size, bound) << text << " " << size;
            EXPECT_NEAR(moved.center.x() - here.center.x(), 0.37, 0.09) << text << " " << size;
            EXPECT_NEAR(moved.center.y() - here.center.y(), 0.21, 0.09) << text << " " << size;
        }
    }
}

TEST(Font, HasTheLettersOfTitlesAndUnits) {
    for (const char32_t c :
         U"azAZ09 .,:;!?()+-=<>/%°µ×·\u2013\u2014\u2018\u2019\u201c\u201d\u2026"
         U"\u2212\u2248\u2260\u2264\u2265\u221e\u2190\u2191\u2192\u2193äöüßéèñçøåł"
         U"\u03b1\u03b2\u03b5\u03bc\u03c0\u03a9\u0416\u0434\u044f"
         U"\u2070\u00b9\u00b2\u00b3\u2074\u2080\u2081\u2082")
        if (c != 0) {
            EXPECT_FALSE(is_box(c)) << fmt::format("U+{:04X}", static_cast<unsigned>(c));
        }
}

TEST(Font, WhatItLacksIsAVisibleBox) {
    for (const char* text : {"\u65e5", "\u05d0", "\U0001F3C0", "\xff", "\xc3", "\t"}) {
        const Font font(24);
        const TextRun run = font.lay_out(text);
        ASSERT_EQ(run.glyphs.size(), 1u) << text;
        EXPECT_GT(run.width_px, 8) << text;
        EXPECT_GT(drawn(text, 24, 50, 100).area, 40) << text;
    }
    EXPECT_TRUE(is_box(0x65e5));
}

TEST(Font, WhatIsIgnorableTakesNoRoom) {
    const Font font(24);
    EXPECT_DOUBLE_EQ(font.lay_out("a\u200b\ufe0f\ufeffb").width_px, font.lay_out("ab").width_px);
}

TEST(Font, TextIsTakenApartAsUnicodeSays) {
    // The Unicode Standard, table 3-7 and its example of ill-formed sequences.
    const auto characters = [](std::string_view text) {
        std::u32string all;
        while (!text.empty()) all += take_character(text);
        return all;
    };
    EXPECT_EQ(characters("a\u00e9\u65e5\U0001F3C0"), U"a\u00e9\u65e5\U0001F3C0");
    EXPECT_EQ(characters("\U0010FFFF\uD7FF\uE000\x7f"), U"\U0010FFFF\uD7FF\uE000\x7f");
    EXPECT_EQ(characters("\xc0\xaf"), U"\uFFFD\uFFFD") << "longer than it need be";
    EXPECT_EQ(characters("\xe0\x80\x80"), U"\uFFFD\uFFFD\uFFFD");
    EXPECT_EQ(characters("\xf0\x8f\xbf\xbf"), U"\uFFFD\uFFFD\uFFFD\uFFFD");
    EXPECT_EQ(characters("\xed\xa0\x80"), U"\uFFFD\uFFFD\uFFFD") << "half of a pair";
    EXPECT_EQ(characters("\xf4\x90\x80\x80"), U"\uFFFD\uFFFD\uFFFD\uFFFD") << "beyond the last";
    EXPECT_EQ(characters("\xe6\x97"), U"\uFFFD\uFFFD") << "cut off";
    EXPECT_EQ(characters("\xe6z"), U"\uFFFDz");
}

TEST(Font, ThreadsShareItsOutlines) {
    const Typeface typeface;
    const auto all = [&] {
        std::vector<const Glyph*> glyphs;
        for (char32_t c = 0x20; c < 0x250; ++c) glyphs.push_back(&typeface.glyph(c));
        return glyphs;
    };
    std::vector<const Glyph*> first, second;
    std::thread a([&] { first = all(); }), b([&] { second = all(); });
    a.join();
    b.join();
    EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace carom
