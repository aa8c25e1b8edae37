// Rectangles found by where they lie.
#include "render/marks/taken_places.h"

#include <gtest/gtest.h>

#include <random>

namespace carom {
namespace {

TEST(TakenPlaces, FindTheFirstOneThatAskingEachWouldFind) {
    constexpr int kWidth = 300, kHeight = 200, kAround = 2;
    std::mt19937 random(5);
    const auto number = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    // Some hang out of the picture, some lie outside of it.
    const auto any = [&] {
        // In this order, one after another.
        const int left = number(-60, kWidth + 20), top = number(-60, kHeight + 20);
        const int width = number(1, 70), height = number(1, 50);
        return PixelRect::at(left, top, width, height);
    };
    std::vector<PixelRect> rects;
    for (int i = 0; i < 20; ++i) rects.push_back(any());
    TakenPlaces taken(kWidth, kHeight, rects);
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
        const PixelRect here = any();
        const PixelRect wider{here.left - kAround, here.top - kAround, here.right + kAround,
                              here.bottom + kAround};
        const auto meets = [&](const PixelRect& other) { return wider.overlaps(other); };
        const auto from = static_cast<std::size_t>(number(0, static_cast<int>(rects.size())));
        std::size_t first = from;
        while (first < rects.size() && !meets(rects[first])) ++first;
        EXPECT_EQ(first, taken.first_near(here, kAround, from, meets));
        found += first < rects.size() ? 1 : 0;
        if (i % 40 == 0) {
            rects.push_back(any());
            taken.add(rects.back());
        }
    }
    EXPECT_GT(found, 500);
    EXPECT_LT(found, 1990);
}

}  // namespace
}  // namespace carom
