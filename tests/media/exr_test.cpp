// EXR files of floats: what is kept of the picture before changes no byte.
// (tests/cli/test_layers.py reads them back.)
#include "media/exr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "media/png_gray16.h"

namespace carom {
namespace {

FloatImage waves(double phase) {
    FloatImage image(150, 70, 3);
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y)[c] = c == 1 && x > 70
                                        ? std::numeric_limits<float>::infinity()
                                        : static_cast<float>(std::sin(0.1 * (x + c * y) + phase));
    return image;
}

const ExrEncoder::Changed kAll = [](const PixelRect&) { return true; };

TEST(Exr, BytesDoNotDependOnThePictureBefore) {
    const std::vector<std::string> names = {"R", "G", "B"};
    ExrEncoder encoder(names);
    encoder.encode(waves(0), kAll);
    FloatImage image = waves(0);
    image.at(100, 3)[2] = 7;  // in the second tile of three
    const std::string partly = encoder.encode(
        image, [](const PixelRect& tile) { return PixelRect::at(100, 3, 1, 1).overlaps(tile); });
    EXPECT_EQ(ExrEncoder(names).encode(image, kAll), partly);
    EXPECT_NE(ExrEncoder(names).encode(waves(0), kAll), partly);
}

TEST(Exr, WhatIsSaidNotToHaveChangedIsNotReadAgain) {
    ExrEncoder encoder({"R", "G", "B"});
    const std::string before = encoder.encode(waves(0), kAll);
    EXPECT_EQ(before, encoder.encode(waves(1), [](const PixelRect&) { return false; }));
}

TEST(Gray16, IsAPngOfThatKind) {
    const std::string bytes = encode_gray16(3, 2, {0, 1, 2, 256, 65535, 7});
    EXPECT_EQ("\x89PNG", bytes.substr(0, 4));
    EXPECT_EQ(16, bytes[24]);
    EXPECT_EQ(0, bytes[25]);
}

}  // namespace
}  // namespace carom
