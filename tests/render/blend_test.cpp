// What the processor does with a picture: codes of light, means, layers and mirror images.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/balls/mirror_blend.h"
#include "render/blend/alpha_encoding.h"
#include "render/blend/linear_layer.h"
#include "render/blend/srgb.h"
#include "render/tile/tile_mask.h"

namespace carom {
namespace {

// IEC 61966-2-1, written down once more.
double encoded(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

TEST(Srgb, EncodesToTheNearestCode) {
    const SrgbEncoder& encode = srgb_encoder();
    for (int i = 0; i <= 100'000; ++i) {
        const double linear = i / 100'000.0, exact = encoded(linear);
        ASSERT_LE(std::abs(exact - encode(linear)), 0.5 + 1e-3) << linear;
    }
    EXPECT_EQ(0, encode(-0.5));
    EXPECT_EQ(255, encode(1.5));
}

TEST(Srgb, EveryCodeComesBack) {
    const SrgbEncoder& encode = srgb_encoder();
    for (std::size_t code = 0; code < 256; ++code)
        EXPECT_EQ(code, encode(srgb_decoding()[code])) << code;
}

TEST(Srgb, BetweenCodesItIsTheStandards) {
    double worst = 0;
    for (int i = 0; i <= 100'000; ++i) {
        const double code = i / 100'000.0;
        worst = std::max(worst, std::abs(srgb_decoded(code) - linear_from_srgb(code)));
    }
    fmt::print("off by {:.2g}\n", worst);
    EXPECT_LT(worst, 6e-6);
    // The straight part and the curve meet.
    EXPECT_NEAR(linear_from_srgb(0.04045), linear_from_srgb(0.0404501), 1e-7);
    EXPECT_EQ(1.0, linear_from_srgb(1.0));
}

TEST(TileMask, PartsHoldEveryTileOnce) {
    TileMask mask(100, 60, 16);  // 7 x 4 tiles, those at the ends cut off
    mask.add_tile(0, 0);
    mask.add_tile(0, 1);
    mask.add_tile(1, 1);
    mask.add_tile(2, 0);  // touches by a corner alone
    mask.add_tile(6, 3);
    const auto parts = mask.parts();
    ASSERT_EQ(3u, parts.size());
    EXPECT_EQ(3u, parts[0].tiles.size());
    EXPECT_EQ(32, parts[0].bounds.right);
    EXPECT_EQ(32, parts[0].bounds.bottom);
    EXPECT_EQ(100, parts[2].bounds.right);
    EXPECT_EQ(60, parts[2].bounds.bottom);
    EXPECT_EQ(4, parts[2].tiles[0].width());
    EXPECT_EQ(12, parts[2].tiles[0].height());
    mask.add_all();
    ASSERT_EQ(1u, mask.parts().size());
    EXPECT_EQ(28u, mask.parts()[0].tiles.size());
}

// Half of white over black, and over white: in linear light, not in codes.
TEST(LinearLayer, BlendsLight) {
    Image layer(2, 1), target(2, 1);
    layer.bgra = {128, 128, 128, 128, 0, 0, 0, 128};
    target.bgra = {0, 0, 0, 255, 255, 255, 255, 255};
    lay_over_in_linear_light(layer, 0, 0, target);
    const double part = 128 / 255.0;
    EXPECT_NEAR(encoded(part), target.bgra[0], 0.51);
    EXPECT_NEAR(encoded(1 - part), target.bgra[4], 0.51);
    EXPECT_EQ(255, target.bgra[3]);
}

TEST(LinearLayer, TheFilledPartHoldsAllThatIsNotClear) {
    Image layer(9, 7);
    EXPECT_TRUE(filled_part(layer).empty());
    layer.row(2)[4 * 3 + 3] = 1;
    EXPECT_EQ(PixelRect::at(3, 2, 1, 1), filled_part(layer));
    layer.row(5)[4 * 8 + 3] = 255;
    EXPECT_EQ((PixelRect{3, 2, 9, 6}), filled_part(layer));
}

// A viewer that blends codes, over white: for a grey shadow it sees what light would show, to the
// rounding of two codes; over black it sees the colour itself.
TEST(AlphaEncoding, GreyIsRightOverWhiteAndBlack) {
    double worst = 0;
    for (int alpha = 1; alpha < 255; ++alpha) {
        for (const double light : {0.0, 0.2, 0.7}) {
            const double cover = alpha / 255.0;
            Image picture(1, 1);
            const std::uint8_t code = srgb_encoder()(light * cover);
            picture.bgra = {code, code, code, static_cast<std::uint8_t>(alpha)};
            encode_alpha(picture);
            ASSERT_EQ(code, picture.bgra[0]) << "over black";
            ASSERT_GE(picture.bgra[3], code) << "premultiplied";
            const double seen = picture.bgra[0] + 255.0 - picture.bgra[3];
            const double exact = encoded(srgb_decoding()[code] + 1 - cover);
            worst = std::max(worst, std::abs(seen - exact));
        }
    }
    fmt::print("off by {:.2f} codes\n", worst);
    EXPECT_LE(worst, 0.51);
}

TEST(AlphaEncoding, WhatIsOpaqueOrNothingStays) {
    Image picture(2, 1);
    picture.bgra = {10, 20, 30, 255, 0, 0, 0, 0};
    const Image before = picture;
    encode_alpha(picture);
    EXPECT_EQ(before, picture);
}

// Straight down on a mirror 2 m below the eye: what it mirrors goes where an image hides it, and of
// the image comes what the mirror gives back at that angle.
TEST(MirrorBlend, ExchangesTheMirroredLight) {
    Camera camera;
    camera.from = {0, 0, 2};
    camera.to = {0, 1e-3, 0};
    const View view(camera, 9, 9);
    Mirror mirror;
    mirror.normal = {0, 0, -1};
    mirror.offset = -2;
    mirror.strength = 0.5;

    MirrorPart part;
    part.left_px = part.top_px = 4;
    part.width_px = part.height_px = 1;
    const std::uint32_t depth = std::bit_cast<std::uint32_t>(2.0F);
    part.g_buffer = {depth, depth, 1023U << 20, 0};
    part.mirrored = {0.01F, 0.02F, 0.03F, 1e30F};  // R, G, B
    part.images = {0.5F, 0.3F, 0.1F, 1.0F};        // R, G, B
    part.picture = {120, 120, 120, 255};
    const MirrorPart before = part;
    blend_images(mirror, view, 10, part);
    const double share = 0.5 * 0.06;
    for (std::size_t c = 0; c < 3; ++c) {
        const double light = srgb_decoding()[120] - static_cast<double>(before.mirrored[2 - c]) +
                             share * static_cast<double>(before.images[2 - c]);
        EXPECT_NEAR(encoded(light), part.picture[c], 0.51);
    }

    // Nothing where no image is, and where another body stands before the mirror.
    part = before;
    part.images[3] = 0;
    blend_images(mirror, view, 10, part);
    EXPECT_EQ(before.picture, part.picture);
    part = before;
    part.g_buffer[0] = part.g_buffer[1] = std::bit_cast<std::uint32_t>(1.5F);
    blend_images(mirror, view, 10, part);
    EXPECT_EQ(before.picture, part.picture);
    // Half of a pixel at whose edge the mirror ends, nearer to the eye than what is behind it.
    part = before;
    part.g_buffer = {depth, std::bit_cast<std::uint32_t>(3.0F), 512U << 20, 0};
    part.mirrored = {0, 0, 0, 1e30F};
    blend_images(mirror, view, 10, part);
    EXPECT_NEAR(encoded(srgb_decoding()[120] + 0.5 * share * 0.5), part.picture[2], 0.51);
}

}  // namespace
}  // namespace carom
