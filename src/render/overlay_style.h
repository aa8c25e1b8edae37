// Sizes and inks that the parts of the overlay share.
#pragma once

#include <algorithm>

#include "render/canvas.h"

namespace carom {

inline constexpr Ink kSlate{0.122, 0.161, 0.216, 1};  // #1f2937
inline constexpr Ink kPaper{1, 1, 1, 1};
inline constexpr Ink kGood{0.043, 0.498, 0.318, 1};  // #0b7f51
inline constexpr Ink kBad{0.753, 0.161, 0.153, 1};   // #c02927

/// Letters smaller than this are not legible.
inline constexpr double kSmallestLetters = 9.5;

/// A length given at a picture height of 720 pixels.
inline double overlay_px(double at_720, int height_px) { return at_720 * height_px / 720; }

inline double letters_px(double at_720, int height_px) {
    return std::max(overlay_px(at_720, height_px), kSmallestLetters);
}

}  // namespace carom
