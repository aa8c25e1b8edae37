// Pictures against a reference of 8 x 8 samples a pixel, averaged in linear light.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "hand_made_scene.h"

namespace carom::testing {

inline constexpr int kSamples = 8;  ///< along a pixel's edge

/// How far a picture is from its reference.
struct EdgeErrors {
    int largest = 0;       ///< of any channel of any pixel, of 255
    double beyond_24 = 0;  ///< part of the pixels with a channel off by more than 24
    double psnr_luma_db = 0;
};

inline EdgeErrors edge_errors(const Image& image, const Image& reference) {
    const ImageDifference difference = compare_images(image, reference);
    int beyond = 0;
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        int worst = 0;
        for (std::size_t c = i; c < i + 3; ++c)
            worst = std::max(worst, std::abs(int{image.bgra[c]} - int{reference.bgra[c]}));
        beyond += worst > 24 ? 1 : 0;
    }
    return {difference.largest, 4.0 * beyond / static_cast<double>(image.bgra.size()),
            difference.psnr_luma_db};
}

/// Of several pictures of one size: as of one large one.
inline EdgeErrors taken_together(const std::vector<EdgeErrors>& all) {
    EdgeErrors together;
    double noise = 0;  // mean square, relative
    for (const EdgeErrors& one : all) {
        together.largest = std::max(together.largest, one.largest);
        together.beyond_24 += one.beyond_24 / static_cast<double>(all.size());
        noise += std::pow(10, -one.psnr_luma_db / 10) / static_cast<double>(all.size());
    }
    together.psnr_luma_db = -10 * std::log10(noise);
    return together;
}

/// The bounds of a good edge: 99.99 % of pixels within 24, all within 64, 40 dB.
inline void expect_good(const EdgeErrors& errors, const std::string& what) {
    fmt::print(
        "{}: largest {} (at most 64), beyond 24: {:.4f} % (at most 0.01), PSNR {:.2f} dB "
        "(at least 40)\n",
        what, errors.largest, 100 * errors.beyond_24, errors.psnr_luma_db);
    EXPECT_LE(errors.largest, 64) << what;
    EXPECT_LE(errors.beyond_24, 1e-4) << what;
    EXPECT_GE(errors.psnr_luma_db, 40) << what;
}

inline Image reference_of(const HandMadeScene& scene, int width, int height) {
    return averaged(scene.paint(width * kSamples, height * kSamples), kSamples);
}

}  // namespace carom::testing
