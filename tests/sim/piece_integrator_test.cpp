// The integrator on a law that is not carom's, with a closed form: balls on springs, whose spins
// fade; and turns that come from spins.
#include "sim/integrate/piece_integrator.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carom {
namespace {

constexpr double kRate = 3;  // rad/s

/// x'' = -w^2 x, and a spin that fades: w' = -k w. The guard turns negative at z = floor.
struct SwingLaw {
    static constexpr std::size_t kBalls = 2;
    static constexpr double kStepError = 1e-14;
    static constexpr int kMostEvaluations = 20'000;
    static constexpr double kFitError = 2e-14;
    static constexpr double kFitSpeedError = 1e-12;
    using State = std::array<ContactState, 2>;
    struct Forces {
        std::array<Vec3, 2> a, b;
    };

    double floor = -10;

    std::size_t ball_count() const { return 2; }
    double size() const { return 0.1; }
    double speed() const { return 1; }
    Forces forces(const State& s) const {
        Forces f;
        for (std::size_t i = 0; i < 2; ++i) {
            f.a[i] = -kRate * kRate * s[i].x;
            f.b[i] = -kRate * s[i].w;
        }
        return f;
    }
    const Vec3& acceleration(const Forces& f, std::size_t i) const { return f.a[i]; }
    const Vec3& spin_rate(const Forces& f, std::size_t i) const { return f.b[i]; }
    double energy_error(const State&, const State&) const { return 0; }  // places decide
    int guard_count() const { return 1; }
    double guard(int, const State& s, const Forces&) const { return s[1].x.z() - floor; }
    bool skip_start(int) const { return false; }
};

SwingLaw::State start() {
    SwingLaw::State s;
    s[0] = {Vec3(0.2, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 4)};
    s[1] = {Vec3(0, 0, 0.3), Vec3::Zero(), Vec3(1, 2, -2)};
    return s;
}

/// From piece to piece up to `end`; the state there.
SwingLaw::State integrate_to(const SwingLaw& law, double end, int& pieces) {
    SwingLaw::State at = start();
    double guess = 0.05, now = 0;
    for (pieces = 0; now < end; ++pieces) {
        const auto piece = PieceIntegrator(law, at).next(now, std::min(guess, end - now));
        EXPECT_FALSE(piece.given_up);
        if (!(piece.seconds > 0)) break;
        now += piece.seconds;
        at = piece.end_state;
        guess = piece.next_seconds;
    }
    return at;
}

TEST(PieceIntegrator, SwingsAsTheClosedFormDoes) {
    int pieces = 0;
    const double t = 2;
    const SwingLaw::State at = integrate_to(SwingLaw{}, t, pieces);
    const double c = std::cos(kRate * t), s = std::sin(kRate * t), fade = std::exp(-kRate * t);
    EXPECT_LT((at[0].x - Vec3(0.2 * c, 0.5 / kRate * s, 0)).norm(), 1e-13);
    EXPECT_LT((at[0].v - Vec3(-0.2 * kRate * s, 0.5 * c, 0)).norm(), 1e-12);
    EXPECT_LT((at[1].x - Vec3(0, 0, 0.3 * c)).norm(), 1e-13);
    EXPECT_LT((at[1].w - fade * Vec3(1, 2, -2)).norm(), 1e-13);
    EXPECT_LT(pieces, 80);
}

/// Positions, velocities and turns of the polynomial itself, within the piece.
TEST(PieceIntegrator, ItsPolynomialsAreTheSolution) {
    const SwingLaw law;
    const SwingLaw::State from = start();
    const auto piece = PieceIntegrator(law, from).next(0, 0.5);
    ASSERT_GT(piece.seconds, 0.01);
    for (const double part : {0.1, 0.37, 0.5, 0.81, 1.0}) {
        const double s = part * piece.seconds, c = std::cos(kRate * s), f = std::exp(-kRate * s);
        EXPECT_LT((piece.pieces[1].position_at(s) - Vec3(0, 0, 0.3 * (c - 1))).norm(), 1e-14);
        EXPECT_LT((piece.pieces[1].velocity_at(s) - Vec3(0, 0, -0.3 * kRate * std::sin(kRate * s)))
                      .norm(),
                  1e-12);
        EXPECT_LT((piece.pieces[1].spin_at(s) - f * Vec3(1, 2, -2)).norm(), 1e-11);
    }
}

TEST(PieceIntegrator, EndsWhereAGuardTurnsNegative) {
    SwingLaw law;
    law.floor = 0.1;
    SwingLaw::State at = start();
    double now = 0, guess = 0.05;
    for (int i = 0; i < 200; ++i) {
        const auto piece = PieceIntegrator(law, at).next(now, guess);
        now += piece.seconds;
        at = piece.end_state;
        guess = piece.next_seconds;
        if (piece.guard < 0) continue;
        EXPECT_EQ(piece.guard, 0);
        EXPECT_NEAR(now, std::acos(1.0 / 3) / kRate, 1e-13);
        return;
    }
    FAIL() << "no end";
}

TEST(PieceIntegrator, GivesUpWhereNothingGetsOn) {
    SwingLaw::State from = start();
    from[0].v.x() = std::numeric_limits<double>::quiet_NaN();
    const auto piece = PieceIntegrator(SwingLaw{}, from).next(0, 0.1);
    EXPECT_TRUE(piece.given_up);
    EXPECT_EQ(piece.seconds, 0);
}

/// The spin of a turn whose rate is that of a spin is that spin.
TEST(TurnRate, IsTheInverseOfTheSpinOfATurn) {
    for (const double x : {0.0, 1e-8, 0.3, 1.0})
        for (const Vec3& w : {Vec3(1, 0, 0), Vec3(-2, 5, 0.3)}) {
            const Vec3 u = x * Vec3(2, -1, 2) / 3;
            EXPECT_LT((spin_of_turn(u, turn_rate(u, w)) - w).norm(), 4e-15 * w.norm()) << x;
        }
}

TEST(TurnRate, ItsSecondRateIsItsDerivative) {
    const Vec3 u(0.2, -0.3, 0.4), w(1, 2, -1), b(0.5, -3, 2);
    const double h = 1e-5;
    // u and w a moment before and after; their own second rates cancel.
    const Vec3 rate = turn_rate(u, w);
    const Vec3 after = turn_rate(u + h * rate, w + h * b),
               before = turn_rate(u - h * rate, w - h * b);
    EXPECT_LT((turn_second_rate(u, w, b) - (after - before) / (2 * h)).norm(), 1e-8);
}

}  // namespace
}  // namespace carom
