// Whole runs: determinism, both solvers, many balls, and how a run fails.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/failure.h"
#include "scenes.h"

namespace carom {
namespace {

using namespace testing;

constexpr double kBall = 0.06;  // radius, m

/// Balls that fall into a box of one square metre.
Scene pile(int balls, Solver solver) {
    Scene scene = scene_of(0.5, 0.3, kGravity, 1e-3);
    scene.simulation.solver = solver;
    use_pair(scene, 0.5, 0.3);
    add_plane(scene);
    for (double side : {-1.0, 1.0})
        for (int axis : {0, 1}) add_plane(scene, side * Vec3::Unit(axis), -0.5);
    for (int i = 0; i < balls; ++i) {
        const Vec3 cell(i % 5 - 2, (i / 5) % 5 - 2, i / 25);
        const Vec3 jitter(std::sin(7 * i), std::sin(11 * i), 0);
        const Vec3 at =
            Vec3(0.15 * cell.x(), 0.15 * cell.y(), 0.2 + 0.21 * cell.z()) + 0.01 * jitter;
        add_ball(scene, at, Vec3::Zero(), kBall);
    }
    return scene;
}

double deepest(const Scene& scene, const Motion& motion, double t) {
    double depth = 0;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Vec3 x = motion.balls[i].at(t).position;
        depth = std::max({depth, kBall - x.z(), x.cwiseAbs().head<2>().maxCoeff() + kBall - 0.5});
        for (std::size_t j = 0; j < i; ++j)
            depth = std::max(depth, 2 * kBall - (x - motion.balls[j].at(t).position).norm());
    }
    return depth;
}

double energy(const Scene& scene, const Motion& motion, double t) {
    double sum = 0;
    for (const Trajectory& ball : motion.balls) {
        const BallState s = ball.at(t);
        sum += 0.5 * s.velocity.squaredNorm() + 0.2 * kBall * kBall * s.spin.squaredNorm() +
               kGravity * (s.position.z() - kBall);
    }
    return sum * scene.balls[0].mass;
}

TEST(Run, SameSceneTwiceIsTheSameMotion) {
    for (Solver solver : {Solver::kWorld, Solver::kQuick}) {
        Scene scene = pile(30, solver);
        const auto first = run(scene, 1);
        const auto second = run(scene, 1);
        EXPECT_GT(first.report.impacts, 50);
        EXPECT_EQ(first.report.impacts, second.report.impacts);
        EXPECT_EQ(first.motion.hash(), second.motion.hash());
        scene.balls[7].position.x() += 1e-12;
        EXPECT_NE(run(scene, 1).motion.hash(), first.motion.hash());
    }
}

TEST(Run, PileOf200StaysInItsBox) {
    Scene scene = pile(200, Solver::kQuick);
    const auto result = run(scene, 1.5);
    EXPECT_GT(result.report.impacts, 1000);
    const double start = energy(scene, result.motion, 0);
    double depth = 0, highest_energy = 0;
    for (double t = 0.05; t <= 1.5; t += 0.05) {
        depth = std::max(depth, deepest(scene, result.motion, t));
        highest_energy = std::max(highest_energy, energy(scene, result.motion, t));
    }
    const double end = energy(scene, result.motion, 1.5);
    fmt::print(
        "200 balls: {} impacts, deepest overlap {:.1f} % of a radius, energy {:.3f} of the "
        "start at most, {:.3f} at the end\n",
        result.report.impacts, 100 * depth / kBall, highest_energy / start, end / start);
    EXPECT_LT(depth / kBall, 0.12);  // the way of one step at 7 m/s
    EXPECT_LT(highest_energy, start * 1.001);
    EXPECT_LT(end, 0.5 * start);
    EXPECT_GT(end, 0.05 * start);
}

TEST(Run, SmallPileWithDWorldStepStaysInItsBox) {
    Scene scene = pile(50, Solver::kWorld);
    const auto result = run(scene, 1.2);
    double depth = 0;
    for (double t = 0.05; t <= 1.2; t += 0.05)
        depth = std::max(depth, deepest(scene, result.motion, t));
    const double end = energy(scene, result.motion, 1.2) / energy(scene, result.motion, 0);
    fmt::print(
        "50 balls: {} impacts, deepest overlap {:.1f} % of a radius, energy {:.3f} of the "
        "start at the end\n",
        result.report.impacts, 100 * depth / kBall, end);
    EXPECT_GT(result.report.impacts, 100);
    EXPECT_LT(depth / kBall, 0.12);
    EXPECT_LT(end, 0.5);
}

// Balls that lie against walls and each other: exact ties, on which dWorldStep would give up.
TEST(Run, RestingAgainstAWallIsNoTrouble) {
    Scene scene = scene_of(0.5, 0, kGravity, 1e-3);
    use_pair(scene, 0.5);
    add_plane(scene);
    for (double side : {-1.0, 1.0}) add_plane(scene, side * Vec3::UnitX(), -0.5);
    for (int i = 0; i < 5; ++i) add_ball(scene, {-0.4 + 0.2 * i, 0, 0.1});
    add_ball(scene, {-0.3, 0, 0.8});  // falls between the first two
    const auto result = run(scene, 2);
    EXPECT_GT(result.report.impacts, 2);
    for (const Trajectory& ball : result.motion.balls) {
        EXPECT_LT(std::abs(ball.at(2).position.x()), 0.4 + 1e-3);
        EXPECT_GT(ball.at(2).position.z(), 0.1 - 1e-3);
    }
}

TEST(Run, ARestOfAMinuteIsAHandfulOfPieces) {
    Scene scene = scene_of(0.7, 0.5, kGravity, 1e-3);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.6});
    const auto result = run(scene, 60);
    const auto& pieces = result.motion.balls[0].pieces();
    fmt::print("{} steps, {} impacts, {} pieces\n", result.report.steps, result.report.impacts,
               pieces.size());
    // Two per bounce, and the lift out of the last overlap.
    EXPECT_LT(pieces.size(), 2 * std::size_t(result.report.impacts) + 60);
    EXPECT_GT(60 - pieces.back().start, 50);
    EXPECT_LT(result.motion.balls[0].at(60).velocity.norm(), 1e-9);
}

