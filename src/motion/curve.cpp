#include "motion/curve.h"

#include <cmath>

namespace carom {

namespace {

/// Horner's rule for factor(k) c[k] u^k, k = 0 ... 5.
template <class Factor>
Vec3 horner(const Curve::Terms& terms, double u, Factor&& factor) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = terms.size(); i-- > 0;)
        sum = u * sum + factor(static_cast<double>(i)) * terms[i];
    return sum;
}

/// Below this turn (x - sin x) / x^3 is its series, above it cancels little.
constexpr double kSmallTurn = 0.5;

}  // namespace

Vec3 curve_value(const Curve::Terms& terms, double u) {
    return (u * u * u) * horner(terms, u, [](double) { return 1.0; });
}

Vec3 curve_rate(const Curve::Terms& terms, double u, double seconds) {
    return (u * u / seconds) * horner(terms, u, [](double k) { return k + 3; });
}

Vec3 curve_second_rate(const Curve::Terms& terms, double u, double seconds) {
    return (u / seconds / seconds) * horner(terms, u, [](double k) { return (k + 3) * (k + 2); });
}

Vec3 spin_of_turn(const Vec3& turn, const Vec3& turn_rate) {
    const double x2 = turn.squaredNorm(), x = std::sqrt(x2);
    const double half_sine = x > 0 ? std::sin(0.5 * x) / (0.5 * x) : 1;
    const double first = 0.5 * half_sine * half_sine;
    const double second =
        x < kSmallTurn
            ? 1.0 / 6 - x2 * (1.0 / 120 - x2 * (1.0 / 5040 - x2 * (1.0 / 362880 - x2 / 39916800)))
            : (x - std::sin(x)) / (x2 * x);
    const Vec3 across = turn.cross(turn_rate);
    return turn_rate + first * across + second * turn.cross(across);
}

}  // namespace carom
