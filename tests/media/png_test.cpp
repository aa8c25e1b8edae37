#include "media/png.h"

#include <png.h>

#include <csetjmp>
#include <cstdio>

#include "core/check.h"
#include "media_fixture.h"

namespace carom {
namespace {

class PngTest : public FolderTest {};

/// What another program's PNG may look like.
struct ForeignPng {
    unsigned width = 0, height = 0;
    int depth = 8;
    int colour_type = PNG_COLOR_TYPE_RGB;
    int interlace = PNG_INTERLACE_NONE;
    std::vector<png_color> palette = {};
    std::vector<png_byte> palette_alpha = {};
    std::vector<std::vector<png_byte>> rows = {};  ///< none: the file ends behind the header
};

void write_foreign(const std::string& path, ForeignPng file) {
    std::FILE* out = std::fopen(path.c_str(), "wb");
    ASSERT_NE(out, nullptr);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out);
    png_set_IHDR(png, info, file.width, file.height, file.depth, file.colour_type, file.interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!file.palette.empty())
        png_set_PLTE(png, info, file.palette.data(), static_cast<int>(file.palette.size()));
    if (!file.palette_alpha.empty())
        png_set_tRNS(png, info, file.palette_alpha.data(),
                     static_cast<int>(file.palette_alpha.size()), nullptr);
    png_write_info(png, info);
    std::vector<png_bytep> rows;
    for (auto& row : file.rows) rows.push_back(row.data());
    if (!rows.empty()) {
        png_write_image(png, rows.data());
        png_write_end(png, nullptr);
    }
    png_destroy_write_struct(&png, &info);
    std::fclose(out);
}

/// B, G, R, A of one pixel.
std::vector<int> pixel(const Image& image, int x, int y) {
    const std::uint8_t* p = image.row(y) + 4 * x;
    return {p[0], p[1], p[2], p[3]};
}

using Bgra = std::vector<int>;

TEST_F(PngTest, NoiseComesBackExactlyWithBothEfforts) {
    for (const PngEffort effort : {PngEffort::kFast, PngEffort::kSmall}) {
        const Image image = noise_image(123, 45, 1);
        write_png(in_folder("a.png"), image, effort);
        EXPECT_TRUE(read_png(in_folder("a.png")) == image);
    }
    EXPECT_EQ(names(), std::vector<std::string>{"a.png"});
}

TEST_F(PngTest, SmallestAndLongThinPicturesComeBack) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {3000, 1}}) {
        const Image image = noise_image(width, height, 2);
        write_png(in_folder("a.png"), image);
        EXPECT_TRUE(read_png(in_folder("a.png")) == image) << width << "x" << height;
    }
}

// Every premultiplied value p <= a survives the division and multiplication by alpha.
TEST_F(PngTest, EveryPremultipliedValueComesBackExactly) {
    Image image(256, 256);
    for (int a = 0; a < 256; ++a) {
        for (int p = 0; p < 256; ++p) {
            std::uint8_t* bgra = image.row(a) + 4 * p;
            bgra[0] = static_cast<std::uint8_t>(std::min(p, a));
            bgra[1] = static_cast<std::uint8_t>(std::max(0, a - p));
            bgra[2] = static_cast<std::uint8_t>(a);
            bgra[3] = static_cast<std::uint8_t>(a);
        }
    }
    write_png(in_folder("a.png"), image);
    EXPECT_TRUE(read_png(in_folder("a.png")) == image);
}

/// The header's colour type, from the file format: byte 25.
int colour_type(const std::string& png) { return static_cast<unsigned char>(png.at(25)); }

TEST_F(PngTest, AlphaIsStraightInTheFileAndOnlyThereWhenNeeded) {
    const std::string opaque = encode_png(noise_image(8, 8, 1));
    EXPECT_EQ(colour_type(opaque), PNG_COLOR_TYPE_RGB);
    EXPECT_TRUE(contains(opaque, "sRGB"));

    Image image = filled_image(1, 1, 25, 50, 100);
    image.bgra[3] = 128;
    const std::string bytes = encode_png(image);
    EXPECT_EQ(colour_type(bytes), PNG_COLOR_TYPE_RGB_ALPHA);
    png_image straight = {};
    straight.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&straight, bytes.data(), bytes.size()), 0);
    straight.format = PNG_FORMAT_RGBA;
    std::vector<png_byte> rgba(4);
    ASSERT_NE(png_image_finish_read(&straight, nullptr, rgba.data(), 0, nullptr), 0);
    EXPECT_EQ(rgba, (std::vector<png_byte>{199, 100, 50, 128}));  // 100 * 255 / 128 = 199.2
}

TEST_F(PngTest, ValuesAboveAlphaAreTakenAsFull) {
    Image image = filled_image(1, 1, 200, 10, 0);
    image.bgra[3] = 100;
    write_png(in_folder("a.png"), image);
    EXPECT_EQ(pixel(read_png(in_folder("a.png")), 0, 0), (Bgra{100, 10, 0, 100}));
}

