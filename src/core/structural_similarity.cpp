#include "core/structural_similarity.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/check.h"

namespace carom {

namespace {

constexpr int kWindow = StructuralSimilarity::kWindow, kHalf = StructuralSimilarity::kHalf;
constexpr double kSigma_px = 1.5;
constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
// Sums are taken about the middle of the range, where single precision loses least.
constexpr float kMiddle = 127.5F;
/// Windows side by side that are computed together; they see as many pixels and 10 more.
constexpr std::size_t kBlock = 64, kWide = kBlock + kWindow - 1;

/// Weights by their distance from the window's middle; the whole row of 11 sums to 1.
std::array<float, kHalf + 1> gaussian() {
    std::array<double, kHalf + 1> w{};
    double sum = 0;
    for (int i = 0; i <= kHalf; ++i) {
        w[static_cast<std::size_t>(i)] = std::exp(-0.5 * i * i / (kSigma_px * kSigma_px));
        sum += (i == 0 ? 1 : 2) * w[static_cast<std::size_t>(i)];
    }
    std::array<float, kHalf + 1> result{};
    std::transform(w.begin(), w.end(), result.begin(),
                   [sum](double v) { return static_cast<float>(v / sum); });
    return result;
}

/// Equation 13 of means and second moments about kMiddle of s = a + b and d = a - b, which tell as
/// much as those of a and b and lose nothing where a and b are nearly the same.
double similarity(double mean_s, double mean_d, double mean_ss, double mean_dd) {
    const double var_s = std::max(0.0, mean_ss - mean_s * mean_s);
    const double var_d = std::max(0.0, mean_dd - mean_d * mean_d);
    const double s = mean_s + 2 * static_cast<double>(kMiddle);
    // 2 mu_a mu_b = (s^2 - d^2) / 2, mu_a^2 + mu_b^2 = (s^2 + d^2) / 2, and so for the variances.
    const double light =
        (0.5 * (s * s - mean_d * mean_d) + kC1) / (0.5 * (s * s + mean_d * mean_d) + kC1);
    return light * (0.5 * (var_s - var_d) + kC2) / (0.5 * (var_s + var_d) + kC2);
}

}  // namespace

StructuralSimilarity::StructuralSimilarity(int width_px, int height_px, std::size_t pixel_bytes,
                                           Luma luma)
    : width_(width_px),
      height_(height_px),
      pixel_bytes_(pixel_bytes),
      luma_(luma),
      one_window_(width_px < kWindow || height_px < kWindow),
      weights_(gaussian()) {
    if (one_window_) return;
    const std::size_t width = static_cast<std::size_t>(width_);
    const std::size_t windows = width - kWindow + 1;
    const std::size_t blocks = (windows + kBlock - 1) / kBlock;
    for (Row& row : ring_) {
        // Blocks read whole, also the last one.
        const std::size_t bytes = (blocks * kBlock + kWindow - 1) * pixel_bytes_;
        row.a.resize(bytes);
        row.b.resize(bytes);
        for (auto& values : row.moments) values.resize(blocks * kBlock);
        row.known.resize(blocks);
    }
    last_difference_.assign((width + kBlock - 1) / kBlock, -kWindow);
}

void StructuralSimilarity::add_to_one_window(const std::byte* a, const std::byte* b) {
    std::vector<float> luma(2 * static_cast<std::size_t>(width_));
    float* luma_b = luma.data() + width_;
    luma_(a, static_cast<std::size_t>(width_), luma.data());
    luma_(b, static_cast<std::size_t>(width_), luma_b);
    for (int x = 0; x < width_; ++x) {
        const double va = luma[static_cast<std::size_t>(x)] - kMiddle, vb = luma_b[x] - kMiddle;
        window_[0] += va + vb;
        window_[1] += va - vb;
        window_[2] += (va + vb) * (va + vb);
        window_[3] += (va - vb) * (va - vb);
    }
}

void StructuralSimilarity::add_row(const std::byte* a, const std::byte* b) {
    const int y = rows_++;
    if (one_window_) {
        add_to_one_window(a, b);
        return;
    }
    Row& row = ring_[static_cast<std::size_t>(y % kWindow)];
    const std::size_t bytes = static_cast<std::size_t>(width_) * pixel_bytes_;
    std::memcpy(row.a.data(), a, bytes);
    std::memcpy(row.b.data(), b, bytes);
    std::fill(row.known.begin(), row.known.end(), std::uint8_t{0});
    if (std::memcmp(a, b, bytes) != 0) {
        const std::size_t step = kBlock * pixel_bytes_;
        for (std::size_t i = 0; i < last_difference_.size(); ++i)
            if (std::memcmp(a + i * step, b + i * step, std::min(step, bytes - i * step)) != 0)
                last_difference_[i] = y;
    }
    if (rows_ < kWindow) return;
    for (std::size_t i = 0; i < row.known.size(); ++i)
        sum_ += sees_difference(i) ? sum_of_windows(i) : static_cast<double>(windows_of(i));
}

bool StructuralSimilarity::sees_difference(std::size_t block) const {
    const int first = rows_ - kWindow;  // row of the windows that end with the last one
    return last_difference_[block] >= first ||
           (block + 1 < last_difference_.size() && last_difference_[block + 1] >= first);
}

std::size_t StructuralSimilarity::windows_of(std::size_t block) const {
    return std::min(kBlock, static_cast<std::size_t>(width_) - kWindow + 1 - block * kBlock);
}

void StructuralSimilarity::make_moments(Row& row, std::size_t block) {
    std::array<std::array<float, kWide>, 4> plain;
    std::array<float, kWide> a, b;
    luma_(row.a.data() + block * kBlock * pixel_bytes_, kWide, a.data());
    luma_(row.b.data() + block * kBlock * pixel_bytes_, kWide, b.data());
    for (std::size_t x = 0; x < kWide; ++x) {
        const float va = a[x] - kMiddle, vb = b[x] - kMiddle;
        plain[0][x] = va + vb;
        plain[1][x] = va - vb;
        plain[2][x] = (va + vb) * (va + vb);
        plain[3][x] = (va - vb) * (va - vb);
    }
    for (std::size_t m = 0; m < plain.size(); ++m) {
        const float* in = plain[m].data();
        float* out = row.moments[m].data() + block * kBlock;
        for (std::size_t x = 0; x < kBlock; ++x) {
            float sum = weights_[0] * in[x + kHalf];
            for (std::size_t i = 1; i <= kHalf; ++i)
                sum += weights_[i] * (in[x + kHalf - i] + in[x + kHalf + i]);
            out[x] = sum;
        }
    }
    row.known[block] = 1;
}

/// The sum of the similarities of a block's windows whose last row is the last one added.
double StructuralSimilarity::sum_of_windows(std::size_t block) {
    for (Row& row : ring_)
        if (row.known[block] == 0) make_moments(row, block);
    const int y = rows_ - 1;
    std::array<std::array<float, kBlock>, 4> sums;
    for (std::size_t m = 0; m < sums.size(); ++m) {
        const auto row = [&](int back) {
            return ring_[static_cast<std::size_t>((y - back) % kWindow)].moments[m].data() +
                   block * kBlock;
        };
        float* out = sums[m].data();
        const float* middle = row(kHalf);
        for (std::size_t x = 0; x < kBlock; ++x) out[x] = weights_[0] * middle[x];
        for (int i = 1; i <= kHalf; ++i) {
            const float w = weights_[static_cast<std::size_t>(i)];
            const float *above = row(kHalf + i), *below = row(kHalf - i);
            for (std::size_t x = 0; x < kBlock; ++x) out[x] += w * (above[x] + below[x]);
        }
    }
    double sum = 0;
    const std::size_t count = windows_of(block);
    for (std::size_t x = 0; x < count; ++x)
        sum += similarity(sums[0][x], sums[1][x], sums[2][x], sums[3][x]);
    return sum;
}

double StructuralSimilarity::mean() const {
    CAROM_CHECK(rows_, ==, height_);
    if (one_window_) {
        const auto n = std::max(1.0, static_cast<double>(width_) * height_);
        return similarity(window_[0] / n, window_[1] / n, window_[2] / n, window_[3] / n);
    }
    return sum_ / (static_cast<double>(width_ - kWindow + 1) * (height_ - kWindow + 1));
}

}  // namespace carom
