#include "render/blend/srgb.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

double linear_from_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Vec3 linear_light(const Color& c) {
    return {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
}

const std::array<double, 256>& srgb_decoding() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> linear{};
        for (std::size_t code = 0; code < linear.size(); ++code)
            linear[code] = linear_from_srgb(static_cast<double>(code) / 255);
        return linear;
    }();
    return table;
}

double srgb_decoded(double encoded) {
    const std::array<double, 256>& table = srgb_decoding();
    const double place = std::clamp(encoded, 0.0, 1.0) * 255;
    const std::size_t code = std::min<std::size_t>(static_cast<std::size_t>(place), 254);
    return std::lerp(table[code], table[code + 1], place - static_cast<double>(code));
}

SrgbEncoder::SrgbEncoder() {
    for (std::size_t code = 0; code + 1 < limit_.size(); ++code)
        limit_[code] = linear_from_srgb((static_cast<double>(code) + 0.5) / 255);
    limit_.back() = std::numeric_limits<double>::infinity();
    std::uint8_t code = 0;
    for (int i = 0; i <= kGuesses; ++i) {
        while (static_cast<double>(i) / kGuesses >= limit_[code]) ++code;
        guess_[static_cast<std::size_t>(i)] = code;
    }
}

const SrgbEncoder& srgb_encoder() {
    static const SrgbEncoder encoder;
    return encoder;
}

}  // namespace carom
