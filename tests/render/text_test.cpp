// Title and caption.
#include "render/plates/text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "render/plates/clock.h"
#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

const char* const kShort = "A drop";
const char* const kLong =
    "A basketball and a tennis ball are dropped together from 1.8 m on a steel plate, and each "
    "keeps its own share of the height";

PixelRect clock_rect(Corner corner, const Size& size) {
    return ClockElement({corner, 2}, 10, size.width, size.height).rect();
}

TEST(TextElement, StaysInThePictureAndClearOfTheClock) {
    int placed = 0;
    for (const Size& size : kSizes)
        for (const Corner corner :
             {Corner::kTopLeft, Corner::kTopRight, Corner::kBottomLeft, Corner::kBottomRight})
            for (const char* text : {kShort, kLong})
                for (const bool top : {true, false}) {
                    const PixelRect clock = clock_rect(corner, size);
                    const TextElement block({text, 22, top, !top}, size.width, size.height, {clock},
                                            {});
                    const PixelRect rect = block.rect();
                    const std::string what =
                        fmt::format("{}x{}, corner {}, '{}', {}", size.width, size.height,
                                    static_cast<int>(corner), text, top ? "top" : "bottom");
                    EXPECT_TRUE(inside(rect, size)) << what;
                    EXPECT_FALSE(rect.overlaps(clock)) << what;
                    EXPECT_LE(rect.left + rect.right - size.width, 1) << what << ": not centred";
                    EXPECT_GE(rect.left + rect.right - size.width, -1) << what;
                    const double middle = rect.middle_y();
                    EXPECT_EQ(middle < 0.5 * size.height, top) << what;
                    ++placed;
                }
    EXPECT_EQ(placed, 80);
}

TEST(TextElement, AShortTitleStandsBesideTheClockInFullSize) {
    for (const Size& size : kSizes) {
        const PixelRect clock = clock_rect(Corner::kTopLeft, size);
        const TextElement title({kShort, 22, true, false}, size.width, size.height, {clock}, {});
        EXPECT_EQ(title.lines(), std::vector<std::string>{kShort});
        EXPECT_EQ(title.rect().top, clock.top);
    }
}

TEST(TextElement, LongTextIsBrokenAndNothingOfItIsLost) {
    const Size size{320, 180};
    const TextElement caption({kLong, 15, false, true}, size.width, size.height, {}, {});
    ASSERT_GT(caption.lines().size(), 1u);
    std::string joined;
    for (const std::string& line : caption.lines()) joined += (joined.empty() ? "" : " ") + line;
    EXPECT_EQ(joined, kLong);
}

TEST(TextElement, WhatHasNoRoomEndsInAnEllipsis) {
    std::string text;
    for (int i = 0; i < 80; ++i) text += "word ";
    const Size size{160, 90};
    const TextElement caption({text, 15, false, true}, size.width, size.height, {}, {});
    EXPECT_TRUE(caption.lines().back().ends_with("\u2026")) << caption.lines().back();
    EXPECT_LE(caption.rect().height(), 0.45 * size.height);
    EXPECT_TRUE(inside(caption.rect(), size));
}

TEST(TextElement, BreaksLinesAtSpacesNewlinesAndInLongWords) {
    const Font font(15);
    const double width = font.lay_out("three words here").width_px;
    EXPECT_EQ(break_lines(font, "one\ntwo", width), (std::vector<std::string>{"one", "two"}));
    EXPECT_EQ(break_lines(font, "three words here and more", width),
              (std::vector<std::string>{"three words here", "and more"}));
    const auto parts = break_lines(font, "\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9", 40);
    ASSERT_GT(parts.size(), 1u);
    std::string joined;
    for (const std::string& part : parts) {
        EXPECT_EQ(part.size() % 2, 0u) << "a character was broken";
        EXPECT_LE(font.lay_out(part).width_px, 40);
        joined += part;
    }
    EXPECT_EQ(joined.size(), 16u);
    EXPECT_TRUE(break_lines(font, "", width).empty());
}

TEST(TextElement, TheVerdictStandsBelowTheTitle) {
    // And clock, title, caption and plot are told to the labels as obstacles: the picture below is
    // the same with and without a label that would lie under the title.
    Sample sample = drop(1.8, 0.12, 3);
    sample.motion.peaks[0] = {{1.1, 1.3}};
    sample.scene.title = "A title";
    sample.scene.test = ReboundTest{0, 1.2, 1.4, false, "a rule"};
    const Size size{640, 360};
    const auto rows_of = [&](bool title) {
        sample.scene.overlay.title.reset();
        if (title) sample.scene.overlay.title = TitleOptions{};
        const OverlayPainter overlay(sample.scene, sample.motion, view_of(sample, size));
        Image picture(size.width, size.height);
        overlay.draw_over(3, picture);
        int first = 0;
        // The verdict's plate is the first row that is covered for a fifth of the width.
        for (int y = 0; y < size.height && first == 0; ++y) {
            int covered = 0;
            for (int x = 0; x < size.width; ++x) covered += alpha_at(picture, x, y) > 200;
            if (covered > size.width / 5) first = y;
        }
        return first;
    };
    const int alone = rows_of(false), below = rows_of(true);
    fmt::print("the verdict's first row: {} alone, {} below a title\n", alone, below);
    EXPECT_GT(alone, 0);
    EXPECT_GE(below, alone + 11);
}

}  // namespace
}  // namespace carom
