#include "media/frame_converter.h"

#include <array>
#include <cstring>

namespace carom {

void FrameConverter::convert(const Image& image, const FramePlanes& planes) {
    if (info_.format == PixelFormat::kPalette) return convert_palette(image, planes);
    if (!info_.yuv) return convert_rgb(image, planes);
    const Image* source = &image;
    if (info_.alpha) {
        straight_alpha_.convert(image, straight_);
        if (planes.data[3] != nullptr)
            copy_alpha(straight_, info_.bits, planes.data[3], planes.stride[3]);
        source = &straight_;
    }
    if (info_.bits == 8 && info_.halved_chroma)
        yuv420_.convert(*source, {planes.data[0], planes.data[1], planes.data[2], planes.stride[0],
                                  planes.stride[1], planes.stride[2]});
    else
        convert_yuv(*source, info_.bits, info_.halved_chroma, planes);
}

void FrameConverter::convert_rgb(const Image& image, const FramePlanes& planes) {
    const Image* source = &image;
    if (info_.alpha) {
        straighten_image(image, straight_);
        source = &straight_;
    }
    const bool red_first = info_.format == PixelFormat::kRgb || info_.format == PixelFormat::kRgba;
    const int bytes = info_.format == PixelFormat::kRgb ? 3 : 4;
    for (int y = 0; y < image.height_px; ++y) {
        const std::uint8_t* p = source->row(y);
        std::uint8_t* out = planes.data[0] + y * planes.stride[0];
        if (!red_first) {
            std::memcpy(out, p, image.stride_bytes());
            continue;
        }
        for (int x = 0; x < image.width_px; ++x, p += 4, out += bytes) {
            out[0] = p[2], out[1] = p[1], out[2] = p[0];
            if (bytes == 4) out[3] = p[3];
        }
    }
}

void FrameConverter::convert_palette(const Image& image, const FramePlanes& planes) {
    std::array<std::uint32_t, 256> colours{};
    palette_.convert(image, planes.data[0], planes.stride[0], colours);
    std::memcpy(planes.data[1], colours.data(), sizeof colours);
}

}  // namespace carom
