// From full colours to the 256 of a GIF.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"

namespace carom {

/// Chooses a palette for a film as it goes, and dithers frames into it.
///
/// The colours are the means of boxes that are split where their variance is largest (Wu,
/// "Efficient statistical computations for optimal color quantization", Graphics Gems II, 1991),
/// moved by k-means; a colour counts by the root of its pixels, so that a small ball keeps its
/// shades beside a large sky. The palette is that of all frames so far, and stays until a frame
/// comes that it holds markedly worse: frames of one palette are stored as differences.
///
/// Dithering is ordered, so that what does not move does not flicker: of each colour the 16 palette
/// entries are found whose mean comes nearest to it (Knoll's pattern dithering, US patent 6606166,
/// expired), sorted by luma, and placed by a 4x4 Bayer matrix.
///
/// One entry is transparent; pixels of less than half alpha get it.
class FilmPalette {
  public:
    static constexpr int kTransparent = 255;  ///< its index

    FilmPalette();

    /// Indices of `image`, and in `colours` the palette as 0xAARRGGBB.
    void convert(const Image& image, std::uint8_t* indices, std::ptrdiff_t stride,
                 std::array<std::uint32_t, 256>& colours);

  private:
    struct Colour {
        int b = 0, g = 0, r = 0;
    };
    /// Colours that agree in their first five bits.
    struct Bin {
        std::uint64_t pixels = 0, b = 0, g = 0, r = 0;
    };
    /// A mean colour and how much it counts.
    struct Shade {
        double b, g, r, weight;
    };
    using Pattern = std::array<std::uint8_t, 16>;
    struct Known {
        std::uint32_t colour = 0;
        bool valid = false;
        Pattern pattern{};
    };

    std::vector<Shade> count(const Image& image);
    std::vector<Shade> all_shades() const;
    double error_of(const std::vector<Shade>& shades) const;
    void choose(const std::vector<Shade>& shades);
    void move_to_means(const std::vector<Shade>& shades);
    int nearest(int b, int g, int r) const;
    const Pattern& pattern_of(std::uint32_t colour);
    Pattern make_pattern(std::uint32_t colour) const;

    std::vector<Bin> bins_;       ///< of all frames so far
    std::vector<Colour> chosen_;  ///< at most 255
    std::vector<Known> known_;    ///< patterns by colour, the latest of those that share a place
    double error_ = 0;            ///< mean square of what the palette was made from
};

}  // namespace carom
