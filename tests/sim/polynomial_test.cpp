// Crossings of polynomials, against roots that they are built from.
#include "sim/math/polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace carom {
namespace {

/// scale * product of (s - root).
Polynomial with_roots(const std::vector<double>& roots, double scale) {
    Polynomial p{{scale, 0, 0, 0, 0}};
    for (const double r : roots)
        for (std::size_t i = 5; i-- > 0;) p.c[i] = (i > 0 ? p.c[i - 1] : 0) - r * p.c[i];
    return p;
}

TEST(Polynomial, ValueAndDerivative) {
    const Polynomial p{{1, -2, 3, -4, 5}};
    EXPECT_EQ(p(2), 1 - 4 + 12 - 32 + 80);
    EXPECT_EQ(p.derivative()(2), -2 + 12 - 48 + 160);
    EXPECT_EQ(p.degree(), 4);
    EXPECT_EQ((Polynomial{{1, 0, 0, 0, 0}}).degree(), 0);
    EXPECT_EQ((Polynomial{{0, 1, 2, 0, 0}}).divided_by_s()(3), 7);
}

TEST(Polynomial, CrossingsAreTheRootsOnTheWayDown) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    double worst = 0;
    int found = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const auto degree = static_cast<std::size_t>(1 + trial % 4);
        std::vector<double> roots;
        double at = unit(random) - 1;
        // Apart, so that the roots are well conditioned; some lie before 0.
        for (std::size_t i = 0; i < degree; ++i) roots.push_back(at += 0.2 + unit(random));
        const double sign = trial / 4 % 2 == 0 ? 1 : -1;
        const double scale = sign * std::pow(10, 20 * unit(random) - 10);
        const Polynomial p = with_roots(roots, scale);
        std::vector<double> expected;
        for (std::size_t i = 0; i < degree; ++i) {
            // Behind the last root the sign is that of the scale; it alternates.
            const bool down = ((degree - i) % 2 == 0) == (sign > 0);
            if (roots[i] > 0 && down) expected.push_back(roots[i]);
        }
        const Roots crossings = downward_crossings(p, 10);
        ASSERT_FALSE(crossings.capped);
        ASSERT_EQ(crossings.count, static_cast<int>(expected.size())) << "trial " << trial;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            worst = std::max(worst, std::abs(crossings.at[i] - expected[i]) / expected[i]);
            ++found;
        }
    }
    std::printf("%d crossings within %.3g\n", found, worst);
    EXPECT_GT(found, 2000);
    EXPECT_LE(worst, 1e-10);  // the coefficients themselves are rounded
}

TEST(Polynomial, HorizonCounts) {
    const Polynomial p{{1, -1, 0, 0, 0}};
    EXPECT_EQ(downward_crossings(p, 0.999).count, 0);
    EXPECT_EQ(downward_crossings(p, 1).count, 1);
    EXPECT_EQ(downward_crossings(p, 0).count, 0);
    EXPECT_EQ(downward_crossings(p, -1).count, 0);
}

TEST(Polynomial, TouchingZeroIsNoCrossing) {
    for (const double root : {0.5, 1.0, 2.0}) {
        EXPECT_EQ(downward_crossings(with_roots({root, root}, 1), 10).count, 0);
        EXPECT_EQ(downward_crossings(with_roots({root, root, root, root}, 1), 10).count, 0);
        // Twice there, and twice more: still never below.
        EXPECT_EQ(downward_crossings(with_roots({root, root, 2 * root, 2 * root}, 1), 10).count, 0);
    }
}

TEST(Polynomial, GrazingIsDecidedBySign) {
    for (const double depth : {1e-15, 1e-12, 1e-9, 1e-6})
        for (const double scale : {1e-6, 1.0, 1e6}) {
            // (s - 1)^2 + depth and - depth.
            const Polynomial above{{scale * (1 + depth), -2 * scale, scale, 0, 0}};
            const Polynomial below{{scale * (1 - depth), -2 * scale, scale, 0, 0}};
            EXPECT_EQ(downward_crossings(above, 10).count, 0);
            const Roots crossing = downward_crossings(below, 10);
            ASSERT_EQ(crossing.count, 1) << depth;
            EXPECT_NEAR(crossing.at[0], 1 - std::sqrt(depth), 1e-15 / std::sqrt(depth));
        }
}

TEST(Polynomial, WhatIsBelowMustRiseFirst) {
    // Below 0 from the start, then up at 1 and down at 3.
    const Roots later = downward_crossings(with_roots({1, 3}, -1), 10);
    ASSERT_EQ(later.count, 1);
    EXPECT_NEAR(later.at[0], 3, 1e-15);
    // Below 0 and falling: never.
    EXPECT_EQ(downward_crossings(Polynomial{{-1, -1, 0, 0, 0}}, 10).count, 0);
}

/// Places where Newton's method leaves its bracket, cycles or creeps.
TEST(Polynomial, NewtonIsKeptInItsBracket) {
    for (const double flat : {1e-3, 1e-6, 1e-9}) {
        // Almost a triple root: the slope at the start points far away.
        const Polynomial p{{1 + flat, -(3 + flat), 3, -1, 0}};
        const Roots crossing = downward_crossings(p, 10);
        ASSERT_EQ(crossing.count, 1);
        EXPECT_FALSE(crossing.capped);
        EXPECT_NEAR(p(crossing.at[0]), 0, 1e-15);
    }
    const Polynomial steep{{1, 0, 0, 0, -1e-24}};
    const Roots far = downward_crossings(steep, 1e9);
    ASSERT_EQ(far.count, 1);
    EXPECT_NEAR(far.at[0], 1e6, 1e-8);
    EXPECT_EQ(downward_crossings(Polynomial{}, 10).count, 0);
}

}  // namespace
}  // namespace carom
