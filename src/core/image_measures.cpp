#include "core/image_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "core/structural_similarity.h"

namespace carom {

namespace {

constexpr std::size_t kChannels = 4;

/// What 255 is in a picture's own steps.
constexpr int one(const Image&) { return 255; }
constexpr int one(const DeepImage&) { return 65535; }

double decibel(double mean_square_of_255) {
    return mean_square_of_255 > 0 ? 10 * std::log10(255.0 * 255.0 / mean_square_of_255)
                                  : std::numeric_limits<double>::infinity();
}

template <class Picture>
bool is_opaque(const Picture& picture) {
    auto all = picture.bgra.empty() ? decltype(picture.bgra[0]){} : picture.bgra[3];
    for (std::size_t i = 3; i < picture.bgra.size(); i += kChannels)
        all = std::min(all, picture.bgra[i]);
    return picture.bgra.empty() || int{all} == one(picture);
}

/// BT.709 luma of 0 ... 255, over black, or over white where the picture can be seen through.
template <class Picture>
LumaPlane luma_plane(const Picture& picture, bool over_white) {
    LumaPlane plane{picture.width_px, picture.height_px, {}};
    plane.values.resize(picture.bgra.size() / kChannels);
    const float unit = 255.0F / static_cast<float>(one(picture));
    const float white = over_white ? 255.0F : 0.0F;
    for (std::size_t i = 0; i < plane.values.size(); ++i) {
        const auto* p = &picture.bgra[kChannels * i];
        const float luma = 0.0722F * static_cast<float>(p[0]) + 0.7152F * static_cast<float>(p[1]) +
                           0.2126F * static_cast<float>(p[2]);
        const float alpha = unit * static_cast<float>(p[3]) / 255.0F;
        plane.values[i] = unit * luma + white * (1 - alpha);
    }
    return plane;
}

/// Sums over the pixels that differ, in the pictures' own steps.
struct Sums {
    std::int64_t largest = 0, differing = 0;
    double colours = 0, alpha = 0, luma = 0;  ///< of squares
    PixelRect where;
};

/// How far the luma of two pixels is off, over black or over white, whichever shows more.
double luma_off(const int (&off)[kChannels]) {
    const double over_black = 0.0722 * off[0] + 0.7152 * off[1] + 0.2126 * off[2];
    const double over_white = over_black - off[3];
    return std::abs(over_white) > std::abs(over_black) ? over_white : over_black;
}

template <class Sample>
void add_pixel(const Sample* a, const Sample* b, Sums& sums) {
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

template <class Picture>
Sums sums_of(const Picture& a, const Picture& b) {
    Sums sums;
    const auto width = static_cast<std::size_t>(a.width_px);
    for (int y = 0; y < a.height_px; ++y) {
        const std::size_t start = static_cast<std::size_t>(y) * width * kChannels;
        const auto *row_a = a.bgra.data() + start, *row_b = b.bgra.data() + start;
        const std::size_t bytes = width * kChannels * sizeof *row_a;
        if (std::memcmp(row_a, row_b, bytes) == 0) continue;
        for (std::size_t x = 0; x < width; ++x) {
            const auto *p = row_a + kChannels * x, *q = row_b + kChannels * x;
            if (std::memcmp(p, q, kChannels * sizeof *p) == 0) continue;
            add_pixel(p, q, sums);
            sums.where = sums.where.joined(PixelRect::at(static_cast<int>(x), y, 1, 1));
        }
    }
    return sums;
}

template <class Picture>
ImageMeasures measure(const Picture& a, const Picture& b) {
    ImageMeasures result;
    result.same_size = a.width_px == b.width_px && a.height_px == b.height_px;
    if (!result.same_size) return result;
    result.pixels = static_cast<std::int64_t>(a.width_px) * a.height_px;
    const Sums sums = sums_of(a, b);
    const double unit = 255.0 / one(a), pixels = static_cast<double>(result.pixels);
    result.largest = static_cast<double>(sums.largest) * unit;
    result.differing = sums.differing;
    result.psnr_db = result.psnr_luma_db = std::numeric_limits<double>::infinity();
    result.ssim = 1;
    if (sums.differing == 0) return result;
    const bool opaque = is_opaque(a) && is_opaque(b);
    const double squares = sums.colours + (opaque ? 0 : sums.alpha);
    result.psnr_db = decibel(unit * unit * squares / ((opaque ? 3 : 4) * pixels));
    result.psnr_luma_db = decibel(unit * unit * sums.luma / pixels);
    result.ssim = structural_similarity(luma_plane(a, false), luma_plane(b, false), sums.where);
    if (!opaque)
        result.ssim = std::min(result.ssim, structural_similarity(luma_plane(a, true),
                                                                  luma_plane(b, true), sums.where));
    return result;
}

/// The picture in 16 bits; made where it has 8.
const DeepImage& deep(const AnyImage& image, DeepImage& made) {
    if (const auto* found = std::get_if<DeepImage>(&image)) return *found;
    made = deepened(std::get<Image>(image));
    return made;
}

}  // namespace

ImageMeasures measure_difference(const AnyImage& a, const AnyImage& b) {
    const auto *flat_a = std::get_if<Image>(&a), *flat_b = std::get_if<Image>(&b);
    if (flat_a != nullptr && flat_b != nullptr) return measure(*flat_a, *flat_b);
    DeepImage made_a, made_b;
    return measure(deep(a, made_a), deep(b, made_b));
}

}  // namespace carom
