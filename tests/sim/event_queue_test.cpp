// The list of due events against a plain search of all times.
#include "sim/world/event_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace carom {
namespace {

TEST(EventQueue, GivesTheEarliestAndAtOneInstantTheFirstBall) {
    constexpr int kBalls = 37;
    EventQueue list(kBalls);
    std::vector<double> times(kBalls, std::numeric_limits<double>::infinity());
    std::mt19937 random(5);
    int ties = 0;
    for (int i = 0; i < 20'000; ++i) {
        const int ball = static_cast<int>(random() % kBalls);
        if (random() % 5 == 0) {
            list.drop(ball);
            times[static_cast<std::size_t>(ball)] = std::numeric_limits<double>::infinity();
        } else {
            const double time = static_cast<double>(random() % 16);  // many at one instant
            list.put(ball, time);
            times[static_cast<std::size_t>(ball)] = time;
        }
        std::pair<double, int> least{times[0], 0};
        for (int b = 1; b < kBalls; ++b)
            least = std::min(least, {times[static_cast<std::size_t>(b)], b});
        ASSERT_EQ(list.first().time, least.first);
        if (std::isinf(least.first)) continue;
        ASSERT_EQ(list.first().ball, least.second);
        ties += std::count(times.begin(), times.end(), least.first) > 1 ? 1 : 0;
    }
    EXPECT_GT(ties, 1000);
}

TEST(EventQueue, OfNoBallsHasNothingDue) {
    const EventQueue list(0);
    EXPECT_TRUE(std::isinf(list.first().time));
}

}  // namespace
}  // namespace carom
