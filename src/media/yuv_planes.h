// From drawn pixels to Y'CbCr of the kinds that yuv420.h does not have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/image.h"
#include "core/pixel_rect.h"

namespace carom {

/// Luma, the two chromas, alpha; samples of more than 8 bits are 16-bit numbers. Strides in bytes.
struct FramePlanes {
    std::array<std::uint8_t*, 4> data{};
    std::array<std::ptrdiff_t, 4> stride{};
};

/// The matrix, range, filter and rounding of Yuv420Converter, in 4:4:4 of 8 or 10 bits, or 4:2:0 of
/// 10 bits. The samples of 10 bits are four times those of 8, rounded once. Only what the pixels of
/// `part` are seen in is converted.
void convert_yuv(const Image& image, const PixelRect& part, int bits, bool halved_chroma,
                 const FramePlanes& planes);

/// Alpha as a plane of its own in full range: a * (2^bits - 1) / 255, rounded.
void copy_alpha(const Image& image, int bits, std::uint8_t* plane, std::ptrdiff_t stride);

}  // namespace carom
