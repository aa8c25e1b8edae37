// A picture of 16 bits a channel, as PNG files may hold; carom draws none, but compares them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "core/image.h"

namespace carom {

/// As Image, with 16-bit samples, 65535 for 1: sRGB, B, G, R, A, alpha premultiplied, rows from the
/// top.
struct DeepImage {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint16_t> bgra;  ///< height_px * width_px * 4 samples

    DeepImage() = default;
    DeepImage(int width, int height)
        : width_px(width),
          height_px(height),
          bgra(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4) {}
};

/// In the depth that the file has.
using AnyImage = std::variant<Image, DeepImage>;

/// 16 bits that stand for the same values: 257 v.
DeepImage deepened(const Image& image);

/// 8 bits, rounded to the nearest.
Image flattened(const AnyImage& image);

}  // namespace carom
