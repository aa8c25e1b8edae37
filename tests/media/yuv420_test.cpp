#include "media/yuv420.h"

#include "core/check.h"
#include "media_fixture.h"

namespace carom {
namespace {

struct Planes {
    std::vector<std::uint8_t> y, cb, cr;
};

Planes convert(const Image& image) {
    const auto width = static_cast<std::size_t>(image.width_px);
    const auto height = static_cast<std::size_t>(image.height_px);
    Planes planes{std::vector<std::uint8_t>(width * height),
                  std::vector<std::uint8_t>(width * height / 4),
                  std::vector<std::uint8_t>(width * height / 4)};
    Yuv420Converter converter;
    converter.convert(image, {planes.y.data(), planes.cb.data(), planes.cr.data(), image.width_px,
                              image.width_px / 2, image.width_px / 2});
    return planes;
}

struct Ycc {
    double y, cb, cr;
};

/// BT.709, in real numbers.
Ycc bt709(double b, double g, double r) {
    const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    return {16 + 219 * y / 255, 128 + 224 * (b - y) / 1.8556 / 255,
            128 + 224 * (r - y) / 1.5748 / 255};
}

void expect_everywhere(const Planes& planes, int y, int cb, int cr) {
    for (const int value : planes.y) ASSERT_EQ(value, y);
    for (const int value : planes.cb) ASSERT_EQ(value, cb);
    for (const int value : planes.cr) ASSERT_EQ(value, cr);
}

TEST(Yuv420, ThePureColoursOfBt709) {
    expect_everywhere(convert(filled_image(10, 4, 0, 0, 255)), 63, 102, 240);
    expect_everywhere(convert(filled_image(10, 4, 0, 255, 0)), 173, 42, 26);
    expect_everywhere(convert(filled_image(10, 4, 255, 0, 0)), 32, 240, 118);
    expect_everywhere(convert(filled_image(10, 4, 0, 0, 0)), 16, 128, 128);
    expect_everywhere(convert(filled_image(10, 4, 255, 255, 255)), 235, 128, 128);
}

TEST(Yuv420, EveryGreyHasNoChroma) {
    for (int v = 0; v < 256; ++v) {
        const auto grey = static_cast<std::uint8_t>(v);
        const int y = static_cast<int>(std::lround(16 + 219 * v / 255.0));
        expect_everywhere(convert(filled_image(2, 2, grey, grey, grey)), y, 128, 128);
    }
}

// Every sample against the filter and the matrix in real numbers. Widths around the vector length.
TEST(Yuv420, NoiseIsRoundedToNearest) {
    double worst = 0;
    for (const int width : {2, 4, 14, 16, 30, 64, 130, 640}) {
        const int height = 6;
        const Image image = noise_image(width, height, static_cast<unsigned>(width));
        const Planes planes = convert(image);
        const auto channel = [&](int x, int y, int c) {
            return double{static_cast<double>(image.row(y)[4 * std::max(0, x) + c])};
        };
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Ycc exact = bt709(channel(x, y, 0), channel(x, y, 1), channel(x, y, 2));
                const auto i = static_cast<std::size_t>(y * width + x);
                worst = std::max(worst, std::abs(planes.y[i] - exact.y));
            }
        for (int y = 0; y < height / 2; ++y)
            for (int x = 0; x < width / 2; ++x) {
                double mean[3] = {};
                for (int c = 0; c < 3; ++c)
                    for (const int row : {2 * y, 2 * y + 1})
                        mean[c] += (channel(2 * x - 1, row, c) + 2 * channel(2 * x, row, c) +
                                    channel(2 * x + 1, row, c)) /
                                   8;
                const Ycc exact = bt709(mean[0], mean[1], mean[2]);
                const auto i = static_cast<std::size_t>(y * width / 2 + x);
                worst = std::max(
                    {worst, std::abs(planes.cb[i] - exact.cb), std::abs(planes.cr[i] - exact.cr)});
            }
    }
    std::printf("largest error %.4f of a step, bound 0.51\n", worst);
    EXPECT_GT(worst, 0.3);  // noise does reach the middle between two steps
    EXPECT_LT(worst, 0.51);
}

TEST(Yuv420, ChromaLiesOnTheLeftSample) {
    // Red from x = 4 on: the sample on x = 4 sees a quarter of black, the one on x = 2 none of red.
    Image image = filled_image(8, 2, 0, 0, 0);
    for (int y = 0; y < 2; ++y)
        for (int x = 4; x < 8; ++x) image.row(y)[4 * x + 2] = 255;
    const Planes planes = convert(image);
    EXPECT_EQ(planes.cr[1], 128);
    EXPECT_EQ(planes.cr[2], 128 + 84);  // 3/4 of 112
    EXPECT_EQ(planes.cr[3], 240);
}

TEST(Yuv420, RespectsStrides) {
    const Image image = noise_image(6, 4, 1);
    const Planes packed = convert(image);
    std::vector<std::uint8_t> y(10 * 4, 7), cb(5 * 2, 7), cr(9 * 2, 7);
    Yuv420Converter converter;
    converter.convert(image, {y.data(), cb.data(), cr.data(), 10, 5, 9});
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t x = 0; x < 10; ++x)
            EXPECT_EQ(y[row * 10 + x], x < 6 ? packed.y[row * 6 + x] : 7);
    for (std::size_t row = 0; row < 2; ++row) {
        for (std::size_t x = 0; x < 5; ++x)
            EXPECT_EQ(cb[row * 5 + x], x < 3 ? packed.cb[row * 3 + x] : 7);
        for (std::size_t x = 0; x < 9; ++x)
            EXPECT_EQ(cr[row * 9 + x], x < 3 ? packed.cr[row * 3 + x] : 7);
    }
}

TEST(Yuv420, OddSizesAreABug) {
    Yuv420Converter converter;
    EXPECT_THROW(converter.convert(Image(3, 2), {}), Bug);
    EXPECT_THROW(converter.convert(Image(2, 3), {}), Bug);
}

}  // namespace
}  // namespace carom
