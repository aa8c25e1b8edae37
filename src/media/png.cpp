#include "media/png.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "core/check.h"
#include "core/failure.h"
#include "media/film_text.h"
#include "media/png_rows.h"
#include "media/png_writer.h"
#include "media/straight_alpha.h"

namespace carom {

namespace {

constexpr std::int64_t kMostPixels = 100'000'000;

class PngReader {
  public:
    PngReader() {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &text_, carom_png_error,
                                      carom_png_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    png_structp png() { return png_; }
    png_infop info() { return info_; }
    const char* text() const { return text_.text.data(); }

  private:
    PngText text_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

bool is_opaque(const Image& image) {
    for (std::size_t i = 3; i < image.bgra.size(); i += 4)
        if (image.bgra[i] != 255) return false;
    return true;
}

/// What stands before the pixels: head, colour space, physical size, texts.
void write_head(png_structp png, png_infop info, const Image& image, bool opaque,
                const PngNotes& notes, const std::string& texts) {
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width_px),
                 static_cast<png_uint_32>(image.height_px), 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (notes.pixels_per_m > 0) {
        const auto per_m = static_cast<png_uint_32>(std::lround(notes.pixels_per_m));
        png_set_pHYs(png, info, per_m, per_m, PNG_RESOLUTION_METER);
    }
    png_write_info(png, info);
    std::string& bytes = *static_cast<std::string*>(png_get_io_ptr(png));
    bytes += texts;
}

std::string text_chunks(const PngNotes& notes) {
    std::string bytes;
    for (const auto& [keyword, text] : notes.texts) bytes += png_text_chunk(keyword, text);
    return bytes;
}

void require_picture(const Image& image) {
    CAROM_CHECK(image.width_px, >, 0);
    CAROM_CHECK(image.height_px, >, 0);
    CAROM_CHECK(image.bgra.size(), ==,
                image.stride_bytes() * static_cast<std::size_t>(image.height_px));
}

[[noreturn]] void fail_encoding(const Image& image, const char* why) {
    throw Failure(FailureKind::kOutput, fmt::format("cannot encode a PNG of {}x{}: {}",
                                                    image.width_px, image.height_px, why));
}

/// kSmall: libpng filters and compresses.
std::string encode_small(const Image& image, const PngNotes& notes) {
    const bool opaque = is_opaque(image);
    std::vector<std::uint8_t> straight(opaque ? 0 : image.stride_bytes());
    const std::string texts = text_chunks(notes);
    PngWriter writer;
    png_structp png = writer.png();
    png_infop info = writer.info();
    std::string* bytes = &writer.bytes();

    const bool done = guarded(png, [&] {
        png_set_write_fn(png, bytes, carom_png_append, nullptr);
        constexpr std::size_t kChunkBytes = 1 << 16;
        png_set_compression_buffer_size(png, kChunkBytes);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
        png_set_compression_level(png, 9);
        write_head(png, info, image, opaque, notes, texts);
        if (opaque) {  // the fourth byte is dropped
            png_set_filler(png, 0, PNG_FILLER_AFTER);
            png_set_bgr(png);
        }
        for (int y = 0; y < image.height_px; ++y) {
            if (!opaque) straighten_row(image.row(y), straight.data(), image.width_px);
            png_write_row(png, opaque ? image.row(y) : straight.data());
        }
        png_write_end(png, nullptr);
    });
    if (!done) fail_encoding(image, writer.text());
    return std::move(writer.bytes());
}

/// kFast: libpng writes chunks whose content is there already.
std::string encode_fast(const Image& image, PngRows& rows, const PngNotes& notes) {
    const std::vector<const std::string*>& pieces = rows.compress(image);
    const std::string texts = text_chunks(notes);
    PngWriter writer;
    png_structp png = writer.png();
    png_infop info = writer.info();
    std::string* bytes = &writer.bytes();
    std::string data;
    for (const std::string* piece : pieces) data += *piece;
    const auto* idat = reinterpret_cast<png_const_bytep>(data.data());

    const bool done = guarded(png, [&] {
        png_set_write_fn(png, bytes, carom_png_append, nullptr);
        write_head(png, info, image, rows.opaque(), notes, texts);
        constexpr std::size_t kChunkBytes = 1 << 20;
        for (std::size_t at = 0; at < data.size(); at += kChunkBytes)
            png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), idat + at,
                            std::min(kChunkBytes, data.size() - at));
        png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
    });
    if (!done) fail_encoding(image, writer.text());
    return std::move(writer.bytes());
}

/// A file that closes itself.
struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using InputFile = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail_reading(const std::string& path, const std::string& why) {
    throw Failure(FailureKind::kInput, fmt::format("cannot read PNG '{}': {}", path, why));
}

/// Asks libpng for 8-bit straight BGRA, whatever the file holds.
void set_reading_transforms(png_structp png) {
    png_set_expand(png);  // palette, fewer than 8 bits, a transparent colour
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
    png_set_bgr(png);
    png_set_interlace_handling(png);
}

}  // namespace

std::string encode_png(const Image& image, PngEffort effort, const PngNotes& notes) {
    require_picture(image);
    if (effort == PngEffort::kSmall) return encode_small(image, notes);
    PngRows rows;
    return encode_fast(image, rows, notes);
}

PngEncoder::PngEncoder() : rows_(std::make_unique<PngRows>()) {}
PngEncoder::~PngEncoder() = default;

std::string PngEncoder::encode(const Image& image, const PngNotes& notes) {
    require_picture(image);
    return encode_fast(image, *rows_, notes);
}

void write_png(const std::string& path, const Image& image, PngEffort effort, Durability durability,
               Existing existing, const PngNotes& notes) {
    write_text_file(path, encode_png(image, effort, notes), durability, existing);
}

Image read_png(const std::string& path) {
    const InputFile file(std::fopen(path.c_str(), "rbe"));
    if (!file) fail_reading(path, std::strerror(errno));
    PngReader reader;
    png_structp png = reader.png();
    png_infop info = reader.info();
    std::FILE* raw_file = file.get();

    if (!guarded(png, [&] {
            png_init_io(png, raw_file);
            png_read_info(png, info);
        }))
        fail_reading(path, reader.text());
    const auto width = static_cast<std::int64_t>(png_get_image_width(png, info));
    const auto height = static_cast<std::int64_t>(png_get_image_height(png, info));
    if (width * height > kMostPixels)
        fail_reading(path, fmt::format("{}x{} is more than 100 megapixels", width, height));

    Image image(static_cast<int>(width), static_cast<int>(height));
    std::vector<png_bytep> rows;
    for (int y = 0; y < image.height_px; ++y) rows.push_back(image.row(y));
    if (!guarded(png, [&] {
            set_reading_transforms(png);
            png_read_update_info(png, info);
            if (png_get_rowbytes(png, info) != image.stride_bytes())
                png_error(png, "the samples cannot be brought to 8-bit RGBA");
            png_read_image(png, rows.data());
            png_read_end(png, nullptr);
        }))
        fail_reading(path, reader.text());

    for (std::size_t i = 0; i < image.bgra.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c)
            image.bgra[c] = premultiply(image.bgra[c], image.bgra[i + 3]);
    return image;
}

}  // namespace carom
