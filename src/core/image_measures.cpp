#include "core/image_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "core/image.h"

namespace carom {

namespace {

/// What 255 is in the samples' own steps.
template <class Sample>
constexpr int kOne = std::numeric_limits<Sample>::max();

double decibel(double mean_square_of_255) {
    return mean_square_of_255 > 0 ? 10 * std::log10(255.0 * 255.0 / mean_square_of_255)
                                  : std::numeric_limits<double>::infinity();
}

template <class Sample>
bool is_opaque(const Sample* row, std::size_t pixels) {
    Sample all = std::numeric_limits<Sample>::max();
    for (std::size_t i = 0; i < pixels; ++i)
        all = static_cast<Sample>(all & row[kChannels * i + 3]);
    return all == std::numeric_limits<Sample>::max();
}

/// BT.709 luma of 0 ... 255, over black, or over white where the picture can be seen through.
template <class Sample, bool kOverWhite>
void luma_of(const std::byte* pixels, std::size_t count, float* luma) {
    const auto* p = reinterpret_cast<const Sample*>(pixels);
    constexpr float kUnit = 255.0F / static_cast<float>(kOne<Sample>);
    constexpr float kWhite = kOverWhite ? 255.0F : 0.0F;
    for (std::size_t i = 0; i < count; ++i, p += kChannels) {
        const float sum = 0.0722F * static_cast<float>(p[0]) + 0.7152F * static_cast<float>(p[1]) +
                          0.2126F * static_cast<float>(p[2]);
        const float alpha = kUnit * static_cast<float>(p[3]) / 255.0F;
        luma[i] = kUnit * sum + kWhite * (1 - alpha);
    }
}

/// How far the luma of two pixels is off, over black or over white, whichever shows more.
double luma_off(const int (&off)[kChannels]) {
    const double over_black = 0.0722 * off[0] + 0.7152 * off[1] + 0.2126 * off[2];
    const double over_white = over_black - off[3];
    return std::abs(over_white) > std::abs(over_black) ? over_white : over_black;
}

template <class Picture>
ImageMeasures measure(const Picture& a, const Picture& b) {
    if (a.width_px != b.width_px || a.height_px != b.height_px) {
        ImageMeasures other;
        other.same_size = false;
        return other;
    }
    using Sample = std::decay_t<decltype(a.bgra[0])>;
    MeasuredRows<Sample> rows(a.width_px, a.height_px);
    const std::size_t stride = static_cast<std::size_t>(a.width_px) * kChannels;
    for (std::size_t y = 0; y < static_cast<std::size_t>(a.height_px); ++y)
        rows.add_row(a.bgra.data() + y * stride, b.bgra.data() + y * stride);
    return rows.measures();
}

/// The picture in 16 bits; made where it has 8.
const DeepImage& deep(const AnyImage& image, DeepImage& made) {
    if (const auto* found = std::get_if<DeepImage>(&image)) return *found;
    made = deepened(std::get<Image>(image));
    return made;
}

}  // namespace

template <class Sample>
MeasuredRows<Sample>::MeasuredRows(int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      over_black_(width_px, height_px, kChannels * sizeof(Sample), luma_of<Sample, false>) {}

template <class Sample>
void MeasuredRows<Sample>::add_pixel(const Sample* a, const Sample* b, Sums& sums) {
    int off[kChannels];
    int largest = 0;
    for (std::size_t c = 0; c < kChannels; ++c) {
        off[c] = int{a[c]} - int{b[c]};
        largest = std::max(largest, std::abs(off[c]));
    }
    ++sums.differing;
    sums.largest = std::max<std::int64_t>(sums.largest, largest);
    for (std::size_t c = 0; c < 3; ++c) sums.colours += static_cast<double>(off[c]) * off[c];
    sums.alpha += static_cast<double>(off[3]) * off[3];
    const double luma = luma_off(off);
    sums.luma += luma * luma;
}

template <class Sample>
void MeasuredRows<Sample>::add_row(const Sample* a, const Sample* b) {
    const auto width = static_cast<std::size_t>(width_px_);
    if (!over_white_ && !(is_opaque(a, width) && is_opaque(b, width))) {
        over_white_ = over_black_;
        over_white_->set_luma(luma_of<Sample, true>);
    }
    const auto* bytes_a = reinterpret_cast<const std::byte*>(a);
    const auto* bytes_b = reinterpret_cast<const std::byte*>(b);
    over_black_.add_row(bytes_a, bytes_b);
    if (over_white_) over_white_->add_row(bytes_a, bytes_b);
    if (std::memcmp(a, b, width * kChannels * sizeof *a) == 0) return;
    for (std::size_t i = 0; i < width * kChannels; i += kChannels)
        if (std::memcmp(a + i, b + i, kChannels * sizeof *a) != 0) add_pixel(a + i, b + i, sums_);
}

template <class Sample>
ImageMeasures MeasuredRows<Sample>::measures() const {
    ImageMeasures result;
    result.pixels = std::int64_t{width_px_} * height_px_;
    const double unit = 255.0 / kOne<Sample>, pixels = static_cast<double>(result.pixels);
    result.largest = static_cast<double>(sums_.largest) * unit;
    result.differing = sums_.differing;
    result.psnr_db = result.psnr_luma_db = std::numeric_limits<double>::infinity();
    result.ssim = 1;
    if (sums_.differing == 0) return result;
    const double squares = sums_.colours + (over_white_ ? sums_.alpha : 0);
    result.psnr_db = decibel(unit * unit * squares / ((over_white_ ? 4 : 3) * pixels));
    result.psnr_luma_db = decibel(unit * unit * sums_.luma / pixels);
    result.ssim = over_black_.mean();
    if (over_white_) result.ssim = std::min(result.ssim, over_white_->mean());
    return result;
}

template class MeasuredRows<std::uint8_t>;
template class MeasuredRows<std::uint16_t>;

ImageMeasures measure_difference(const AnyImage& a, const AnyImage& b) {
    const auto *flat_a = std::get_if<Image>(&a), *flat_b = std::get_if<Image>(&b);
    if (flat_a != nullptr && flat_b != nullptr) return measure(*flat_a, *flat_b);
    DeepImage made_a, made_b;
    return measure(deep(a, made_a), deep(b, made_b));
}

}  // namespace carom
