// Where a polynomial of higher degree turns negative.
#pragma once

#include <array>
#include <cstddef>

namespace carom {

/// p(u) = c[0] + c[1] u + ... + c[degree] u^degree, u in [0, 1].
struct LongPolynomial {
    static constexpr std::size_t kMaxDegree = 16;
    std::array<double, kMaxDegree + 1> c{};
    std::size_t degree = 0;

    double operator()(double u) const;
    /// p(u) / u, for a p whose constant is 0.
    LongPolynomial divided_by_u() const;
};

/// Hands out the places in [0, 1], ascending, where a polynomial goes from >= 0 to < 0. A minimum
/// of 0 is no such place; nor is 0 itself if p starts below 0.
///
/// In Bernstein's form on an interval, p has no more sign changes than its coefficients have. An
/// interval is halved until they have one or none (G. Farin, "Curves and Surfaces for
/// CAGD", 5th ed., 2002, ch. 6), which is soon, since the coefficients approach p with the square
/// of the interval's length.
class DownwardCrossings {
  public:
    explicit DownwardCrossings(const LongPolynomial& p);

    /// False when there are no more.
    bool next(double& u);
    /// An interval could not be decided in as many halvings as a double has digits and more.
    bool capped() const { return capped_; }

  private:
    struct Interval {
        double lo = 0, hi = 1;
        std::array<double, LongPolynomial::kMaxDegree + 1> b{};
    };
    static constexpr std::size_t kMostDepth = 64;
    static constexpr int kMostIntervals = 4096;

    void halve(const Interval& whole);
    double value(const Interval& interval, double t) const;

    std::size_t degree_;
    std::array<Interval, kMostDepth> stack_;
    std::size_t size_ = 0;
    bool positive_ = false;  ///< just before the interval at hand
    int seen_ = 0;
    bool capped_ = false;
};

}  // namespace carom
