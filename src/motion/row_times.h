// The instants of a table of states.
#pragma once

#include <cmath>
#include <cstdint>

namespace carom {

/// k / rate for k = 0 ... floor(duration * rate + 1e-9), and the duration itself last, in s. The
/// rate is a fraction so that 30000/1001 stays exact.
class RowTimes {
  public:
    RowTimes(double duration_s, int rate_numerator, int rate_denominator)
        : duration_(duration_s), numerator_(rate_numerator), denominator_(rate_denominator) {
        // The slack that the format names: a duration of k / rate but for rounding has its row k,
        // and that row is the duration's own, so that no instant stands twice.
        constexpr double kSlack = 1e-9;
        const double intervals = duration_s * rate_numerator / rate_denominator;
        const auto last = static_cast<std::int64_t>(std::floor(intervals + kSlack));
        const bool ends_on_a_row = std::abs(intervals - static_cast<double>(last)) <= kSlack;
        count_ = last + (ends_on_a_row ? 1 : 2);
    }

    std::int64_t count() const { return count_; }
    double operator[](std::int64_t k) const {
        return k == count_ - 1 ? duration_ : static_cast<double>(k) * denominator_ / numerator_;
    }

  private:
    double duration_;
    int numerator_, denominator_;
    std::int64_t count_ = 0;
};

}  // namespace carom
