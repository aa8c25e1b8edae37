// Two PNG files measured row by row: as whole pictures are.
#include "media/png_measures.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

#include "core/failure.h"
#include "media/png.h"
#include "media/png_gray16.h"
#include "media/png_text.h"
#include "media_fixture.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

class PngMeasures : public FolderTest {
  protected:
    std::string path(const char* name) const { return (folder_ / name).string(); }

    std::string written(const char* name, const Image& image) const {
        write_png(path(name), image);
        return path(name);
    }
};

/// Noise of `seed`; opaque, or seen through from the row `clear_from` on.
Image noise(int width, int height, unsigned seed, int clear_from) {
    std::mt19937 random(seed);
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* pixel = image.row(y) + 4 * x;
            pixel[3] = static_cast<std::uint8_t>(y < clear_from ? 255 : random() % 256);
            for (int c = 0; c < 3; ++c)
                pixel[c] = static_cast<std::uint8_t>(random() % (pixel[3] + 1U));
        }
    return image;
}

void expect_equal(const ImageMeasures& a, const ImageMeasures& b) {
    EXPECT_EQ(a.same_size, b.same_size);
    EXPECT_EQ(a.largest, b.largest);
    EXPECT_EQ(a.pixels, b.pixels);
    EXPECT_EQ(a.differing, b.differing);
    EXPECT_EQ(a.psnr_db, b.psnr_db);
    EXPECT_EQ(a.psnr_luma_db, b.psnr_luma_db);
    EXPECT_EQ(a.ssim, b.ssim);
}

TEST_F(PngMeasures, RowByRowAsTheWholePictures) {
    // Wider and higher than a band and a block of windows; as narrow as no window fits.
    for (const auto& [width, height] :
         {std::pair{1100, 300}, {75, 31}, {11, 11}, {5, 200}, {300, 3}})
        for (const int clear_from : {height, height / 2}) {
            const Image a = noise(width, height, 1, clear_from);
            Image b = a;
            for (const int x : {0, width / 2, width - 1}) {
                b.row(height - 1)[4 * x + 1] ^= 1;
                b.row(height / 3)[4 * x] ^= 3;
            }
            const std::string one = written("a.png", a), other = written("b.png", b);
            const ImageMeasures measures = measure_pngs(one, other);
            expect_equal(measure_difference(read_any_png(one), read_any_png(other)), measures);
            EXPECT_LT(0, measures.differing);
            EXPECT_TRUE(measure_pngs(one, one).identical());
            EXPECT_EQ(1, measure_pngs(one, one).ssim);
        }
}

TEST_F(PngMeasures, EightBitsBesideSixteen) {
    const std::string deep = path("deep.png");
    std::vector<std::uint16_t> values(20 * 13, 257 * 7);
    values[30] = 257 * 7 + 128;
    write_text_file(deep, encode_gray16(20, 13, values), Durability::kUnsynced, Existing::kReplace);
    Image flat(20, 13);
    for (std::size_t i = 0; i < flat.bgra.size(); ++i)
        flat.bgra[i] = i % 4 == 3 ? std::uint8_t{255} : std::uint8_t{7};
    const ImageMeasures measures = measure_pngs(deep, written("flat.png", flat));
    EXPECT_EQ(1, measures.differing);
    EXPECT_NEAR(128.0 / 257, measures.largest, 1e-12);
}

TEST_F(PngMeasures, DamageIsFoundAlsoBehindWhatTells) {
    const Image picture = noise(64, 64, 2, 64);
    const std::string whole = written("a.png", picture), torn = written("b.png", picture);
    fs::resize_file(torn, fs::file_size(torn) - 40);
    const std::string small = written("c.png", noise(8, 8, 3, 8));
    EXPECT_THROW(measure_pngs(whole, torn), Failure);
    EXPECT_THROW(measure_pngs(torn, whole), Failure);
    EXPECT_THROW(measure_pngs(torn, torn), Failure);
    EXPECT_THROW(measure_pngs(small, torn), Failure);
    EXPECT_FALSE(measure_pngs(small, whole).same_size);
    EXPECT_THROW(measure_pngs(whole, path("none.png")), Failure);
}

TEST(PngText, IsFoundByItsWholeKeyword) {
    const std::string bytes = encode_png(
        Image(3, 2), PngEffort::kSmall,
        {.texts = {{"Renderers", "two"}, {"Renderer", "one (256 bits)"}, {"Title", "Fu\xc3\x9f"}}});
    EXPECT_EQ("one (256 bits)", text_in_png(bytes, "Renderer"));
    EXPECT_EQ("Fu\xc3\x9f", text_in_png(bytes, "Title"));  // as iTXt
    EXPECT_EQ("", text_in_png(bytes, "Render"));
    for (std::size_t size = 0; size < bytes.size(); ++size)
        text_in_png(std::string_view(bytes).substr(0, size), "Title");
    EXPECT_EQ("", text_in_png("no PNG at all, but longer than its head", "Title"));
}

}  // namespace
}  // namespace carom
