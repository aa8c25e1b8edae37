#include "core/structural_similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/check.h"

namespace carom {

namespace {

constexpr int kWindow = 11, kHalf = kWindow / 2;
constexpr double kSigma_px = 1.5;
constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
// Sums are taken about the middle of the range, where single precision loses least.
constexpr float kMiddle = 127.5F;

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

/// Of the whole picture as one window.
double of_one_window(const LumaPlane& a, const LumaPlane& b) {
    double s = 0, d = 0, ss = 0, dd = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double va = a.values[i] - kMiddle, vb = b.values[i] - kMiddle;
        s += va + vb;
        d += va - vb;
        ss += (va + vb) * (va + vb);
        dd += (va - vb) * (va - vb);
    }
    const auto n = static_cast<double>(std::max<std::size_t>(1, a.values.size()));
    return similarity(s / n, d / n, ss / n, dd / n);
}

/// Rows of the four moments, weighted along x: a ring of as many as a window has.
class Rows {
  public:
    /// Windows whose left columns are `left` ... `left + count - 1`.
    Rows(const LumaPlane& a, const LumaPlane& b, int left, int count)
        : a_(a), b_(b), left_(left), count_(static_cast<std::size_t>(count)) {
        const std::size_t wide = count_ + kWindow - 1;
        for (auto& values : plain_) values.resize(wide);
        for (auto& moments : ring_)
            for (auto& values : moments) values.resize(count_);
        for (auto& values : sums_) values.resize(count_);
    }

    void read(int y) {
        const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(a_.width) +
                               static_cast<std::size_t>(left_);
        for (std::size_t x = 0; x < plain_[0].size(); ++x) {
            const float va = a_.values[at + x] - kMiddle, vb = b_.values[at + x] - kMiddle;
            plain_[0][x] = va + vb;
            plain_[1][x] = va - vb;
            plain_[2][x] = (va + vb) * (va + vb);
            plain_[3][x] = (va - vb) * (va - vb);
        }
        auto& moments = ring_[static_cast<std::size_t>(y % kWindow)];
        for (std::size_t m = 0; m < moments.size(); ++m) {
            const float* in = plain_[m].data();
            float* out = moments[m].data();
            for (std::size_t x = 0; x < count_; ++x) {
                float sum = weights_[0] * in[x + kHalf];
                for (std::size_t i = 1; i <= kHalf; ++i)
                    sum += weights_[i] * (in[x + kHalf - i] + in[x + kHalf + i]);
                out[x] = sum;
            }
        }
    }

    /// The sum of the similarities of all windows whose last row is `y`, the last one read.
    double sum_of_windows(int y) {
        const auto row = [&](std::size_t m, int back) {
            return ring_[static_cast<std::size_t>((y - back) % kWindow)][m].data();
        };
        for (std::size_t m = 0; m < sums_.size(); ++m) {
            float* out = sums_[m].data();
            const float* middle = row(m, kHalf);
            for (std::size_t x = 0; x < count_; ++x) out[x] = weights_[0] * middle[x];
            for (int i = 1; i <= kHalf; ++i) {
                const float w = weights_[static_cast<std::size_t>(i)];
                const float *above = row(m, kHalf + i), *below = row(m, kHalf - i);
                for (std::size_t x = 0; x < count_; ++x) out[x] += w * (above[x] + below[x]);
            }
        }
        double sum = 0;
        for (std::size_t x = 0; x < count_; ++x)
            sum += similarity(sums_[0][x], sums_[1][x], sums_[2][x], sums_[3][x]);
        return sum;
    }

  private:
    const LumaPlane &a_, &b_;
    int left_;
    std::size_t count_;
    std::array<float, kHalf + 1> weights_ = gaussian();
    std::array<std::vector<float>, 4> plain_, sums_;
    std::array<std::array<std::vector<float>, 4>, kWindow> ring_;
};

}  // namespace

double structural_similarity(const LumaPlane& a, const LumaPlane& b, const PixelRect& differing) {
    CAROM_CHECK(a.values.size(), ==, b.values.size());
    if (differing.empty()) return 1;
    if (a.width < kWindow || a.height < kWindow) return of_one_window(a, b);
    // Windows by their upper left corner; those that see no difference are 1.
    const int columns = a.width - kWindow + 1, rows = a.height - kWindow + 1;
    const int left = std::max(0, differing.left - kWindow + 1);
    const int top = std::max(0, differing.top - kWindow + 1);
    const int right = std::min(columns, differing.right), bottom = std::min(rows, differing.bottom);
    Rows moments(a, b, left, right - left);
    double sum = 0;
    for (int y = top; y < bottom + kWindow - 1; ++y) {
        moments.read(y);
        if (y >= top + kWindow - 1) sum += moments.sum_of_windows(y);
    }
    const double all = static_cast<double>(columns) * rows;
    const double seen = static_cast<double>(right - left) * (bottom - top);
    return (all - seen + sum) / all;
}

}  // namespace carom
