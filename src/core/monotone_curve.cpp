#include "core/monotone_curve.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/check.h"

namespace carom {

MonotoneCurve::MonotoneCurve(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0) {
    CAROM_CHECK(x_.size(), ==, y_.size());
    CAROM_CHECK(x_.size(), >, std::size_t{0});
    // At the ends the slope stays 0, as beyond them; inside, a weighted harmonic mean where both
    // neighbours go the same way, and 0 at a turn.
    for (std::size_t i = 1; i + 1 < x_.size(); ++i) {
        const double before = x_[i] - x_[i - 1], after = x_[i + 1] - x_[i];
        const double down = (y_[i] - y_[i - 1]) / before, up = (y_[i + 1] - y_[i]) / after;
        if (!(down * up > 0)) continue;
        const double w = (before + 2 * after) / (3 * (before + after));
        slope_[i] = down * up / (w * up + (1 - w) * down);
    }
}

double MonotoneCurve::at(double x) const {
    if (!(x > x_.front())) return y_.front();
    if (!(x < x_.back())) return y_.back();
    const auto next =
        static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
    const std::size_t i = next - 1;
    const double h = x_[next] - x_[i], u = (x - x_[i]) / h, v = 1 - u;
    return y_[i] + u * u * (1 + 2 * v) * (y_[next] - y_[i]) +
           h * u * v * (v * slope_[i] - u * slope_[next]);
}

double MonotoneCurve::slope_at(double x) const {
    if (!(x > x_.front()) || !(x < x_.back())) return 0;
    const auto next =
        static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
    const std::size_t i = next - 1;
    const double h = x_[next] - x_[i], u = (x - x_[i]) / h, v = 1 - u;
    return 6 * u * v * (y_[next] - y_[i]) / h + v * (1 - 3 * u) * slope_[i] +
           u * (1 - 3 * v) * slope_[next];
}

}  // namespace carom
