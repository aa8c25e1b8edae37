#include "sim/integrate/turn_rate.h"

#include <array>

namespace carom {

namespace {

/// c(x^2) = (1 - x/2 cot(x/2)) / x^2 as its series, and its derivative by x^2; |x| < 2 pi, meant
/// for |x| <= 1. The coefficients are |B_2n| / (2n)!, B the Bernoulli numbers.
struct TurnFactor {
    double value = 0, slope = 0;
    explicit TurnFactor(double x2) {
        constexpr std::array<double, 10> kTerms = {1.0 / 12,
                                                   1.0 / 720,
                                                   1.0 / 30240,
                                                   1.0 / 1209600,
                                                   1.0 / 47900160,
                                                   691.0 / 1307674368000,
                                                   1.0 / 74724249600,
                                                   3617.0 / 10670622842880000,
                                                   43867.0 / 5109094217170944000,
                                                   174611.0 / 802857662698291200000.0};
        for (std::size_t i = kTerms.size(); i-- > 0;) {
            slope = value + x2 * slope;
            value = kTerms[i] + x2 * value;
        }
    }
};

}  // namespace

Vec3 turn_rate(const Vec3& u, const Vec3& w) {
    const Vec3 across = u.cross(w);
    return w - 0.5 * across + TurnFactor(u.squaredNorm()).value * u.cross(across);
}

Vec3 turn_second_rate(const Vec3& u, const Vec3& w, const Vec3& b) {
    const TurnFactor c(u.squaredNorm());
    const Vec3 rate = turn_rate(u, w), across = u.cross(w);
    const Vec3 across_rate = rate.cross(w) + u.cross(b);
    return b - 0.5 * across_rate + (2 * u.dot(rate) * c.slope) * u.cross(across) +
           c.value * (rate.cross(across) + u.cross(across_rate));
}

}  // namespace carom
