// A picture in memory, as cairo draws on it and as encoders take it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/changed_parts.h"

namespace carom {

inline constexpr std::size_t kChannels = 4;  ///< of a pixel

/// 8-bit sRGB, four bytes a pixel in the order B, G, R, A, alpha premultiplied, rows from the top,
/// no padding between rows.
struct Image {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> bgra;  ///< height_px * width_px * 4 bytes

    Image() = default;
    Image(int width, int height)
        : width_px(width),
          height_px(height),
          bgra(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4) {}

    std::size_t stride_bytes() const { return static_cast<std::size_t>(width_px) * 4; }
    std::uint8_t* row(int y) { return bgra.data() + static_cast<std::size_t>(y) * stride_bytes(); }
    const std::uint8_t* row(int y) const {
        return bgra.data() + static_cast<std::size_t>(y) * stride_bytes();
    }
    bool operator==(const Image&) const = default;
};

/// Brings `copy`, which may differ from `source` in the given parts, up to date. Of another size it
/// is copied as a whole.
void copy_parts(const Image& source, const ChangedParts& parts, Image& copy);

/// What the comparison of two pictures found; channels are compared as bytes.
struct ImageDifference {
    bool same_size = true;
    int largest = 0;             ///< largest difference of any channel anywhere, 0 ... 255
    std::int64_t pixels = 0;     ///< pixels compared
    std::int64_t differing = 0;  ///< pixels with any channel off at all
    /// Of BT.709 luma, of transparent pictures over black or white; infinity when identical.
    double psnr_luma_db = 0;
    double differing_fraction() const {
        return pixels > 0 ? static_cast<double>(differing) / static_cast<double>(pixels) : 0.0;
    }
};

/// Limits below which two pictures count as the same (docs/commands.md says why these).
struct ImageTolerance {
    int channel = 2;          ///< no channel anywhere may be off by more
    double differing = 0.01;  ///< no larger fraction of the pixels may be off at all
    bool accepts(const ImageDifference& d) const {
        return d.same_size && d.largest <= channel && d.differing_fraction() <= differing;
    }
};

ImageDifference compare_images(const Image& a, const Image& b);

/// A picture of the difference, amplified so that one step of 255 can be seen; black where equal,
/// grey where only alpha differs.
/// Both pictures must have the same size.
Image difference_image(const Image& a, const Image& b);

}  // namespace carom
