// Roots in a bracket, and where a quantity along a piece first turns negative.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/math/bracketed_root.h"
#include "sim/math/event_location.h"

namespace carom {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

TEST(BracketedRoot, IsRightToTheLastDigits) {
    EXPECT_NEAR(bracketed_root([](double x) { return 2 - x * x; }, 0, 2), std::sqrt(2.0),
                2 * kEpsilon);
    EXPECT_NEAR(bracketed_root([](double x) { return std::cos(x); }, 0, 3), M_PI / 2, 2 * kEpsilon);
    // A steep one, a flat one, and one that bisection alone would take a thousand halvings for.
    EXPECT_NEAR(bracketed_root([](double x) { return 1 - std::exp(50 * (x - 0.9)); }, 0, 1), 0.9,
                2 * kEpsilon);
    EXPECT_NEAR(bracketed_root([](double x) { return std::pow(0.3 - x, 3); }, 0, 1), 0.3, 1e-6);
    EXPECT_NEAR(bracketed_root([](double x) { return 1e-30 - x; }, 0, 1) / 1e-30, 1, 1e-12);
}

TEST(BracketedRoot, EndsWithFewEvaluations) {
    int evaluations = 0;
    bracketed_root(
        [&](double x) {
            ++evaluations;
            return std::cos(x) - x;
        },
        0, 1);
    EXPECT_LE(evaluations, 12);
}

TEST(BracketedRoot, WhereRoundingTookTheSignItIsTheLowerEnd) {
    EXPECT_EQ(bracketed_root([](double) { return 1.0; }, 0, 1), 1);
}

/// The answer of a function that is known everywhere.
template <class F>
std::optional<double> first_negative(const F& f, double h, double limit, bool skip = false) {
    const EventLocation location(
        h, [&](std::size_t j) { return f(sample_time(h, j)); }, [&](double s) { return f(s); });
    return location.first_negative(f, limit, skip);
}

TEST(EventLocation, FindsTheFirstChangeOfSign) {
    const auto f = [](double s) { return std::cos(3 * s); };  // below 0 from pi/6 on
    EXPECT_NEAR(first_negative(f, 1, 1).value(), M_PI / 6, 2 * kEpsilon);
    EXPECT_FALSE(first_negative(f, 0.5, 0.5).has_value());
    EXPECT_FALSE(first_negative([](double s) { return 1 + s; }, 1, 1).has_value());
}

/// Below 0 for 0.02 of a piece, between two of its samples.
TEST(EventLocation, FindsADipBetweenSamples) {
    const double middle = 0.4375, half = 0.01;  // samples are at 0.375 and 0.5
    const auto f = [&](double s) { return (s - middle) * (s - middle) - half * half; };
    EXPECT_NEAR(first_negative(f, 1, 1).value(), middle - half, 4 * kEpsilon);
    const auto touches = [&](double s) { return (s - middle) * (s - middle); };
    EXPECT_FALSE(first_negative(touches, 1, 1).has_value());
}

TEST(EventLocation, WhatStartsNegativeEndsAtOnceUnlessToldOtherwise) {
    const auto f = [](double s) { return s - 0.3; };
    EXPECT_EQ(first_negative(f, 1, 1).value(), 0);
    EXPECT_FALSE(first_negative(f, 1, 1, true).has_value());
    const auto back = [](double s) { return (s - 0.2) * (0.6 - s); };
    EXPECT_NEAR(first_negative(back, 1, 1, true).value(), 0.6, 2 * kEpsilon);
}

TEST(EventLocation, LooksNoFurtherThanTheLimit) {
    const auto f = [](double s) { return 0.9 - s; };
    EXPECT_FALSE(first_negative(f, 1, 0.5).has_value());
}

}  // namespace
}  // namespace carom
