// Pieces and trajectories as functions of time.
#include "motion/motion.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

Piece piece(double start, const Vec3& position, const Vec3& velocity, const Vec3& acceleration) {
    Piece p;
    p.start = start;
    p.position = position;
    p.velocity = velocity;
    p.acceleration = acceleration;
    return p;
}

TEST(Piece, IsAParabola) {
    const Piece p = piece(2, {1, 2, 3}, {4, 5, 6}, {0, 0, -10});
    const BallState s = p.at(2.5);
    EXPECT_EQ(s.position, Vec3(3, 4.5, 3 + 3 - 1.25));
    EXPECT_EQ(s.velocity, Vec3(4, 5, 1));
    EXPECT_EQ(s.orientation.coeffs(), Quat::Identity().coeffs());
}

TEST(Piece, TurnsInClosedFormAboutOneAxis) {
    Piece p;
    p.orientation = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
    p.spin = Vec3(0, 0, 2);
    p.spin_rate = Vec3(0, 0, -0.5);
    const BallState s = p.at(3);
    const double angle = 2 * 3 - 0.25 * 9;
    const Quat expected = Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())) * p.orientation;
    EXPECT_NEAR(std::abs(s.orientation.dot(expected)), 1, 1e-15);
    EXPECT_LT((s.spin - Vec3(0, 0, 0.5)).norm(), 1e-15);
    // One whole turn is no turn.
    p.spin_rate.setZero();
    EXPECT_NEAR(std::abs(p.at(M_PI).orientation.dot(p.orientation)), 1, 1e-15);
}

/// q' = spin q / 2 in many small turns about the spin in the middle of each.
Quat integrated(const Piece& p, double t, int n) {
    Quat q = p.orientation;
    for (int i = 0; i < n; ++i) {
        const Vec3 w = p.spin + (i + 0.5) * t / n * p.spin_rate;
        q = Quat(Eigen::AngleAxisd(w.norm() * t / n, w.normalized())) * q;
    }
    return q;
}

/// A piece with a curve of everything, for 0.4 s.
Piece curved() {
    Piece p = piece(1, {1, 2, 3}, {4, -5, 6}, {1, 0, -10});
    p.orientation = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
    p.spin = Vec3(1, -2, 0.5);
    p.spin_rate = Vec3(0.4, 1, -2);
    Curve curve;
    curve.seconds = 0.4;
    for (std::size_t i = 0; i < 6; ++i) {
        const double x = 0.1 * static_cast<double>(i + 1);
        curve.position[i] = Vec3(x, -0.2, 0.3 * x);
        curve.turn[i] = Vec3(-0.1, x, 0.05);
    }
    p.curve = OptionalCurve(curve);
    return p;
}

TEST(Piece, CurvesAreConsistent) {
    const Piece p = curved();
    const double h = 1e-5;
    double bound = 0;
    for (const double t : {1.0, 1.1, 1.25, 1.4}) {
        const BallState before = p.at(t - h), here = p.at(t), after = p.at(t + h);
        EXPECT_LT(((after.position - before.position) / (2 * h) - here.velocity).norm(), 1e-4);
        EXPECT_LT(((after.velocity - before.velocity) / (2 * h) - p.acceleration_at(t)).norm(),
                  1e-3);
        // q' = spin q / 2
        const Vec3 turn = 2 * (after.orientation * before.orientation.conjugate()).vec() / (2 * h);
        EXPECT_LT((turn - here.spin).norm(), 1e-5);
        bound = std::max(bound, p.acceleration_at(t).norm());
    }
    EXPECT_GE(p.largest_acceleration(), bound);
    EXPECT_GT(bound, 11);  // the curve is felt
}

TEST(Piece, CurvesAreValues) {
    const Piece p = curved();
    Piece copy = p;
    EXPECT_EQ(copy.at(1.3).position, p.at(1.3).position);
    copy.curve = {};
    EXPECT_NE(copy.at(1.3).position, p.at(1.3).position);
    EXPECT_TRUE(p.curve);

    Motion with, without;
    with.balls.resize(1);
    without.balls.resize(1);
    with.balls[0].append(p);
    without.balls[0].append(copy);
    EXPECT_NE(with.hash(), without.hash());
}

