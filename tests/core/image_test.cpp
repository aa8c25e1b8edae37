#include "core/image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/check.h"

namespace carom {
namespace {

Image filled(int width, int height, std::uint8_t b, std::uint8_t g, std::uint8_t r,
             std::uint8_t a = 255) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        image.bgra[i] = b;
        image.bgra[i + 1] = g;
        image.bgra[i + 2] = r;
        image.bgra[i + 3] = a;
    }
    return image;
}

TEST(Image, RowsFollowOneAnotherWithoutPadding) {
    Image image(5, 3);
    EXPECT_EQ(image.bgra.size(), 60U);
    EXPECT_EQ(image.row(2) - image.row(1), 20);
    EXPECT_EQ(image.row(0), image.bgra.data());
}

TEST(CompareImages, EqualPicturesAreEqual) {
    const Image image = filled(7, 3, 1, 2, 3);
    const ImageDifference d = compare_images(image, image);
    EXPECT_TRUE(d.same_size);
    EXPECT_EQ(d.largest, 0);
    EXPECT_EQ(d.pixels, 21);
    EXPECT_EQ(d.differing, 0);
    EXPECT_TRUE(std::isinf(d.psnr_luma_db));
    EXPECT_TRUE((ImageTolerance{0, 0.0}.accepts(d)));
}

TEST(CompareImages, OfAnotherSizeIsAnotherPicture) {
    const ImageDifference d = compare_images(Image(4, 2), Image(2, 4));
    EXPECT_FALSE(d.same_size);
    EXPECT_FALSE((ImageTolerance{255, 1.0}.accepts(d)));
}

// All channels off by d: the luma is off by d everywhere, so PSNR = 20 log10(255 / d).
TEST(CompareImages, PsnrOfAConstantDifference) {
    for (const int off : {1, 5, 50}) {
        const auto shade = static_cast<std::uint8_t>(100 + off);
        const ImageDifference d =
            compare_images(filled(8, 8, 100, 100, 100), filled(8, 8, shade, shade, shade));
        EXPECT_NEAR(d.psnr_luma_db, 20 * std::log10(255.0 / off), 1e-9);
        EXPECT_EQ(d.largest, off);
        EXPECT_EQ(d.differing, 64);
    }
}

// One pixel of n off by d in green only: the mean square is (0.7152 d)^2 / n.
TEST(CompareImages, PsnrOfOnePixel) {
    const Image a = filled(10, 10, 0, 0, 0);
    Image b = a;
    b.row(3)[4 * 6 + 1] = 20;
    const ImageDifference d = compare_images(a, b);
    const double off = 0.7152 * 20;
    EXPECT_NEAR(d.psnr_luma_db, 10 * std::log10(255.0 * 255.0 * 100 / (off * off)), 1e-9);
    EXPECT_EQ(d.differing, 1);
    EXPECT_DOUBLE_EQ(d.differing_fraction(), 0.01);
    EXPECT_EQ(d.largest, 20);
}

// Over black pictures that differ in alpha alone are the same, over white they are not.
TEST(CompareImages, SeesAlpha) {
    const Image a = filled(2, 2, 9, 9, 9, 255), b = filled(2, 2, 9, 9, 9, 252);
    const ImageDifference d = compare_images(a, b);
    EXPECT_EQ(d.largest, 3);
    EXPECT_EQ(d.differing, 4);
    EXPECT_NEAR(20 * std::log10(255.0 / 3), d.psnr_luma_db, 1e-9);
    const Image shown = difference_image(a, b);
    EXPECT_GT(shown.row(0)[0], 40);
    EXPECT_EQ(255, shown.row(0)[3]);
}

TEST(ImageTolerance, HoldsAtItsLimitsAndNotBeyond) {
    const Image a = filled(10, 10, 50, 50, 50);
    Image b = a;
    b.row(0)[0] = 52;
    EXPECT_TRUE(ImageTolerance{}.accepts(compare_images(a, b)));  // off by 2, one in a hundred
    b.row(0)[0] = 53;
    EXPECT_FALSE(ImageTolerance{}.accepts(compare_images(a, b)));
    b.row(0)[0] = 51;
    b.row(9)[39] = 254;
    EXPECT_FALSE(ImageTolerance{}.accepts(compare_images(a, b)));  // two in a hundred
}

TEST(DifferenceImage, IsBlackWhereEqualAndShowsTheSmallestStep) {
    const Image a = filled(2, 1, 10, 20, 30);
    Image b = a;
    b.row(0)[4] = 11;   // blue by 1
    b.row(0)[6] = 230;  // red by 200
    const Image d = difference_image(a, b);
    EXPECT_EQ(d.bgra[0] + d.bgra[1] + d.bgra[2], 0);
    EXPECT_GE(d.bgra[4], 40);
    EXPECT_EQ(d.bgra[5], 0);
    EXPECT_EQ(d.bgra[6], 255);
    EXPECT_EQ(d.bgra[3], 255);
    EXPECT_EQ(d.bgra[7], 255);
}

TEST(DifferenceImage, OfAnotherSizeIsABug) {
    EXPECT_THROW(difference_image(Image(4, 2), Image(2, 4)), Bug);
}

}  // namespace
}  // namespace carom