// H17 and H18 with a fixed step: what stands on one vertical stays there, and nothing pops.
TEST(Run, StacksStand) {
    Scene stack = scene_of(0.5, 0.5, kGravity, 1e-3);
    use_pair(stack, 0.5, 0.5);
    add_plane(stack);
    for (int i = 0; i < 10; ++i) add_ball(stack, {0, 0, 0.1 + 0.2 * i});
    Scene heavy = stack;
    heavy.balls.resize(2);
    heavy.balls[1].mass = 1000;
    for (Scene* scene : {&stack, &heavy}) {
        const auto result = run(*scene, 5);
        double off = 0, speed = 0;
        for (std::size_t b = 0; b < scene->balls.size(); ++b) {
            for (double t = 0; t <= 5; t += 0.037) {
                const BallState s = result.motion.balls[b].at(t);
                off = std::max(off, (s.position - scene->balls[b].position).norm());
                speed = std::max(speed, s.velocity.norm());
            }
        }
        fmt::print("{} balls stand to {:.1e} m and {:.1e} m/s\n", scene->balls.size(), off, speed);
        EXPECT_LT(off, 5e-8);
        EXPECT_LT(speed, 1e-5);
        EXPECT_TRUE(result.motion.events.empty());
    }
}

// H7 at gap 0 is beyond a single solve (a cradle passes its impulse on; here four balls move off
// together), but momentum is exact, nothing is gained, and ODE does not complain.
TEST(Run, TouchingCradleKeepsItsMomentum) {
    Scene scene = scene_of(1, 0, 0, 1e-3);
    use_pair(scene, 1);
    add_ball(scene, {-1, 0, 0}, {1, 0, 0});
    for (int i = 0; i < 4; ++i) add_ball(scene, {0.2 * i, 0, 0});
    const auto result = run(scene, 2);
    double momentum = 0, squares = 0;
    for (const Trajectory& ball : result.motion.balls) {
        momentum += ball.at(2).velocity.x();
        squares += ball.at(2).velocity.squaredNorm();
    }
    EXPECT_NEAR(momentum, 1, 1e-12);
    EXPECT_NEAR(squares, 1, 1e-5);
    EXPECT_NEAR(result.motion.balls[0].at(2).velocity.x(), -0.6, 1e-5);
}

