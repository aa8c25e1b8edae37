// Curves through points against the points, a straight line, and what monotone means.
#include "core/monotone_curve.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(MonotoneCurve, GoesThroughItsPointsAndStaysBeyondThem) {
    const MonotoneCurve curve({0, 1, 3, 4}, {5, 2, 2, 7});
    for (const auto& [x, y] : {std::pair{0.0, 5.0}, {1.0, 2.0}, {3.0, 2.0}, {4.0, 7.0}})
        EXPECT_EQ(curve.at(x), y);
    EXPECT_EQ(curve.at(-1), 5);
    EXPECT_EQ(curve.at(9), 7);
    EXPECT_EQ(MonotoneCurve().at(3), 0);
    EXPECT_EQ(MonotoneCurve({2}, {6}).at(-5), 6);
}

/// On a line the slopes inside are the line's: between them the curve is the line.
TEST(MonotoneCurve, IsALineWhereThePointsAre) {
    const MonotoneCurve curve({0, 1, 2.5, 3, 5}, {1, 3, 6, 7, 11});
    for (double x = 1; x <= 3; x += 0.125) EXPECT_NEAR(curve.at(x), 1 + 2 * x, 1e-14);
}

TEST(MonotoneCurve, NeverTurnsBetweenPoints) {
    const MonotoneCurve curve({0, 1, 1.1, 4, 5}, {0, 0.1, 3, 3.2, 9});
    double last = curve.at(0);
    for (int i = 1; i <= 5000; ++i) {
        const double now = curve.at(i * 1e-3);
        EXPECT_GE(now, last);
        last = now;
    }
}

}  // namespace
}  // namespace carom
