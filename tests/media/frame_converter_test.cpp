// Pictures as films keep them: closed forms, and what must not change.
#include "media/frame_converter.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "media_fixture.h"

namespace carom {
namespace {

/// A picture's planes in memory of their own.
struct Planes {
    std::vector<std::uint16_t> words[4];
    FramePlanes planes;
    Planes(int width, int height) {
        for (std::size_t i = 0; i < 4; ++i) {
            words[i].resize(static_cast<std::size_t>(width * height * 2));
            planes.data[i] = reinterpret_cast<std::uint8_t*>(words[i].data());
            planes.stride[i] = width * 4;
        }
    }
    int byte(std::size_t plane, int x, int y) const {
        return planes.data[plane][y * planes.stride[plane] + x];
    }
    int word(std::size_t plane, int x, int y) const {
        return reinterpret_cast<const std::uint16_t*>(planes.data[plane] +
                                                      y * planes.stride[plane])[x];
    }
};

/// Recommendation ITU-R BT.709-6, 3.2-3.4, in steps of 8 bits.
struct Yuv {
    double y, cb, cr;
    Yuv(double r, double g, double b) {
        const double luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        y = 16 + 219 * luma / 255;
        cb = 128 + 224 * (b - luma) / 1.8556 / 255;
        cr = 128 + 224 * (r - luma) / 1.5748 / 255;
    }
};

TEST(FrameConverter, Yuv444IsTheFormulaRounded) {
    const Image image = noise_image(64, 48, 5);
    Planes eight(64, 48), ten(64, 48);
    FrameConverter(PixelFormat::kYuv444).convert(image, {}, eight.planes);
    FrameConverter(PixelFormat::kYuv444Ten).convert(image, {}, ten.planes);
    double worst = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const std::uint8_t* p = image.row(y) + 4 * x;
            const Yuv exact(p[2], p[1], p[0]);
            const double want[] = {exact.y, exact.cb, exact.cr};
            for (std::size_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(eight.byte(c, x, y) - want[c]));
                worst = std::max(worst, std::abs(ten.word(c, x, y) - 4 * want[c]));
            }
        }
    std::printf("largest error %.4f of a step, bound 0.53\n", worst);
    EXPECT_LE(worst, 0.53);
}

TEST(FrameConverter, TenBitsOfHalvedChromaAreFourTimesEight) {
    const Image image = noise_image(64, 48, 6);
    Planes eight(64, 48), ten(64, 48);
    FrameConverter(PixelFormat::kYuv420).convert(image, {}, eight.planes);
    FrameConverter(PixelFormat::kYuv420Ten).convert(image, {}, ten.planes);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(ten.word(c, x, y), 4 * eight.byte(c, x, y), 2.6);
}

TEST(FrameConverter, AlphaIsStraightAndNothingHasTheColoursOfWhatIsNear) {
    Image image(32, 32);  // a red disc with half transparent rim on nothing
    for (int y = 12; y < 20; ++y)
        for (int x = 12; x < 20; ++x) {
            const bool rim = x == 12 || y == 12 || x == 19 || y == 19;
            std::uint8_t* p = image.row(y) + 4 * x;
            p[2] = rim ? 100 : 200;
            p[3] = rim ? 128 : 255;
        }
    Planes planes(32, 32);
    FrameConverter(PixelFormat::kYuva444Ten).convert(image, {}, planes.planes);
    const Yuv red(200, 0, 0);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            EXPECT_NEAR(planes.word(0, x, y), 4 * red.y, 4) << x << " " << y;
            const int alpha = image.row(y)[4 * x + 3];
            EXPECT_EQ(planes.word(3, x, y), std::lround(alpha * 1023 / 255.0));
        }
    const Image nothing(32, 32);
    FrameConverter(PixelFormat::kYuva444Ten).convert(nothing, {}, planes.planes);
    EXPECT_EQ(planes.word(0, 5, 5), 64);
    EXPECT_EQ(planes.word(3, 5, 5), 0);
}

TEST(FilmPalette, FewColoursAreKeptExactly) {
    const Image image = [] {
        Image made(64, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                std::uint8_t* p = made.row(y) + 4 * x;
                const int k = x / 8 + 8 * (y / 8);  // 64 colours, more than 8 apart
                p[0] = static_cast<std::uint8_t>(16 * (k % 16));
                p[1] = static_cast<std::uint8_t>(40 * (k / 16));
                p[2] = static_cast<std::uint8_t>(255 - 16 * (k % 16));
                p[3] = 255;
            }
        return made;
    }();
    FilmPalette palette;
    std::vector<std::uint8_t> indices(64 * 64);
    std::array<std::uint32_t, 256> colours{};
    palette.convert(image, indices.data(), 64, colours);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const std::uint8_t* p = image.row(y) + 4 * x;
            const std::uint32_t colour = colours[indices[static_cast<std::size_t>(64 * y + x)]];
            EXPECT_EQ(colour, 0xFF000000U | static_cast<std::uint32_t>(p[2]) << 16 |
                                  static_cast<std::uint32_t>(p[1]) << 8 | p[0]);
        }
}

// A gradient of 4096 colours in 255: the means of 4x4 blocks come out, whatever the entries are.
TEST(FilmPalette, DitherKeepsTheMean) {
    Image image(256, 256);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            std::uint8_t* p = image.row(y) + 4 * x;
            p[0] = static_cast<std::uint8_t>(x), p[1] = static_cast<std::uint8_t>(y);
            p[2] = static_cast<std::uint8_t>(255 - x / 2 - y / 2), p[3] = 255;
        }
    FilmPalette palette;
    std::vector<std::uint8_t> indices(256 * 256);
    std::array<std::uint32_t, 256> colours{};
    palette.convert(image, indices.data(), 256, colours);
    double worst = 0, mean = 0;
    for (int y = 0; y < 256; y += 4)
        for (int x = 0; x < 256; x += 4)
            for (int c = 0; c < 3; ++c) {
                int drawn = 0, shown = 0;
                for (int i = 0; i < 16; ++i) {
                    drawn += image.row(y + i / 4)[4 * (x + i % 4) + c];
                    const std::size_t at = static_cast<std::size_t>(256 * (y + i / 4) + x + i % 4);
                    shown += static_cast<int>(colours[indices[at]] >> (8 * c) & 255);
                }
                worst = std::max(worst, std::abs(drawn - shown) / 16.0);
                mean += std::abs(drawn - shown) / 16.0 / (64 * 64 * 3);
            }
    std::printf("blocks: worst %.2f, mean %.2f of 255, bounds 8 and 2\n", worst, mean);
    EXPECT_LE(worst, 8);
    EXPECT_LE(mean, 2);
}

TEST(FilmPalette, StaysUntilAFrameNeedsAnother) {
    FilmPalette palette;
    std::vector<std::uint8_t> indices(64 * 64);
    std::array<std::uint32_t, 256> first{}, second{}, third{};
    Image shifted = moving_picture(64, 64, 0);
    palette.convert(shifted, indices.data(), 64, first);
    std::rotate(shifted.bgra.begin(), shifted.bgra.begin() + 400, shifted.bgra.end());
    palette.convert(shifted, indices.data(), 64, second);
    palette.convert(noise_image(64, 64, 1), indices.data(), 64, third);
    EXPECT_EQ(first, second);
    EXPECT_NE(first, third);
    EXPECT_EQ(third[FilmPalette::kTransparent], 0U);
}

}  // namespace
}  // namespace carom
