#include "media/frame_converter.h"

#include <array>
#include <cstring>

namespace carom {

void FrameConverter::convert(const Image& image, const ChangedParts& changed,
                             const FramePlanes& planes) {
    // The palette is made from all frames so far, equal ones too.
    if (info_.format == PixelFormat::kPalette) return convert_palette(image, planes);
    if (changed.is_nothing()) return;
    const PixelRect whole{0, 0, image.width_px, image.height_px};
    const Image* source = &image;
    // Of a pixel that is made straight others may take their colour.
    const bool all = changed.all || info_.alpha;
    if (info_.alpha && !info_.yuv) {
        straighten_image(image, straight_);
        source = &straight_;
    } else if (info_.alpha) {
        straight_alpha_.convert(image, straight_);
        if (planes.data[3] != nullptr)
            copy_alpha(straight_, info_.bits, planes.data[3], planes.stride[3]);
        source = &straight_;
    }
    if (all) return convert_part(*source, whole, planes);
    for (const PixelRect& part : changed.parts) convert_part(*source, part, planes);
}

void FrameConverter::convert_part(const Image& image, const PixelRect& part,
                                  const FramePlanes& planes) {
    if (!info_.yuv) return convert_rgb(image, part, planes);
    if (info_.bits == 8 && info_.halved_chroma)
        yuv420_.convert(image, part,
                        {planes.data[0], planes.data[1], planes.data[2], planes.stride[0],
                         planes.stride[1], planes.stride[2]});
    else
        convert_yuv(image, part, info_.bits, info_.halved_chroma, planes);
}

void FrameConverter::convert_rgb(const Image& image, const PixelRect& part,
                                 const FramePlanes& planes) {
    const bool red_first = info_.format == PixelFormat::kRgb || info_.format == PixelFormat::kRgba;
    const int bytes = info_.format == PixelFormat::kRgb ? 3 : 4;
    for (int y = part.top; y < part.bottom; ++y) {
        const std::uint8_t* p = image.row(y) + std::ptrdiff_t{4} * part.left;
        std::uint8_t* out =
            planes.data[0] + y * planes.stride[0] + std::ptrdiff_t{bytes} * part.left;
        if (!red_first) {
            std::memcpy(out, p, std::size_t{4} * static_cast<std::size_t>(part.width()));
            continue;
        }
        for (int x = part.left; x < part.right; ++x, p += 4, out += bytes) {
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
