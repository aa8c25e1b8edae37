#include "media/pixel_format.h"

#include <algorithm>
#include <array>

#include "core/check.h"

namespace carom {

namespace {

constexpr std::array kFormats = {
    //                                            bits  yuv   halved alpha
    PixelFormatInfo{PixelFormat::kYuv420, "yuv420p", 8, true, true, false},
    PixelFormatInfo{PixelFormat::kYuv444, "yuv444p", 8, true, false, false},
    PixelFormatInfo{PixelFormat::kYuv420Ten, "yuv420p10le", 10, true, true, false},
    PixelFormatInfo{PixelFormat::kYuv444Ten, "yuv444p10le", 10, true, false, false},
    PixelFormatInfo{PixelFormat::kYuva420, "yuva420p", 8, true, true, true},
    PixelFormatInfo{PixelFormat::kYuva444Ten, "yuva444p10le", 10, true, false, true},
    PixelFormatInfo{PixelFormat::kRgb, "rgb24", 8, false, false, false},
    PixelFormatInfo{PixelFormat::kRgba, "rgba", 8, false, false, true},
    PixelFormatInfo{PixelFormat::kBgr0, "bgr0", 8, false, false, false},
    PixelFormatInfo{PixelFormat::kBgra, "bgra", 8, false, false, true},
    PixelFormatInfo{PixelFormat::kPalette, "pal8", 8, false, false, true},
};

}  // namespace

const PixelFormatInfo& pixel_format_info(PixelFormat format) {
    const auto found =
        std::find_if(kFormats.begin(), kFormats.end(),
                     [&](const PixelFormatInfo& info) { return info.format == format; });
    CAROM_CHECK(found != kFormats.end(), ==, true);
    return *found;
}

const PixelFormatInfo* find_pixel_format(std::string_view name) {
    const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                    [&](const PixelFormatInfo& info) { return info.name == name; });
    return found == kFormats.end() ? nullptr : &*found;
}

}  // namespace carom
