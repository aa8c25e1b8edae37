// Real polynomials of low degree and the places where they turn negative: gaps between bodies are
// such polynomials of time, and an impact is the place where a gap would become negative.
#pragma once

#include <array>

namespace carom {

/// p(s) = c[0] + c[1] s + ... + c[4] s^4.
struct Polynomial {
    static constexpr int kMaxDegree = 4;
    std::array<double, kMaxDegree + 1> c{};

    double operator()(double s) const;
    Polynomial derivative() const;
    /// p(s) / s, for a p whose constant is 0.
    Polynomial divided_by_s() const;
    /// Highest power with a coefficient that is not 0; 0 for constants.
    int degree() const;
};

/// Places in (0, horizon], ascending. A polynomial of degree 4 has at most 4.
struct Roots {
    std::array<double, Polynomial::kMaxDegree> at{};
    int count = 0;
    bool capped = false;  ///< an iteration reached its bound; never seen, and an error if it is
    void add(double s) { at[static_cast<std::size_t>(count++)] = s; }
};

/// Where p goes from >= 0 to < 0. A minimum of exactly 0 is no crossing. If p(0) < 0, that place is
/// none either: only what follows a rise above 0 counts.
Roots downward_crossings(const Polynomial& p, double horizon);

}  // namespace carom
