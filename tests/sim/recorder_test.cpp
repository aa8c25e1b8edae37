// Steps become pieces: few of them, and they say what the steps said.
#include "sim/record/recorder.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sim/fixed/ode_world.h"

namespace carom {
namespace {

using namespace testing;

constexpr double kStep = 1e-3;

/// Steps of a given acceleration, made by hand: ODE's rule in two lines.
struct Hand {
    Vec3 x{0, 0, 1}, v{1, 0, 0}, w{0, 0, 0};
    int n = 0;

    Step advance(const Vec3& acceleration, const Vec3& spin_rate, bool touching,
                 bool impact = false) {
        Step step;
        step.start = n * kStep;
        step.end = ++n * kStep;
        step.position = x;
        step.before = {v, w};
        v += kStep * acceleration;
        w += kStep * spin_rate;
        x += kStep * v;
        step.end_position = x;
        step.mean = {v, w};
        step.touching = touching;
        step.impact = impact;
        return step;
    }
};

const Vec3 kDown(0, 0, -kGravity);

TEST(Recorder, FlightIsOneParabolaThroughAllSteps) {
    Recorder recorder(0.1, kDown);
    Hand hand;
    std::vector<Step> steps;
    for (int i = 0; i < 5000; ++i) {
        steps.push_back(hand.advance(kDown, Vec3::Zero(), false));
        recorder.add(steps.back());
    }
    const Trajectory ball = recorder.finish();
    ASSERT_EQ(ball.pieces().size(), 1u);
    EXPECT_EQ(ball.pieces()[0].acceleration, kDown);
    double off = 0, off_velocity = 0;
    for (const Step& step : steps) {
        const BallState state = ball.at(step.start);
        off = std::max(off, (state.position - step.position).norm());
        // ODE's velocity lags the parabola's by half a step.
        const Vec3 lag = 0.5 * kStep * kDown;
        off_velocity = std::max(off_velocity, (state.velocity - step.before.linear - lag).norm());
    }
    fmt::print("5000 steps in one piece: {:.1e} m, {:.1e} m/s\n", off, off_velocity);
    EXPECT_LT(off, 5000 * 1e-14);  // a rounding of 120 m a step
    EXPECT_LT(off_velocity, 5000 * 5e-15);
}

TEST(Recorder, ChangesOfMotionBeginPieces) {
    Recorder recorder(0.1, kDown);
    Hand hand;
    std::vector<Step> steps;
    const auto add = [&](const Step& step) {
        steps.push_back(step);
        recorder.add(step);
    };
    for (int i = 0; i < 300; ++i) add(hand.advance(kDown, Vec3::Zero(), false));
    add(hand.advance({0, 0, 5 / kStep}, {0, 20 / kStep, 0}, true, true));  // an impact
    // It still overlaps, but the joint does nothing.
    add(hand.advance(kDown, Vec3::Zero(), true));
    for (int i = 0; i < 300; ++i) add(hand.advance(kDown, Vec3::Zero(), false));
    for (int i = 0; i < 300; ++i) add(hand.advance({-2, 0, 0}, {0, 3, 0}, true));       // slides
    for (int i = 0; i < 300; ++i) add(hand.advance(Vec3::Zero(), Vec3::Zero(), true));  // rolls
    const Trajectory ball = recorder.finish();
    ASSERT_EQ(ball.pieces().size(), 4u);
    EXPECT_DOUBLE_EQ(ball.pieces()[1].start, 300 * kStep);
    EXPECT_DOUBLE_EQ(ball.pieces()[2].start, 602 * kStep);
    EXPECT_DOUBLE_EQ(ball.pieces()[3].start, 902 * kStep);
    for (const Step& step : steps)
        EXPECT_LT((ball.at(step.start).position - step.position).norm(), 1e-11) << step.start;
}

TEST(Recorder, PiecesMeetInPositionAndOrientation) {
    Scene scene = scene_of(0.7, 0.4, kGravity, kStep);
    add_plane(scene);
    add_plane(scene, {-1, 0, 0}, -3);
    add_ball(scene, {0, 0, 1}, {2, 0.5, 0}).spin = Vec3(3, -20, 8);
    const auto result = run(scene, 6);
    const auto& pieces = result.motion.balls[0].pieces();
    ASSERT_GT(pieces.size(), 10u);
    double gap = 0, turn = 0;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        const BallState end = pieces[i - 1].at(pieces[i].start);
        gap = std::max(gap, (end.position - pieces[i].position).norm());
        turn = std::max(turn, end.orientation.angularDistance(pieces[i].orientation));
    }
    fmt::print("{} pieces meet to {:.1e} m and {:.1e} rad\n", pieces.size(), gap, turn);
    EXPECT_LT(gap, 1e-11);
    EXPECT_LT(turn, 1e-7);  // angularDistance itself is good to the root of rounding
}

// The trajectory goes through ODE's own positions: the same world stepped beside it.
TEST(Recorder, FollowsOdeStepForStep) {
    Scene scene = scene_of(1, 0, kGravity, kStep);
    add_ball(scene, {1, 2, 3}, {4, 5, 6}).spin = Vec3(7, 8, 9);
    const auto result = run(scene, 3);
    OdeWorld world(scene);
    for (int n = 0; n < 3000; ++n) {
        const Vec3 off = result.motion.balls[0].at(n * kStep).position - world.position(0);
        ASSERT_LT(off.norm(), 1e-11) << n;
        world.step(kStep, 0);
    }
}

// Sliding whose spin turns: orientation from the pieces against many small turns.
TEST(Recorder, OrientationOfATurningSpinIsIntegrated) {
    Scene scene = scene_of(0.5, 0.2, kGravity, kStep);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1}, {3, 0, 0}).spin = Vec3(40, 0, 25);
    const auto result = run(scene, 0.4);
    const Trajectory& ball = result.motion.balls[0];
    EXPECT_GT(ball.pieces().size(), 20u);
    Quat q = Quat::Identity();
    const int n = 400000;
    for (int i = 0; i < n; ++i) {
        const Vec3 w = ball.at((i + 0.5) * 0.4 / n).spin;
        q = Quat(Eigen::AngleAxisd(w.norm() * 0.4 / n, w.normalized())) * q;
    }
    const Quat found = ball.at(0.4).orientation;
    const double off = 2 * (found.conjugate() * q).vec().norm();
    fmt::print("orientation off by {:.1e} rad after 0.4 s at 47 rad/s, {} pieces\n", off,
               ball.pieces().size());
    EXPECT_LT(off, 1e-7);
}

}  // namespace
}  // namespace carom
