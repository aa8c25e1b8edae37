// Rectangles of pixels: what they have in common, and how those that overlap are told apart.
#include "core/pixel_rect.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace carom {
namespace {

TEST(PixelRect, IsHalfOpen) {
    const PixelRect rect = PixelRect::at(3, 5, 4, 2);
    EXPECT_EQ((PixelRect{3, 5, 7, 7}), rect);
    EXPECT_EQ(4, rect.width());
    EXPECT_EQ(2, rect.height());
    EXPECT_EQ(5.0, rect.middle_x());
    EXPECT_EQ(6.0, rect.middle_y());
    EXPECT_EQ(PixelRect::at(3, -1, 4, 2), rect.with_top(-1));
    // Neighbours share an edge but no pixel.
    EXPECT_FALSE(rect.overlaps(PixelRect::at(7, 5, 4, 2)));
    EXPECT_FALSE(rect.overlaps(PixelRect::at(3, 7, 4, 2)));
    EXPECT_TRUE(rect.overlaps(PixelRect::at(6, 6, 4, 2)));
    EXPECT_EQ(PixelRect::at(6, 6, 1, 1), rect.common(PixelRect::at(6, 6, 4, 2)));
}

TEST(PixelRect, WhatIsEmptyChangesNothing) {
    const PixelRect rect = PixelRect::at(3, 5, 4, 2), none, flat = PixelRect::at(4, 5, 0, 2);
    EXPECT_TRUE(none.empty());
    EXPECT_TRUE(flat.empty());
    EXPECT_EQ(rect, rect.joined(none));
    EXPECT_EQ(rect, none.joined(rect));
    EXPECT_FALSE(rect.overlaps(flat));
    EXPECT_EQ(PixelRect::at(0, 0, 7, 7), rect.joined(PixelRect::at(0, 0, 1, 1)));
}

// Against counting pixels, for all sets of three rectangles from a row of random ones.
TEST(PixelRect, ApartCoversTheSamePixelsAndNoneTwice) {
    std::uint32_t state = 1;
    const auto random = [&](int below) {
        state = state * 1664525 + 1013904223;
        return static_cast<int>(state >> 16) % below;
    };
    for (int turn = 0; turn < 300; ++turn) {
        std::vector<PixelRect> rects;
        for (int i = 0; i < 5; ++i)
            rects.push_back(PixelRect::at(random(12), random(12), random(5), random(5)));
        for (const std::size_t most : {std::size_t{1}, std::size_t{2}, std::size_t{9}}) {
            const std::vector<PixelRect> found = apart(rects, most);
            EXPECT_LE(found.size(), most);
            for (int y = 0; y < 17; ++y) {
                for (int x = 0; x < 17; ++x) {
                    const PixelRect pixel = PixelRect::at(x, y, 1, 1);
                    int given = 0, kept = 0;
                    for (const PixelRect& rect : rects) given += rect.overlaps(pixel) ? 1 : 0;
                    for (const PixelRect& rect : found) kept += rect.overlaps(pixel) ? 1 : 0;
                    ASSERT_LE(kept, 1);
                    ASSERT_TRUE(given == 0 || kept == 1) << x << ", " << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace carom
