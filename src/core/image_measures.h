// How far two pictures are apart, by the measures that people compare pictures with.
#pragma once

#include <cstdint>
#include <optional>

#include "core/deep_image.h"
#include "core/structural_similarity.h"

namespace carom {

/// Of two pictures in the same depth, or of 8 and of 16 bits: then in 16. Differences are in steps
/// of 255, whatever the depth.
struct ImageMeasures {
    bool same_size = true;       ///< the rest is 0 where sizes differ
    double largest = 0;          ///< largest difference of any channel anywhere, 0 ... 255
    std::int64_t pixels = 0;     ///< pixels compared
    std::int64_t differing = 0;  ///< pixels with any channel off at all
    /// 10 log10(255^2 / mean square), over the channels R, G, B of all pixels, and A where any
    /// pixel of either picture is not opaque; infinity when identical.
    double psnr_db = 0;
    /// The same of BT.709 luma, of transparent pictures over black or white, whichever shows more.
    double psnr_luma_db = 0;
    /// Mean structural similarity of that luma (structural_similarity.h), 1 when identical.
    double ssim = 0;

    double differing_fraction() const {
        return pixels > 0 ? static_cast<double>(differing) / static_cast<double>(pixels) : 0.0;
    }
    bool identical() const { return same_size && differing == 0; }
};

ImageMeasures measure_difference(const AnyImage& a, const AnyImage& b);

/// The same of two pictures of one size whose rows come one after the other, from the top: neither
/// is kept. Samples as those of Image or DeepImage.
template <class Sample>
class MeasuredRows {
  public:
    MeasuredRows(int width_px, int height_px);
    void add_row(const Sample* a, const Sample* b);
    /// After the last row.
    ImageMeasures measures() const;

  private:
    /// Sums over the pixels that differ, in the pictures' own steps.
    struct Sums {
        std::int64_t largest = 0, differing = 0;
        double colours = 0, alpha = 0, luma = 0;  ///< of squares
    };
    static void add_pixel(const Sample* a, const Sample* b, Sums& sums);

    int width_px_, height_px_;
    Sums sums_;
    StructuralSimilarity over_black_;
    std::optional<StructuralSimilarity> over_white_;  ///< from the first pixel that is not opaque
};

extern template class MeasuredRows<std::uint8_t>;
extern template class MeasuredRows<std::uint16_t>;

/// True where both limits hold.
inline bool within(const ImageTolerance& limits, const ImageMeasures& m) {
    return m.same_size && m.largest <= limits.channel && m.differing_fraction() <= limits.differing;
}

}  // namespace carom