TEST_F(PngTest, ReadsGreyPaletteAnd16Bits) {
    const std::string path = in_folder("a.png");
    ForeignPng grey{2, 1, 8, PNG_COLOR_TYPE_GRAY};
    grey.rows = {{7, 250}};
    write_foreign(path, grey);
    EXPECT_EQ(pixel(read_png(path), 1, 0), (Bgra{250, 250, 250, 255}));

    ForeignPng bits{8, 1, 1, PNG_COLOR_TYPE_GRAY};
    bits.rows = {{0b01000001}};
    write_foreign(path, bits);
    EXPECT_EQ(pixel(read_png(path), 0, 0), (Bgra{0, 0, 0, 255}));
    EXPECT_EQ(pixel(read_png(path), 7, 0), (Bgra{255, 255, 255, 255}));

    ForeignPng palette{2, 1, 8, PNG_COLOR_TYPE_PALETTE};
    palette.palette = {{10, 20, 30}, {200, 100, 50}};
    palette.palette_alpha = {255, 128};
    palette.rows = {{0, 1}};
    write_foreign(path, palette);
    EXPECT_EQ(pixel(read_png(path), 0, 0), (Bgra{30, 20, 10, 255}));
    EXPECT_EQ(pixel(read_png(path), 1, 0), (Bgra{25, 50, 100, 128}));

    ForeignPng deep{2, 1, 16, PNG_COLOR_TYPE_RGB};  // v / 257, rounded: 0x00FF is 0.99 of a step
    deep.rows = {{0x00, 0xFF, 0x80, 0x80, 0xFF, 0xFF, 0x00, 0x80, 0x00, 0x00, 0x12, 0x34}};
    write_foreign(path, deep);
    EXPECT_EQ(pixel(read_png(path), 0, 0), (Bgra{255, 128, 1, 255}));
    EXPECT_EQ(pixel(read_png(path), 1, 0), (Bgra{18, 0, 0, 255}));
}

TEST_F(PngTest, ReadsInterlaced) {
    const Image image = noise_image(37, 29, 3);
    ForeignPng file{37, 29, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7};
    for (int y = 0; y < 29; ++y) {
        std::vector<png_byte> row;
        for (int x = 0; x < 37; ++x)
            for (const int c : {2, 1, 0}) row.push_back(image.row(y)[4 * x + c]);
        file.rows.push_back(row);
    }
    write_foreign(in_folder("a.png"), file);
    EXPECT_TRUE(read_png(in_folder("a.png")) == image);
}

TEST_F(PngTest, SaysWhyAFileCannotBeRead) {
    const auto reading = [](const std::string& path) {
        const std::string text = failure_text(FailureKind::kInput, [&] { read_png(path); });
        EXPECT_TRUE(contains(text, path)) << text;
        return text;
    };
    EXPECT_TRUE(contains(reading(in_folder("missing.png")), "No such file"));
    std::ofstream(in_folder("text.png")) << "this is no picture at all, only some text";
    EXPECT_TRUE(contains(reading(in_folder("text.png")), "Not a PNG file"));
    std::ofstream(in_folder("empty.png")) << "";
    EXPECT_FALSE(reading(in_folder("empty.png")).empty());
    EXPECT_FALSE(reading(folder_.string()).empty());

    const std::string whole = encode_png(noise_image(60, 60, 1));
    for (const std::size_t length : {20UL, 40UL, whole.size() / 2, whole.size() - 20}) {
        std::ofstream(in_folder("cut.png"), std::ios::binary) << whole.substr(0, length);
        EXPECT_FALSE(reading(in_folder("cut.png")).empty()) << length;
    }
    std::string damaged = whole;
    damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 0x55);
    std::ofstream(in_folder("damaged.png"), std::ios::binary) << damaged;
    EXPECT_TRUE(contains(reading(in_folder("damaged.png")), "IDAT")) << "the checksum";
}

TEST_F(PngTest, RefusesAbsurdSizesBeforeItTakesMemory) {
    write_foreign(in_folder("huge.png"), ForeignPng{20000, 20000});
    // The begin of the pixels, as far as libpng looks before it tells the size.
    std::ofstream(in_folder("huge.png"), std::ios::binary | std::ios::app)
        << std::string("\0\0\1\0IDAT", 8);
    const std::string text =
        failure_text(FailureKind::kInput, [&] { read_png(in_folder("huge.png")); });
    EXPECT_TRUE(contains(text, "20000x20000 is more than 100 megapixels")) << text;
}

TEST_F(PngTest, AnEmptyPictureIsABug) { EXPECT_THROW(encode_png(Image()), Bug); }

