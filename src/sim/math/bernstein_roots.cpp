#include "sim/math/bernstein_roots.h"

#include "sim/math/bracketed_root.h"

namespace carom {

namespace {

/// Narrower than this, an interval of [0, 1] is decided by the signs at its ends.
constexpr double kNarrow = 1e-16;

}  // namespace

double LongPolynomial::operator()(double u) const {
    double sum = 0;
    for (std::size_t i = degree + 1; i-- > 0;) sum = c[i] + u * sum;
    return sum;
}

LongPolynomial LongPolynomial::divided_by_u() const {
    LongPolynomial q;
    for (std::size_t i = 0; i < degree; ++i) q.c[i] = c[i + 1];
    q.degree = degree > 0 ? degree - 1 : 0;
    return q;
}

DownwardCrossings::DownwardCrossings(const LongPolynomial& p) : degree_(p.degree) {
    while (degree_ > 0 && p.c[degree_] == 0) --degree_;
    // b_j = sum over i <= j of C(j, i) / C(n, i) c_i, the ratio growing by (j - i) / (n - i).
    Interval& whole = stack_[size_++];
    for (std::size_t j = 0; j <= degree_; ++j) {
        double ratio = 1, sum = 0;
        for (std::size_t i = 0; i <= j; ++i) {
            sum += ratio * p.c[i];
            if (i < j) ratio *= static_cast<double>(j - i) / static_cast<double>(degree_ - i);
        }
        whole.b[j] = sum;
    }
}

/// De Casteljau's rule.
double DownwardCrossings::value(const Interval& interval, double t) const {
    auto b = interval.b;
    for (std::size_t k = degree_; k > 0; --k)
        for (std::size_t i = 0; i < k; ++i) b[i] += t * (b[i + 1] - b[i]);
    return b[0];
}

void DownwardCrossings::halve(const Interval& whole) {
    Interval left, right;
    const double middle = 0.5 * (whole.lo + whole.hi);
    left.lo = whole.lo;
    left.hi = right.lo = middle;
    right.hi = whole.hi;
    right.b = whole.b;
    for (std::size_t k = 0; k <= degree_; ++k) {
        left.b[k] = right.b[0];
        for (std::size_t i = 0; i + k < degree_; ++i)
            right.b[i] = 0.5 * (right.b[i] + right.b[i + 1]);
    }
    stack_[size_++] = right;
    stack_[size_++] = left;
}

bool DownwardCrossings::next(double& u) {
    while (size_ > 0) {
        const Interval here = stack_[--size_];
        int changes = 0;
        double first = 0, last = 0;
        for (std::size_t i = 0; i <= degree_; ++i) {
            if (here.b[i] == 0) continue;
            if (first == 0) first = here.b[i];
            if (last != 0 && (last < 0) != (here.b[i] < 0)) ++changes;
            last = here.b[i];
        }
        if (first == 0) continue;  // p is 0 here
        const bool narrow = here.hi - here.lo <= kNarrow;
        const bool one_and_clear = changes == 1 && here.b[0] != 0 && here.b[degree_] != 0;
        if (changes > 0 && !one_and_clear && !narrow) {
            if (++seen_ > kMostIntervals || size_ + 2 > kMostDepth) {
                capped_ = true;
                return false;
            }
            halve(here);
            continue;
        }
        const bool was_positive = positive_;
        positive_ = last > 0;
        if (was_positive && first < 0) {  // exactly on the border of two intervals
            u = here.lo;
            return true;
        }
        if (first > 0 && last < 0) {
            const double t =
                narrow ? 1 : bracketed_root([&](double x) { return value(here, x); }, 0.0, 1.0);
            u = here.lo + t * (here.hi - here.lo);
            return true;
        }
    }
    return false;
}

}  // namespace carom
