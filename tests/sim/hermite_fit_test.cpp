// Polynomials through a solution's nodes.
#include "sim/math/hermite_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carom {
namespace {

/// A polynomial of degree 8 is its own fit.
TEST(HermiteFit, APolynomialOfItsDegreeIsMet) {
    const double h = 0.7;
    Curve::Terms terms;
    for (std::size_t i = 0; i < terms.size(); ++i)
        terms[i] = Vec3(1.0 + double(i), -0.5 * double(i), 2.0 - double(i));
    const Vec3 x(0.1, 2, -1), v(3, -2, 0.5), a(-1, 0.3, 9);
    const auto node = [&](double u) {
        const double s = u * h;
        return CurveNode{x + s * v + (0.5 * s * s) * a + curve_value(terms, u),
                         v + s * a + curve_rate(terms, u, h), a + curve_second_rate(terms, u, h)};
    };
    const Curve::Terms fitted = curve_through(node(0), node(0.5), node(1), h);
    for (std::size_t i = 0; i < terms.size(); ++i)
        EXPECT_LT((fitted[i] - terms[i]).norm(), 1e-11) << i;
}

/// Nine conditions: what is left of a function is of the order h^9 (exp has all derivatives).
TEST(HermiteFit, TheErrorFallsWithTheNinthPower) {
    const auto error = [](double h) {
        const auto node = [&](double u) {
            const Vec3 e = Vec3::Constant(std::exp(u * h));
            return CurveNode{e, e, e};
        };
        const Curve::Terms terms = curve_through(node(0), node(0.5), node(1), h);
        double worst = 0;
        for (int i = 0; i <= 100; ++i) {
            const double u = i / 100.0, s = u * h;
            const double value = 1 + s + 0.5 * s * s + curve_value(terms, u).x();
            worst = std::max(worst, std::abs(value - std::exp(s)));
        }
        return worst;
    };
    EXPECT_LT(error(1), 1e-8);
    EXPECT_NEAR(std::log2(error(2) / error(1)), 9, 1.2);
}

}  // namespace
}  // namespace carom
