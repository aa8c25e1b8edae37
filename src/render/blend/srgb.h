// sRGB and linear light: IEC 61966-2-1.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.h"
#include "scene/scene.h"

namespace carom {

/// sRGB in 0 ... 1 to linear.
double linear_from_srgb(double encoded);
/// Red, green, blue.
Vec3 linear_light(const Color& color);

/// Linear light of each code of 8 bits, 0 ... 1.
const std::array<double, 256>& srgb_decoding();

/// The same between codes, 0 ... 1; off by at most 6e-6.
double srgb_decoded(double encoded);

/// The code of linear light, rounded to the nearest; what is outside 0 ... 1 is clamped.
class SrgbEncoder {
  public:
    SrgbEncoder();
    std::uint8_t operator()(double linear) const {
        const double place = linear < 0 ? 0 : linear > 1 ? 1 : linear;
        std::uint8_t code = guess_[static_cast<std::size_t>(place * kGuesses)];
        while (place >= limit_[code]) ++code;
        return code;
    }

  private:
    static constexpr int kGuesses = 4096;
    std::array<std::uint8_t, kGuesses + 1> guess_{};  ///< the code at the place's lower end
    std::array<double, 256> limit_{};  ///< where the next code begins; beyond 1 for the last
};

/// One for all, since making it takes as long as encoding a thousand pixels.
const SrgbEncoder& srgb_encoder();

}  // namespace carom
