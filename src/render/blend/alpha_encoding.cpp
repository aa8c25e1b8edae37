#include "render/blend/alpha_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/blend/srgb.h"

namespace carom {

namespace {

double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

void encode_alpha(Image& picture, const PixelRect& part) {
    const std::array<double, 256>& linear = srgb_decoding();
    for (int y = part.top; y < part.bottom; ++y) {
        std::uint8_t* pixel = picture.row(y) + std::ptrdiff_t{4} * part.left;
        for (int x = part.left; x < part.right; ++x, pixel += 4) {
            // A trace of colour may be left where alpha has been rounded to 0.
            const bool nothing = pixel[0] + pixel[1] + pixel[2] + pixel[3] == 0;
            if (nothing || pixel[3] == 255) continue;
            const double rest = 1 - pixel[3] / 255.0;
            double least = 1;
            for (int c = 0; c < 3; ++c) {
                const double over_white = std::min(1.0, linear[pixel[c]] + rest);
                least = std::min(least, srgb_from_linear(over_white) - pixel[c] / 255.0);
            }
            const double alpha = std::round(255 * (1 - std::clamp(least, 0.0, 1.0)));
            // Premultiplied: no channel exceeds alpha.
            pixel[3] = std::max({static_cast<std::uint8_t>(alpha), pixel[0], pixel[1], pixel[2]});
        }
    }
}

}  // namespace carom
