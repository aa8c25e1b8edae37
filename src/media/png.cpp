#include "media/png.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <string_view>
#include <vector>

#include "core/check.h"
#include "core/failure.h"
#include "media/film_text.h"
#include "media/png_rows.h"
#include "media/png_writer.h"
#include "media/straight_alpha.h"

namespace carom {

namespace {

bool is_opaque(const Image& image) {
    for (std::size_t i = 3; i < image.bgra.size(); i += 4)
        if (image.bgra[i] != 255) return false;
    return true;
}

/// What stands before the pixels: head, colour space, physical size, texts.
void write_head(png_structp png, png_infop info, int width_px, int height_px, bool opaque,
                const PngNotes& notes, const std::string& texts) {
    png_set_IHDR(png, info, static_cast<png_uint_32>(width_px), static_cast<png_uint_32>(height_px),
                 8, opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
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
        write_head(png, info, image.width_px, image.height_px, opaque, notes, texts);
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
        write_head(png, info, image.width_px, image.height_px, rows.opaque(), notes, texts);
        constexpr std::size_t kChunkBytes = 1 << 20;
        for (std::size_t at = 0; at < data.size(); at += kChunkBytes)
            png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), idat + at,
                            std::min(kChunkBytes, data.size() - at));
        png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
    });
    if (!done) fail_encoding(image, writer.text());
    return std::move(writer.bytes());
}

/// All that stands before the pixels.
std::string head_bytes(int width_px, int height_px, bool opaque, const PngNotes& notes) {
    const std::string texts = text_chunks(notes);
    PngWriter writer;
    std::string* bytes = &writer.bytes();
    png_structp png = writer.png();
    png_infop info = writer.info();
    const bool done = guarded(png, [&] {
        png_set_write_fn(png, bytes, carom_png_append, nullptr);
        write_head(png, info, width_px, height_px, opaque, notes, texts);
    });
    return done ? std::move(writer.bytes()) : "";
}

/// True where `bytes` from `at` on are IDAT chunks and an IEND (PNG, third edition, 5.3), all with
/// the right checksums, and no byte more.
bool are_whole_chunks(const std::string& bytes, std::size_t at) {
    constexpr std::size_t kAround = 12;  // length, name, checksum
    const auto* data = reinterpret_cast<png_const_bytep>(bytes.data());
    bool pixels = false;
    while (bytes.size() - at >= kAround) {
        const std::size_t size = png_get_uint_32(data + at);
        if (size > bytes.size() - at - kAround) return false;
        const std::string_view name(bytes.data() + at + 4, 4);
        const uLong sum = crc32_z(0, data + at + 4, size + 4);
        if (sum != png_get_uint_32(data + at + 8 + size)) return false;
        at += size + kAround;
        if (name == "IEND") return pixels && size == 0 && at == bytes.size();
        if (name != "IDAT") return false;
        pixels = true;
    }
    return false;
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

bool is_whole_png(const std::string& path, int width_px, int height_px, const PngNotes& notes) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    for (const bool opaque : {true, false}) {
        const std::string head = head_bytes(width_px, height_px, opaque, notes);
        if (!head.empty() && bytes.starts_with(head)) return are_whole_chunks(bytes, head.size());
    }
    return false;
}

}  // namespace carom
