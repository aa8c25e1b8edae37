#include "sim/math/polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

/// Newton halves the error's exponent each time and bisection gains one bit: a double has 2^11
/// exponents and 53 bits, and a bracket that needs more than this is a bug.
constexpr int kMaxIterations = 200;

/// All sign changes of a polynomial in (lo, hi).
struct SignChanges {
    std::array<double, Polynomial::kMaxDegree> at{};
    int count = 0;
    bool capped = false;
};

/// The root of p in [lo, hi], where p has opposite signs: Newton, and bisection where it leaves the
/// bracket or gains less than bisection would. Ends where the bracket has no inner double or p is
/// 0.
double root_in_bracket(const Polynomial& p, const Polynomial& slope, double lo, double hi,
                       bool& capped) {
    const bool rising = p(lo) < 0;
    double s = 0.5 * (lo + hi), last_width = hi - lo;
    for (int i = 0; i < kMaxIterations; ++i) {
        const double value = p(s);
        if (value == 0) return s;
        ((value < 0) == rising ? lo : hi) = s;
        double next = s - value / slope(s);
        const bool slow = 2 * std::abs(next - s) > last_width;
        if (!(next > lo && next < hi) || slow) next = 0.5 * (lo + hi);
        last_width = std::abs(next - s);
        if (next == s || next <= lo || next >= hi) return s;
        // Closer than rounding of p: further steps would only wander.
        if (last_width <= std::numeric_limits<double>::epsilon() * std::abs(s)) return next;
        s = next;
    }
    capped = true;
    return s;
}

SignChanges quadratic_sign_changes(const Polynomial& p, double lo, double hi) {
    SignChanges found;
    const double a = p.c[2], b = 0.5 * p.c[1], c = p.c[0];
    double r0 = 0, r1 = 0;
    if (a == 0) {
        if (b == 0) return found;
        r0 = r1 = -0.5 * c / b;
    } else {
        // b^2 - a c with one rounding's error (W. Kahan, "On the Cost of Floating-Point Computation
        // Without Extra-Precise Arithmetic", 2004): grazing is decided by its sign.
        const double ac = a * c;
        const double discriminant = std::fma(b, b, -ac) - std::fma(a, c, -ac);
        if (!(discriminant > 0)) return found;
        // The sum without cancellation first, the other root from the product.
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        r0 = q / a;
        r1 = q != 0 ? c / q : r0;
        if (r0 > r1) std::swap(r0, r1);
    }
    const auto add = [&](double r) {
        if (r > lo && r < hi) found.at[static_cast<std::size_t>(found.count++)] = r;
    };
    add(r0);
    if (r1 != r0) add(r1);
    return found;
}

SignChanges sign_changes(const Polynomial& p, double lo, double hi) {
    if (p.degree() <= 2) return quadratic_sign_changes(p, lo, hi);
    // Between two neighbouring extrema p is monotonic: at most one root, bracketed by its signs.
    // An extremum of exactly 0 decides nothing: the bracket goes on to the next one.
    const Polynomial slope = p.derivative();
    const SignChanges extrema = sign_changes(slope, lo, hi);
    SignChanges found;
    found.capped = extrema.capped;
    double left = lo;
    for (int i = 0; i <= extrema.count; ++i) {
        const double right = i < extrema.count ? extrema.at[static_cast<std::size_t>(i)] : hi;
        const double at_left = p(left), at_right = p(right);
        if (at_right == 0 && i < extrema.count) continue;
        if ((at_left < 0 && at_right > 0) || (at_left > 0 && at_right < 0))
            found.at[static_cast<std::size_t>(found.count++)] =
                root_in_bracket(p, slope, left, right, found.capped);
        left = right;
    }
    return found;
}

}  // namespace

double Polynomial::operator()(double s) const {
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * c[4])));
}

Polynomial Polynomial::derivative() const { return {{c[1], 2 * c[2], 3 * c[3], 4 * c[4], 0}}; }

Polynomial Polynomial::divided_by_s() const { return {{c[1], c[2], c[3], c[4], 0}}; }

int Polynomial::degree() const {
    for (int i = kMaxDegree; i > 0; --i)
        if (c[static_cast<std::size_t>(i)] != 0) return i;
    return 0;
}

Roots downward_crossings(const Polynomial& p, double horizon) {
    Roots roots;
    if (!(horizon > 0)) return roots;
    // A little beyond the horizon, so that a root at the horizon itself lies inside the bracket.
    const double end = horizon * (1 + 4 * std::numeric_limits<double>::epsilon());
    const SignChanges changes = sign_changes(p, 0, end);
    roots.capped = changes.capped;
    for (int i = 0; i < changes.count; ++i) {
        const double s = changes.at[static_cast<std::size_t>(i)];
        if (s > horizon) break;
        const double before = i > 0 ? changes.at[static_cast<std::size_t>(i - 1)] : 0;
        const double after =
            i + 1 < changes.count ? changes.at[static_cast<std::size_t>(i + 1)] : end;
        const double from = p(0.5 * (before + s)), to = p(0.5 * (s + after));
        if (from > 0 && to < 0) roots.add(s);
        // Where one side is too narrow to tell, the slope at the root decides.
        else if (!(from < 0 && to > 0) && p.derivative()(s) < 0)
            roots.add(s);
    }
    return roots;
}

}  // namespace carom