std::string failure_of(const Scene& scene, std::stop_token stop = {}) {
    try {
        simulate(scene, stop);
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.kind(), FailureKind::kRun);
        return failure.what();
    }
    return "did not fail";
}

TEST(RunFails, WhereAStateIsNotFinite) {
    Scene scene = scene_of(1, 0, kGravity, 1e-3);
    add_ball(scene, {0, 0, 0});
    add_ball(scene, {5, 0, 0}, {1e308, 0, 0}).name = "runaway";
    scene.balls[1].position.x() = 1.79e308;
    const std::string text = failure_of(scene);
    EXPECT_EQ(text.find("the state of ball 'runaway' is not finite after the step at t = "), 0u)
        << text;
}

// A ball of a microgram in a funnel of 20 planes: against 1 / mass the islands' CFM is lost in
// rounding, and the matrix of dWorldStep is singular. QuickStep's sweeps do not mind.
TEST(RunFails, WithOdesMessageAndTheTime) {
    Scene scene = scene_of(0.5, 0, kGravity, 1e-3);
    for (int i = 0; i < 20; ++i)
        add_plane(scene, Vec3(0.05 * std::cos(0.1 * M_PI * i), 0.05 * std::sin(0.1 * M_PI * i), 1));
    add_ball(scene, {0, 0, 0.4 + 0.1 * (std::sqrt(1.0025) - 1)}).mass = 1e-9;
    scene.simulation.duration = 1;
    const std::string text = failure_of(scene);
    fmt::print("{}\n", text);
    EXPECT_EQ(text.find("ODE failed at t = 0.247 s: LCP internal error"), 0u);
    EXPECT_NE(text.find("simulation.solver: quick"), std::string::npos);
    scene.simulation.solver = Solver::kQuick;
    EXPECT_EQ(failure_of(scene), "did not fail");
}

TEST(RunFails, WhenInterrupted) {
    Scene scene = scene_of(1, 0, kGravity, 1e-3);
    add_ball(scene, {0, 0, 1});
    std::stop_source source;
    double last = -1;
    scene.simulation.duration = 1e6;
    try {
        simulate(scene, source.get_token(), [&](double time) {
            EXPECT_GT(time, last);
            last = time;
            if (time > 3) source.request_stop();
        });
        FAIL() << "was not interrupted";
    } catch (const Failure& failure) {
        EXPECT_EQ(std::string(failure.what()).find("interrupted at t = "), 0u) << failure.what();
    }
    EXPECT_GT(last, 3);
    EXPECT_LT(last, 6);
}

TEST(RunFails, WhereStepsCannotBeCounted) {
    Scene scene = scene_of(1, 0, kGravity, 1e-300);
    add_ball(scene, {0, 0, 1});
    EXPECT_NE(failure_of(scene).find("raise simulation.step"), std::string::npos);
    scene.simulation.step = 1e-320;  // the count is infinite
    EXPECT_NE(failure_of(scene).find("raise simulation.step"), std::string::npos);
}

TEST(Run, AStepLongerThanTheDurationIsOneStep) {
    Scene scene = scene_of(1, 0, kGravity, 1.0);
    add_plane(scene);
    add_ball(scene, {0, 0, 1});
    const auto result = run(scene, 0.25);
    EXPECT_EQ(result.report.steps, 1);
    const double fall = 0.5 * kGravity * (0.25 * 0.25 + 0.25 * 1.0);
    EXPECT_NEAR(result.motion.balls[0].at(0.25).position.z(), 1 - fall, 1e-12);
}

TEST(Run, NoBallsIsAMotionOfNothing) {
    Scene scene = scene_of(1, 0, kGravity, 1e-3);
    add_plane(scene);
    const auto result = run(scene, 1);
    EXPECT_EQ(result.motion.duration, 1);
    EXPECT_TRUE(result.motion.balls.empty());
}

}  // namespace
}  // namespace carom