TEST(Piece, TurnsToFourthOrderAboutATurningAxis) {
    Piece p;
    p.spin = Vec3(3, -1, 2);
    p.spin_rate = Vec3(-2, 5, 4);
    const auto error = [&p](double t) {
        return 2 * (p.at(t).orientation.conjugate() * integrated(p, t, 200000)).vec().norm();
    };
    const double at_tenth = error(0.1), at_fifth = error(0.2);
    fmt::print(
        "off by {:.1e} rad after 0.1 s, {:.1e} after 0.2 s: ratio {:.1f} (fifth order: 32)\n",
        at_tenth, at_fifth, at_fifth / at_tenth);
    EXPECT_LT(at_tenth, 1e-5);
    EXPECT_GT(at_fifth / at_tenth, 24);
    EXPECT_LT(at_fifth / at_tenth, 42);
}

TEST(Trajectory, FindsThePieceOfAnInstant) {
    Trajectory ball;
    ball.append(piece(0, {0, 0, 0}, {1, 0, 0}, Vec3::Zero()));
    ball.append(piece(1, {1, 0, 0}, {0, 1, 0}, Vec3::Zero()));
    ball.append(piece(3, {1, 2, 0}, {0, 0, 1}, Vec3::Zero()));
    EXPECT_EQ(ball.piece_index(0), 0u);
    EXPECT_EQ(ball.piece_index(std::nextafter(1.0, 0.0)), 0u);
    EXPECT_EQ(ball.piece_index(1), 1u);  // at an instant of change, the state after it
    EXPECT_EQ(ball.piece_index(2.9), 1u);
    EXPECT_EQ(ball.piece_index(100), 2u);
    EXPECT_EQ(ball.at(1).velocity, Vec3(0, 1, 0));
    EXPECT_EQ(ball.at(4).position, Vec3(1, 2, 1));
    EXPECT_EQ(ball.piece_index(-1), 0u);
}

TEST(Trajectory, ALaterPieceOfTheSameStartReplaces) {
    Trajectory ball;
    ball.append(piece(0, {0, 0, 0}, {1, 0, 0}, Vec3::Zero()));
    ball.append(piece(0, {0, 0, 0}, {2, 0, 0}, Vec3::Zero()));
    ASSERT_EQ(ball.pieces().size(), 1u);
    EXPECT_EQ(ball.at(0).velocity.x(), 2);
    ball.append(piece(1, {2, 0, 0}, {2, 0, 0}, Vec3::Zero()));
    EXPECT_ANY_THROW(ball.append(piece(0.5, {0, 0, 0}, {0, 0, 0}, Vec3::Zero())));
}

TEST(Motion, HashSeesEverythingButTheSignOfZero) {
    Motion motion;
    motion.duration = 1;
    motion.balls.resize(1);
    motion.balls[0].append(piece(0, {1, 2, 3}, {0, 0, 0}, Vec3::Zero()));
    motion.events.resize(1);
    const std::uint64_t hash = motion.hash();
    EXPECT_EQ(Motion(motion).hash(), hash);

    Motion other = motion;
    other.events[0].impulse = 1e-300;
    EXPECT_NE(other.hash(), hash);
    other = motion;
    other.balls[0] = Trajectory();
    other.balls[0].append(piece(0, {1, 2, std::nextafter(3.0, 4.0)}, {0, 0, 0}, Vec3::Zero()));
    EXPECT_NE(other.hash(), hash);
    other.balls[0] = Trajectory();
    other.balls[0].append(piece(0, {1, 2, 3}, {-0.0, 0, 0}, Vec3::Zero()));
    EXPECT_EQ(other.hash(), hash);
}

TEST(Trajectory, LetsGoWhatLiesBehindAndKeepsTheRest) {
    const auto place = [](double k) { return Vec3(k, 0.5 * k, -k); };
    Trajectory ball;
    std::size_t most = 0;
    for (int k = 0; k < 1000; ++k) {
        ball.append(piece(k, place(k), {0, 0, k + 1.0}, {0, 0, -1}));
        ball.let_go_before(k - 9.5);
        most = std::max(most, ball.pieces().size());
        for (int back = 0; back < std::min(k, 9); ++back) {
            const double t = k - back - 0.5;
            EXPECT_EQ(ball.at(t).position.x(), k - back - 1) << t;
        }
    }
    EXPECT_GE(most, 10U);
    EXPECT_LE(most, 24U);
    ball.let_go_before(1e9);  // the last one holds for ever
    EXPECT_EQ(ball.at(1e9).position.x(), 999);
}

}  // namespace
}  // namespace carom
