// Rectangles found by where they lie.
#include "render/overlay_places.h"

#include <gtest/gtest.h>

#include <random>

namespace carom {
namespace {

using Rect = OverlayPainter::Rect;

TEST(TakenPlaces, FindTheFirstOneThatAskingEachWouldFind) {
    constexpr int kWidth = 300, kHeight = 200, kAround = 2;
    std::mt19937 random(5);
    const auto number = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    // Some hang out of the picture, some lie outside of it.
    const auto any = [&] {
        return Rect{number(-60, kWidth + 20), number(-60, kHeight + 20), number(1, 70),
                    number(1, 50)};
    };
    std::vector<Rect> rects;
    for (int i = 0; i < 20; ++i) rects.push_back(any());
    TakenPlaces taken(kWidth, kHeight, rects);
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
        const Rect here = any();
        const Rect wider{here.x - kAround, here.y - kAround, here.width + 2 * kAround,
                         here.height + 2 * kAround};
        const auto meets = [&](const Rect& other) { return wider.overlaps(other); };
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
