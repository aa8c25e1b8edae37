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

/// As a run goes through it: the first is taken, what is upcoming is looked at, and some balls,
/// often the taken one among them, get new times.
TEST(EventQueue, WhatIsTakenIsGone) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    for (const int balls : {1, 2, 5, 37}) {
        EventQueue list(static_cast<std::size_t>(balls));
        std::vector<double> times(static_cast<std::size_t>(balls), kNever);
        const auto least = [&] {
            const auto found = std::min_element(times.begin(), times.end());
            return std::pair(*found, static_cast<int>(found - times.begin()));
        };
        std::mt19937 random(7);
        double now = 0;
        for (int i = 0; i < 5000; ++i) {
            const auto [time, ball] = least();
            ASSERT_EQ(list.first().time, time);
            ASSERT_EQ(list.upcoming().time, time);
            if (time < kNever) {
                ASSERT_EQ(list.first().ball, ball);
                now = time;
                list.take_first();
                times[static_cast<std::size_t>(ball)] = kNever;
                ASSERT_EQ(list.upcoming().time, least().first);
            }
            for (unsigned k = random() % 4; k > 0; --k) {
                const int other =
                    random() % 2 == 0 ? ball : static_cast<int>(random() % 1000) % balls;
                const double next = now + static_cast<double>(random() % 8);
                list.put(other, next);
                times[static_cast<std::size_t>(other)] = next;
            }
        }
    }
}

TEST(EventQueue, OfNoBallsHasNothingDue) {
    EventQueue list(0);
    EXPECT_TRUE(std::isinf(list.first().time));
}

}  // namespace
}  // namespace carom
