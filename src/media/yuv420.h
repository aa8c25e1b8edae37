// From drawn pixels to what H.264 films hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"

namespace carom {

/// Three planes of 8 bits: luma of the whole picture, the two chromas at half width and height.
struct Yuv420Planes {
    std::uint8_t* y = nullptr;
    std::uint8_t* cb = nullptr;
    std::uint8_t* cr = nullptr;
    std::ptrdiff_t y_stride = 0;
    std::ptrdiff_t cb_stride = 0;
    std::ptrdiff_t cr_stride = 0;
};

/// Converts sRGB pixels to Y'CbCr 4:2:0 with the matrix of Recommendation ITU-R BT.709-6 (2015),
/// items 3.2-3.4, limited range (Y' 16 ... 235, Cb and Cr 16 ... 240), rounded to nearest:
///
///     Y' = 16 + 219 (0.2126 R + 0.7152 G + 0.0722 B)
///     Cb = 128 + 224 (B - Y) / 1.8556        Cr = 128 + 224 (R - Y) / 1.5748
///
/// Chroma sits on the left luma sample of each pair, between the two rows ("left", H.264's
/// default): weights 1 2 1 across, 1 1 down, the picture's edge repeated. Alpha is ignored, that
/// is, transparent pixels lie over black. Integers only: the same on every processor.
///
/// Holds the sums of two rows between calls; use one object per thread.
class Yuv420Converter {
  public:
    /// `image` has an even width and height, which the planes share.
    void convert(const Image& image, const Yuv420Planes& planes) {
        convert(image, {0, 0, image.width_px, image.height_px}, planes);
    }
    /// Only what the pixels of a part are seen in; of it the planes are afterwards as if all had
    /// been converted.
    void convert(const Image& image, const PixelRect& part, const Yuv420Planes& planes);

  private:
    std::vector<std::uint32_t> upper_, lower_;
    std::vector<std::uint32_t> blue_red_;
    std::vector<std::uint32_t> green_;
};

}  // namespace carom
