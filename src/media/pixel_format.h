// How a film keeps its pixels: one row each, under the names that FFmpeg gives them.
#pragma once

#include <span>
#include <string_view>

namespace carom {

enum class PixelFormat {
    kYuv420,     ///< Y'CbCr, chroma at half width and height, 8 bits
    kYuv444,     ///< the same with all of the chroma
    kYuv420Ten,  ///< 10 bits
    kYuv444Ten,
    kYuva420,     ///< with straight alpha of 8 bits, full range
    kYuva444Ten,  ///< with straight alpha of 10 bits, full range
    kRgb,         ///< three bytes R, G, B
    kRgba,        ///< four, alpha straight
    kBgr0,        ///< B, G, R and a byte that means nothing
    kBgra,        ///< alpha straight
    kPalette,     ///< one byte into a palette of at most 256 colours, one of them transparent
};

struct PixelFormatInfo {
    PixelFormat format;
    std::string_view name;  ///< FFmpeg's, and that of --pix-fmt
    int bits;               ///< of a sample
    bool yuv;               ///< Y'CbCr of BT.709, limited range; else RGB
    bool halved_chroma;     ///< so that width and height must be even
    bool alpha;             ///< keeps transparency
};

const PixelFormatInfo& pixel_format_info(PixelFormat format);

/// Null if none is called so.
const PixelFormatInfo* find_pixel_format(std::string_view name);

}  // namespace carom
