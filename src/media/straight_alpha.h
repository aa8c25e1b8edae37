// Alpha as files keep it: straight, beside colours that are not multiplied by it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/image.h"

namespace carom {

/// p = straight * a / 255, rounded. The inverse of straighten() for every p <= a: straight is off
/// by at most 1/2, so p by at most a/510, which is below 1/2 unless a = 255, where both are exact.
constexpr std::uint8_t premultiply(unsigned straight, unsigned a) {
    return static_cast<std::uint8_t>((straight * a + 127) / 255);
}

/// 0 where nothing is.
constexpr std::uint8_t straighten(unsigned premultiplied, unsigned a) {
    if (a == 0) return 0;
    return static_cast<std::uint8_t>(std::min(255U, (premultiplied * 255 + a / 2) / a));
}

/// Pictures with straight alpha, whose transparent pixels have the colours of what is near.
///
/// A codec with loss, or with halved chroma, mixes the colours of neighbours, transparent or not;
/// black there would darken the edges of balls. So each transparent pixel gets the mean colour of
/// the smallest block around it that has any (blocks of 2, 4, 8 ... pixels).
class StraightAlpha {
  public:
    /// `straight` becomes a picture of the same size.
    void convert(const Image& premultiplied, Image& straight);

  private:
    /// Sums over a block, of premultiplied channels and of alpha.
    struct Block {
        std::uint64_t b = 0, g = 0, r = 0, a = 0;
    };
    struct Level {
        int width = 0, height = 0;
        std::vector<Block> blocks;
    };
    void gather(const Image& premultiplied);
    void spread();

    std::vector<Level> levels_;  ///< blocks of 2, 4, 8 ... pixels, up to one for all
};

/// One row of premultiplied BGRA as straight RGBA, `width` pixels each.
void straighten_row(const std::uint8_t* bgra, std::uint8_t* rgba, int width);

/// Straight alpha without touching transparent pixels, for formats without loss.
void straighten_image(const Image& premultiplied, Image& straight);

/// The way back.
void premultiply_image(Image& image);

}  // namespace carom
