// Tiles of the picture: no place where something is seen is missed.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "render/tile/screen_tiles.h"
#include "render/tile/tile_mask.h"
#include "render/tile/tile_owners.h"
#include "render/view/view_space.h"
#include "sample_views.h"

namespace carom {
namespace {

constexpr int kTilesWidth = 200, kTilesHeight = 120;

View level_view(bool orthographic = false) {
    Camera camera = samples::pinhole(Vec3(0, -6, 1), Vec3(0, 0, 1), 40);
    if (orthographic) camera.orthographic_m = 4;
    return View(camera, kTilesWidth, kTilesHeight);
}

bool holds(const std::vector<ScreenTiles::Span>& spans, const Vec2& px) {
    const int column = static_cast<int>(std::floor(px.x() / ScreenTiles::kTilePx));
    const int row = static_cast<int>(std::floor(px.y() / ScreenTiles::kTilePx));
    for (const ScreenTiles::Span& span : spans)
        if (span.row == row && span.first_column <= column && column <= span.last_column)
            return true;
    return false;
}

// Points inside random hulls, some of which reach behind the eye: whatever is seen of them within
// the picture lies in a tile of the hull and of its bound.
TEST(ScreenTiles, HoldEveryPointOfAHull) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-4, 4), part(0, 1);
    for (const bool orthographic : {false, true}) {
        const View view = level_view(orthographic);
        const ScreenTiles tiles(view);
        int seen = 0;
        std::size_t used = 0;
        for (int turn = 0; turn < 200; ++turn) {
            std::vector<Vec3> corners;
            for (int i = 0; i < 5; ++i)
                corners.emplace_back(place(random), place(random), 3 + place(random));
            const auto spans = tiles.hull(corners, tiles.whole());
            const auto within = tiles.hull(corners, tiles.bound_of(corners));
            for (const auto& span : spans)
                used += static_cast<std::size_t>(span.last_column - span.first_column + 1);
            for (int sample = 0; sample < 50; ++sample) {
                Vec3 point = Vec3::Zero();
                double total = 0;
                for (const Vec3& corner : corners) {
                    const double weight = -std::log(1 - part(random));
                    point += weight * corner;
                    total += weight;
                }
                point /= total;
                if (!orthographic && point.z() < 1e-3) continue;
                const Vec2 px = view_pixel(view, point);
                if (px.x() < 0 || px.y() < 0 || px.x() >= kTilesWidth || px.y() >= kTilesHeight)
                    continue;
                ++seen;
                ASSERT_TRUE(holds(spans, px)) << turn;
                ASSERT_TRUE(holds(within, px)) << turn;
            }
        }
        fmt::print("{} points, {:.1f} of {} tiles a hull\n", seen, static_cast<double>(used) / 200,
                   tiles.count());
        EXPECT_GT(seen, 1000);
        EXPECT_LT(used, 200 * tiles.count()) << "all of the picture each time";
    }
}

TEST(ScreenTiles, OfWhatLiesBesideThePictureThereAreNone) {
    const ScreenTiles tiles(level_view());
    EXPECT_TRUE(tiles.hull({{50, 0, 3}, {51, 0, 3}, {50, 1, 3}}, tiles.whole()).empty());
    EXPECT_TRUE(tiles.hull({{0, 0, -3}, {1, 0, -3}}, tiles.whole()).empty()) << "behind the eye";
    const auto window = tiles.bound_of({{0, 0, -3}});
    EXPECT_GT(window.first_column, window.last_column);
}

TEST(ScreenTiles, AnOctagonHoldsItsEllipse) {
    const Vec3 center(1, 2, 3), a(0.5, 0, 0), b(0, 0.2, 0.3);
    const auto corners = octagon_around(center, a, b);
    ASSERT_EQ(8u, corners.size());
    const Vec3 normal = a.cross(b);
    double nearest = HUGE_VAL;
    for (int k = 0; k < 720; ++k) {
        const double turn = k * M_PI / 360;
        const Vec3 point = center + std::cos(turn) * a + std::sin(turn) * b;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec3 edge = corners[(i + 1) % corners.size()] - corners[i];
            const double inside = normal.cross(edge).dot(point - corners[i]);
            EXPECT_GE(inside, -1e-12);
            nearest = std::min(nearest, inside);
        }
    }
    EXPECT_LT(nearest, 1e-4) << "it touches";
}

TEST(TileMask, ItsRectanglesAreItsTiles) {
    std::mt19937 random(7);
    for (int turn = 0; turn < 50; ++turn) {
        TileMask mask(100, 70, 16);
        for (int i = 0; i < turn; ++i) {
            const int left = static_cast<int>(random() % 140) - 20;
            const int top = static_cast<int>(random() % 100) - 20;
            mask.add(PixelRect::at(left, top, static_cast<int>(random() % 30), 5));
        }
        std::vector<int> covered(100 * 70);
        for (const PixelRect& rect : mask.rects())
            for (int y = rect.top; y < rect.bottom; ++y)
                for (int x = rect.left; x < rect.right; ++x)
                    ++covered[static_cast<std::size_t>(y * 100 + x)];
        for (int y = 0; y < 70; ++y)
            for (int x = 0; x < 100; ++x)
                ASSERT_EQ(mask.has_tile(x / 16, y / 16) ? 1 : 0,
                          covered[static_cast<std::size_t>(y * 100 + x)]);
    }
    TileMask mask(100, 70, 16);
    EXPECT_TRUE(mask.empty());
    mask.add({20, 20, 21, 21});
    EXPECT_TRUE(mask.touches({31, 31, 50, 50}));
    EXPECT_FALSE(mask.touches({32, 16, 50, 50}));
    EXPECT_FALSE(mask.touches({17, 17, 17, 30})) << "empty";
    mask.add_all();
    EXPECT_EQ((std::vector<PixelRect>{{0, 0, 100, 70}}), mask.rects());
}

TEST(TileOwners, WhoSharesATileSharesAGroup) {
    TileOwners owners(64, 64, 16, 4);
    owners.add(0, 1, 1, 5, 5);      // the first tile
    owners.add(1, 20, 1, 30, 5);    // beside it
    owners.add(2, 40, 40, 50, 50);  // far away
    EXPECT_NE(owners.group(0), owners.group(1));
    owners.add(3, 10, 2, 18, 3);  // in the tiles of both
    EXPECT_EQ(owners.group(0), owners.group(1));
    EXPECT_EQ(owners.group(0), owners.group(3));
    EXPECT_NE(owners.group(0), owners.group(2));

    std::vector<bool> wanted(4, false);
    wanted[owners.group(2)] = true;
    const auto parts = owners.tiles(wanted).parts();
    ASSERT_EQ(1u, parts.size());
    EXPECT_EQ((PixelRect{32, 32, 64, 64}), parts[0].bounds);
    owners.add_all(2);
    EXPECT_EQ(owners.group(0), owners.group(2));
}

TEST(TileOwners, WhatReachesBeyondThePictureIsCutOff) {
    TileOwners owners(40, 40, 16, 2);
    owners.add(0, -100, -100, 1e9, 0.5);
    owners.add(1, -50, 100, -20, 200);  // nowhere in it
    std::vector<bool> wanted(2, false);
    wanted[owners.group(0)] = true;
    const auto parts = owners.tiles(wanted).parts();
    ASSERT_EQ(1u, parts.size());
    EXPECT_EQ((PixelRect{0, 0, 40, 16}), parts[0].bounds);
    EXPECT_NE(owners.group(0), owners.group(1));
}

}  // namespace
}  // namespace carom
