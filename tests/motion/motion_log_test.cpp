#include "motion/motion_log.h"

#include <gtest/gtest.h>

#include <random>

namespace carom {
namespace {

Piece piece_at(double start, double x) {
    Piece p;
    p.start = start;
    p.position = Vec3(x, 0, 0);
    return p;
}

// In the end the trajectories are those to which each piece went at once, pieces that replace one
// another included.
TEST(MotionLog, IsWhatAppendingAtOnceGives) {
    constexpr std::size_t kBalls = 7;
    std::mt19937 numbers(2);
    Motion now, later;
    now.balls.resize(kBalls);
    later.balls.resize(kBalls);
    MotionLog log(kBalls);
    double t = 0;
    for (int i = 0; i < 3000; ++i) {
        const int ball = static_cast<int>(numbers() % (kBalls - 1));  // the last one never moves
        if (numbers() % 4 != 0) t += 1e-3;
        Piece p = piece_at(t, i);
        if (i % 5 == 0) {
            Curve curve;
            curve.position[0] = Vec3(i, 1, 2);
            p.curve = OptionalCurve(curve);
        }
        now.balls[static_cast<std::size_t>(ball)].append(p);
        log.append(ball, p);
    }
    log.move_into(later.balls);
    std::size_t pieces = 0;
    for (std::size_t b = 0; b < kBalls; ++b) {
        ASSERT_EQ(now.balls[b].pieces().size(), later.balls[b].pieces().size());
        pieces += now.balls[b].pieces().size();
    }
    EXPECT_LT(pieces, 3000u);  // some were replaced
    EXPECT_GT(pieces, 2000u);
    EXPECT_TRUE(later.balls.back().pieces().empty());
    EXPECT_EQ(now.hash(), later.hash());
}

}  // namespace
}  // namespace carom