TEST_F(PngTest, AFullDiskIsAFailureThatLeavesNothing) {
    const FullDisk full(1000);
    const std::string text = failure_text(
        FailureKind::kOutput, [&] { write_png(in_folder("a.png"), noise_image(64, 64, 1)); });
    EXPECT_TRUE(contains(text, in_folder("a.png"))) << text;
    EXPECT_TRUE(names().empty());
}

TEST_F(PngTest, TheSmallEffortIsSmaller) {
    const Image image = moving_picture(320, 180, 20);
    const std::size_t fast = encode_png(image, PngEffort::kFast).size();
    const std::size_t small = encode_png(image, PngEffort::kSmall).size();
    std::printf("320x180: fast %zu bytes, small %zu bytes\n", fast, small);
    EXPECT_LT(small, fast);
    EXPECT_LT(fast, image.bgra.size() / 4);
}

// Rows that are used again must not show: a frame's bytes follow from its pixels.
TEST_F(PngTest, AFrameHasTheSameBytesWhateverCameBefore) {
    std::vector<Image> frames;
    for (int k = 0; k < 6; ++k) frames.push_back(moving_picture(160, 90, k));
    frames.push_back(noise_image(160, 90, 1));
    frames.push_back(frames[5]);
    frames.push_back(frames[5]);
    Image clear = frames[5];  // one pixel is seen through, and then no more
    std::fill_n(clear.row(80), 4, std::uint8_t{0});
    frames.push_back(clear);
    frames.push_back(frames[5]);
    frames.push_back(moving_picture(96, 130, 1));
    PngEncoder encoder;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const std::string bytes = encoder.encode(frames[k]);
        EXPECT_TRUE(bytes == encode_png(frames[k])) << k;
        std::ofstream(in_folder("f.png"), std::ios::binary) << bytes;
        EXPECT_TRUE(read_png(in_folder("f.png")) == frames[k]) << k;
    }
}

TEST_F(PngTest, SaysItsSizeOnPaperAndTexts) {
    PngNotes notes;
    notes.pixels_per_m = 300 / 0.0254;
    notes.texts = {{"Time", "1.25 s"}, {"Title", "Küche"}};
    for (const PngEffort effort : {PngEffort::kFast, PngEffort::kSmall}) {
        const std::string bytes = encode_png(noise_image(16, 16, 1), effort, notes);
        // 11811 pixels a metre, both ways, in metres.
        EXPECT_TRUE(contains(bytes, std::string("pHYs\0\0\x2E\x23\0\0\x2E\x23\1", 13)));
        EXPECT_TRUE(contains(bytes, std::string("tEXtTime\0"
                                                "1.25 s",
                                                15)));
        EXPECT_TRUE(contains(bytes, std::string("iTXtTitle\0\0\0\0\0Küche", 20)));
        std::ofstream(in_folder("n.png"), std::ios::binary) << bytes;
        EXPECT_TRUE(read_png(in_folder("n.png")) == noise_image(16, 16, 1));
    }
    EXPECT_FALSE(contains(encode_png(noise_image(16, 16, 1)), "pHYs"));
}

TEST_F(PngTest, WholeIsWhatNoByteIsMissingFromOrWrongIn) {
    PngNotes notes;
    notes.texts = {{"Time", "1.25 s"}};
    Image clear = noise_image(8, 6, 1);
    std::fill_n(clear.row(2), 4, std::uint8_t{0});
    const std::string path = in_folder("w.png");
    const auto is_whole = [&](const std::string& bytes, const PngNotes& expected, int width = 8) {
        std::ofstream(path, std::ios::binary) << bytes;
        return is_whole_png(path, width, 6, expected);
    };
    for (const Image& image : {noise_image(8, 6, 1), clear}) {
        for (const PngEffort effort : {PngEffort::kFast, PngEffort::kSmall}) {
            const std::string whole = encode_png(image, effort, notes);
            EXPECT_TRUE(is_whole(whole, notes));
            EXPECT_FALSE(is_whole(whole, notes, 9));
            EXPECT_FALSE(is_whole(whole, {}));
            PngNotes later = notes, sized = notes;
            later.texts[0].second = "1.5 s";
            sized.pixels_per_m = 1;
            EXPECT_FALSE(is_whole(whole, later));
            EXPECT_FALSE(is_whole(whole, sized));
            EXPECT_FALSE(is_whole(whole + '\0', notes));
            for (std::size_t i = 0; i < whole.size(); ++i) {
                EXPECT_FALSE(is_whole(whole.substr(0, i), notes)) << i;
                std::string damaged = whole;
                damaged[i] = static_cast<char>(damaged[i] ^ 1);
                EXPECT_FALSE(is_whole(damaged, notes)) << i;
            }
        }
    }
    EXPECT_FALSE(is_whole_png(in_folder("none.png"), 8, 6, notes));
}

}  // namespace
}  // namespace carom
