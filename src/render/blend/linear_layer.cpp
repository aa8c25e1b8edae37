#include "render/blend/linear_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "render/blend/srgb.h"

namespace carom {

PixelRect filled_part(const Image& layer) {
    PixelRect part{layer.width_px, layer.height_px, 0, 0};
    const auto row_bytes = std::size_t{4} * static_cast<std::size_t>(layer.width_px);
    for (int y = 0; y < layer.height_px; ++y) {
        const std::uint8_t* pixels = layer.row(y);
        // Most rows are empty: each byte is 0, and like the next.
        if (row_bytes == 0 ||
            (pixels[0] == 0 && std::memcmp(pixels, pixels + 1, row_bytes - 1) == 0))
            continue;
        for (int x = 0; x < layer.width_px; ++x) {
            if (pixels[4 * x + 3] == 0) continue;
            part.left = std::min(part.left, x);
            part.right = std::max(part.right, x + 1);
            part.top = std::min(part.top, y);
            part.bottom = y + 1;
        }
    }
    return part;
}

void lay_over_in_linear_light(const Image& layer, int left, int top, Image& target) {
    const std::array<double, 256>& decoded = srgb_decoding();
    const SrgbEncoder& encoded = srgb_encoder();
    for (int y = 0; y < target.height_px; ++y) {
        const std::uint8_t* from = layer.row(top + y) + std::ptrdiff_t{4} * left;
        std::uint8_t* to = target.row(y);
        for (int x = 0; x < target.width_px; ++x, from += 4, to += 4) {
            if (from[3] == 0) continue;
            const double opacity = from[3] / 255.0;
            for (int c = 0; c < 3; ++c) {
                const double own = std::min(1.0, from[c] / static_cast<double>(from[3]));
                to[c] = encoded(srgb_decoded(own) * opacity + decoded[to[c]] * (1 - opacity));
            }
            to[3] = static_cast<std::uint8_t>(std::lround(from[3] + to[3] * (1 - opacity)));
        }
    }
}

}  // namespace carom
