#include "media/png_gray16.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

#include "core/check.h"
#include "core/failure.h"
#include "media/png_writer.h"

namespace carom {

std::string encode_gray16(int width_px, int height_px, const std::vector<std::uint16_t>& values) {
    CAROM_CHECK(values.size(), ==,
                static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    PngWriter writer;
    png_structp png = writer.png();
    png_infop info = writer.info();
    std::string* bytes = &writer.bytes();
    const std::uint16_t* first = values.data();
    const bool done = guarded(png, [&] {
        png_set_write_fn(png, bytes, carom_png_append, nullptr);
        // Ids are the same along rows and down columns.
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
        png_set_compression_level(png, 1);
        png_set_IHDR(png, info, static_cast<png_uint_32>(width_px),
                     static_cast<png_uint_32>(height_px), 16, PNG_COLOR_TYPE_GRAY,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_write_info(png, info);
        if (std::endian::native == std::endian::little) png_set_swap(png);
        for (int y = 0; y < height_px; ++y)
            png_write_row(
                png, reinterpret_cast<png_const_bytep>(
                         first + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px)));
        png_write_end(png, nullptr);
    });
    if (!done)
        throw Failure(FailureKind::kOutput, fmt::format("cannot encode a PNG of {}x{}: {}",
                                                        width_px, height_px, writer.text()));
    return std::move(writer.bytes());
}

}  // namespace carom
