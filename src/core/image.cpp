#include "core/image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/check.h"

namespace carom {

namespace {

double luma(const std::uint8_t* bgra) {
    return 0.0722 * bgra[0] + 0.7152 * bgra[1] + 0.2126 * bgra[2];
}

/// How far the luma of two pixels is off, over black or over white, whichever shows more.
double luma_off(const std::uint8_t* a, const std::uint8_t* b) {
    const double over_black = luma(a) - luma(b), over_white = over_black - (a[3] - b[3]);
    return std::abs(over_white) > std::abs(over_black) ? over_white : over_black;
}

}  // namespace

void copy_parts(const Image& source, const ChangedParts& parts, Image& copy) {
    if (parts.all || copy.width_px != source.width_px || copy.height_px != source.height_px) {
        copy = source;
        return;
    }
    for (const PixelRect& part : parts.parts) {
        const std::ptrdiff_t left = std::ptrdiff_t{kChannels} * part.left;
        const std::ptrdiff_t bytes = std::ptrdiff_t{kChannels} * part.width();
        for (int y = part.top; y < part.bottom; ++y)
            std::copy_n(source.row(y) + left, bytes, copy.row(y) + left);
    }
}

ImageDifference compare_images(const Image& a, const Image& b) {
    ImageDifference result;
    result.same_size = a.width_px == b.width_px && a.height_px == b.height_px;
    if (!result.same_size) return result;

    result.pixels = static_cast<std::int64_t>(a.width_px) * a.height_px;
    double squares = 0;
    for (std::size_t i = 0; i < a.bgra.size(); i += kChannels) {
        int largest = 0;
        for (std::size_t c = i; c < i + kChannels; ++c)
            largest = std::max(largest, std::abs(int{a.bgra[c]} - int{b.bgra[c]}));
        if (largest == 0) continue;
        ++result.differing;
        result.largest = std::max(result.largest, largest);
        const double off = luma_off(&a.bgra[i], &b.bgra[i]);
        squares += off * off;
    }
    const double mean = squares / static_cast<double>(std::max<std::int64_t>(1, result.pixels));
    result.psnr_luma_db = mean > 0 ? 10.0 * std::log10(255.0 * 255.0 / mean)
                                   : std::numeric_limits<double>::infinity();
    return result;
}

Image difference_image(const Image& a, const Image& b) {
    CAROM_CHECK(a.width_px, ==, b.width_px);
    CAROM_CHECK(a.height_px, ==, b.height_px);
    // A difference of 1 must be visible on black, a large one must still be told from it.
    constexpr int kFloor = 48, kGain = 8;
    Image result(a.width_px, a.height_px);
    for (std::size_t i = 0; i < a.bgra.size(); ++i) {
        const std::size_t alpha = i - i % kChannels + kChannels - 1;
        // Where only alpha differs, all channels show it.
        const int off = std::max(std::abs(int{a.bgra[i]} - int{b.bgra[i]}),
                                 std::abs(int{a.bgra[alpha]} - int{b.bgra[alpha]}));
        const int shown = off == 0 ? 0 : std::min(255, kFloor + kGain * off);
        result.bgra[i] = static_cast<std::uint8_t>(i == alpha ? 255 : shown);
    }
    return result;
}

}  // namespace carom
