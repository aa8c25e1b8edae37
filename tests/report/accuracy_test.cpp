// Speed against error: the references, the measures, and what the table says of known scenes.
#include "report/accuracy.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/accuracy_files.h"
#include "report/closed_form.h"
#include "sim/simulate.h"

namespace carom {
namespace {

constexpr double kG = 9.81;

Scene drop(double height, double restitution, double duration) {
    Scene scene;
    scene.file = "drop.yaml";
    scene.simulation.duration = duration;
    scene.materials = {Material{}, Material{}};
    scene.materials[1].name = "rubber";
    scene.materials[1].virtual_body = {-std::log(restitution) * 2 / 4, 1};
    scene.surfaces.push_back({"floor", PlaneShape{}, 0, 0, {}});
    Ball ball;
    ball.name = "a";
    ball.material = 1;
    ball.position = {0, 0, height + ball.radius};
    scene.balls.push_back(ball);
    return scene;
}

AccuracyReport measured(const Scene& scene, std::vector<double> steps, double budget_s = 20) {
    AccuracyOptions options;
    options.steps = std::move(steps);
    options.repeats = 1;
    options.budget_s = budget_s;
    return measure_accuracy(scene, options, {}, [](const std::string&) {});
}

const AccuracyRun& row(const AccuracyReport& report, Method method, double step = 0,
                       Solver solver = Solver::kWorld) {
    for (const AccuracyRun& run : report.runs)
        if (run.method == method && run.step == step && run.solver == solver) return run;
    throw std::logic_error("no such row");
}

// H1 and H2 of the hard cases: impact times, peaks, and the end of the series.
TEST(ClosedForm, IsTheBouncingSeries) {
    const Scene scene = drop(2, 0.8, 7);
    const auto motion = closed_form_motion(scene, simulate(scene).motion);
    ASSERT_TRUE(motion);
    const double times[] = {0.638550857, 1.660232228, 2.477577324, 3.131453402, 3.654554264};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(times[i], motion->events.at(i).time, 5e-10);
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(2 * std::pow(0.64, double(i + 1)), motion->peaks[0].at(i).height, 1e-15);
    const double end = motion->balls[0].pieces().back().start;
    EXPECT_NEAR(5.746957711, end, 1e-6);  // the hop that ends it leaves that much out at most
    EXPECT_EQ(0, motion->balls[0].at(6.9).velocity.norm());
}

TEST(ClosedForm, HoldsOnASlopeAndWithASpeedAlongIt) {
    Scene scene = drop(1, 0.8, 3);
    scene.surfaces[0].shape = PlaneShape{Vec3(std::sin(0.5), 0, std::cos(0.5)), 0};
    scene.balls[0].position = Vec3(0.3, 0, 1.2);
    scene.balls[0].velocity = Vec3(0.1, 0.7, 0.2);
    const Motion exact = simulate(scene).motion;
    const auto closed = closed_form_motion(scene, exact);
    ASSERT_TRUE(closed);
    const std::vector<double> apart = distances(*closed, exact, 3, 500);
    const double worst = *std::max_element(apart.begin(), apart.end());
    fmt::print("slope: {} impacts, exact is off by {:.1e} m (bound 1e-12)\n", exact.events.size(),
               worst);
    EXPECT_GE(exact.events.size(), 5u);
    EXPECT_LE(worst, 1e-12);
}

TEST(ClosedForm, ThereIsNoneWhereMoreIsMet) {
    Scene friction = drop(1, 0.8, 2);
    friction.materials[0].friction = friction.materials[1].friction = 0.5;
    EXPECT_FALSE(closed_form_motion(friction, simulate(friction).motion));

    Scene two = drop(1, 0.8, 2);
    two.balls.push_back(two.balls[0]);
    two.balls[1].name = "b";
    two.balls[1].position.z() += 0.5;
    EXPECT_FALSE(closed_form_motion(two, simulate(two).motion));

    Scene resting = drop(1, 0.8, 2);
    resting.balls[0].position.z() = resting.balls[0].radius;
    EXPECT_FALSE(closed_form_motion(resting, simulate(resting).motion));

    Scene free = drop(1, 0.8, 2);
    free.surfaces.clear();
    const auto flight = closed_form_motion(free, simulate(free).motion);
    ASSERT_TRUE(flight);
    EXPECT_NEAR(1.1 - kG / 2 * 4, flight->balls[0].at(2).position.z(), 1e-14);
}

TEST(MotionError, IsZeroForEqualMotionsAndTheShiftForShiftedOnes) {
    const Scene scene = drop(1, 0.8, 2);
    const Motion motion = simulate(scene).motion;
    ErrorOptions options;
    options.until = 2;
    const MotionError none = motion_error(scene, motion, motion, options);
    EXPECT_EQ(0, none.position_m);
    EXPECT_EQ(0, none.peak_relative);
    EXPECT_EQ(0, none.impact_time_s);
    EXPECT_EQ(0, none.energy_relative);
    EXPECT_GE(none.peaks, 2);
    EXPECT_GE(none.impacts, 3);

    Motion moved = motion;
    moved.balls[0] = {};
    for (Piece piece : motion.balls[0].pieces()) {
        piece.position.z() -= 0.01;
        moved.balls[0].append(piece);
    }
    for (Peak& peak : moved.peaks[0]) peak.height *= 1.02;
    moved.events.pop_back();
    const MotionError shifted = motion_error(scene, motion, moved, options);
    EXPECT_NEAR(0.01, shifted.position_m, 1e-15);
    EXPECT_NEAR(0.01, shifted.position_rms_m, 1e-15);
    EXPECT_NEAR(0.02, shifted.peak_relative, 1e-12);
    EXPECT_EQ(1, shifted.impacts_missed);
    // m g 0.01 over the energy with which it meets the floor first, m g 1; the instant looked at is
    // a little before that.
    EXPECT_NEAR(0.01, shifted.energy_relative, 2e-4);
    EXPECT_NEAR(0.1, shifted.penetration_relative, 1e-12);
}

// "How plain ODE does": drop 1.8 m, e = 0.85, worst of six peaks 3.9e-2 at 1e-2, 2.8e-3 at 1e-3.
TEST(Accuracy, FixedHasTheErrorsOfPlainOdeAndExactHasNone) {
    Scene scene = drop(1.8, 0.85, 5);
    const AccuracyReport report = measured(scene, {1e-2, 1e-3});
    ASSERT_EQ(5u, report.runs.size());
    EXPECT_TRUE(report.closed_form);
    EXPECT_FALSE(report.sensitivity.chaotic);
    EXPECT_EQ(5, report.sensitivity.trusted_until_s);
    const AccuracyRun& exact = row(report, Method::kExact);
    const AccuracyRun& coarse = row(report, Method::kFixed, 1e-2);
    const AccuracyRun& fine = row(report, Method::kFixed, 1e-3);
    fmt::print("peaks: exact {:.1e}, fixed {:.2e} at 1e-2 and {:.2e} at 1e-3\n",
               exact.error->peak_relative, coarse.error->peak_relative, fine.error->peak_relative);
    EXPECT_LE(exact.error->peak_relative, 1e-12);
    EXPECT_LE(exact.error->position_m, 1e-12);
    EXPECT_EQ(6, exact.error->peaks);
    EXPECT_NEAR(3.9e-2, coarse.error->peak_relative, 0.1e-2);
    EXPECT_NEAR(2.8e-3, fine.error->peak_relative, 0.1e-3);
    EXPECT_GT(coarse.error->penetration_relative, 0.1);  // up to a step of 6 m/s is 0.06 m
    EXPECT_EQ(0, exact.error->penetration_relative);
    for (const AccuracyRun& run : report.runs) EXPECT_GT(run.cpu_s_per_s, 0);
    EXPECT_EQ(&exact, report.cheapest(1e-6));
    EXPECT_EQ(nullptr, report.cheapest(1e-6, Method::kFixed));

    const std::string text = accuracy_summary(report);
    EXPECT_NE(std::string::npos, text.find("for 1 %, 0.1 % and 1e-6 exact")) << text;
    EXPECT_NE(std::string::npos, text.find("1e-6 with no step")) << text;
    EXPECT_EQ(std::string::npos, text.find("chaotic")) << text;
}

// Sinai's billiard: every reflection at the round body widens a beam.
TEST(Accuracy, ChaosIsNamedWithTheTimeUpToWhichItCanBeTrusted) {
    Scene scene = drop(1, 1, 60);
    scene.simulation.gravity.setZero();
    scene.surfaces.clear();
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
        scene.surfaces.push_back({"wall", PlaneShape{normal, -1}, 0, 0, {}});
    scene.surfaces.push_back({"round", SphereShape{Vec3(0, 0, 0), 0.5}, 0, 0, {}});
    scene.balls[0].position = {0.75, 0.1, 0};
    scene.balls[0].velocity = {1, 1.7, 0};
    const AccuracyReport report = measured(scene, {1e-3});
    EXPECT_FALSE(report.closed_form);
    EXPECT_TRUE(report.sensitivity.chaotic);
    EXPECT_GT(report.sensitivity.trusted_until_s, 1);
    EXPECT_LT(report.sensitivity.trusted_until_s, 60);
    ASSERT_TRUE(report.sensitivity.lyapunov_time_s);
    // From rounding to 1 % of a radius are some 28 factors of e.
    const double expected = report.sensitivity.trusted_until_s / 28;
    fmt::print("trusted up to {:.2f} s, Lyapunov time {:.3f} s\n",
               report.sensitivity.trusted_until_s, *report.sensitivity.lyapunov_time_s);
    EXPECT_NEAR(expected, *report.sensitivity.lyapunov_time_s, 0.5 * expected);
    EXPECT_NE(std::string::npos, accuracy_summary(report).find("chaotic"));
    EXPECT_LE(row(report, Method::kExact).error->position_m, 0.01 * 0.1);
}

// Four balls in a stack are more than exact integrates: its row is no error bound, and says so.
TEST(Accuracy, SteppedContactsAreNamed) {
    Scene scene = drop(0, 0.5, 1);
    const Ball first = scene.balls[0];
    for (int i = 1; i < 4; ++i) {
        Ball above = first;
        above.name = std::string(1, static_cast<char>('a' + i));
        above.position.z() += 2 * i * first.radius;
        scene.balls.push_back(above);
    }
    const std::string text = accuracy_summary(measured(scene, {1e-3}));
    EXPECT_NE(std::string::npos, text.find("are stepped by exact too")) << text;
    EXPECT_EQ(std::string::npos,
              accuracy_summary(measured(drop(1, 0.8, 2), {1e-3})).find("stepped"));
}

TEST(Accuracy, WhatTakesTooLongIsLeftOutAndSaysSo) {
    const AccuracyReport report = measured(drop(1, 0.8, 2), {1e-3, 1e-9}, 0.5);
    const AccuracyRun& left_out = row(report, Method::kFixed, 1e-9);
    EXPECT_FALSE(left_out.error);
    EXPECT_EQ(0u, left_out.missing.find("left out: it would take about ")) << left_out.missing;
    const TextTable table = accuracy_table(report);
    for (const auto& cells : table.rows) EXPECT_EQ(table.columns.size(), cells.size());
    const auto json = nlohmann::json::parse(accuracy_json(report));
    EXPECT_EQ(5u, json["runs"].size());
    EXPECT_EQ("closed form", json["reference"]);
    EXPECT_EQ(left_out.missing, json["runs"][2]["missing"]);
}

TEST(Accuracy, APlotHasOneLinePerMethodAndNoPeaksWhereThereAreNone) {
    Scene scene = drop(1, 0.8, 0.3);  // it does not reach the floor
    const AccuracyReport report = measured(scene, {1e-2, 1e-3});
    const auto position = work_precision_plot(
        report, "position", [](const MotionError& e) { return e.position_relative; });
    ASSERT_TRUE(position);
    ASSERT_EQ(3u, position->series.size());
    EXPECT_EQ(1u, position->series[0].x.size());
    EXPECT_EQ(2u, position->series[1].x.size());
    EXPECT_FALSE(
        work_precision_plot(report, "peaks", [](const MotionError& e) { return e.peak_relative; }));
}

}  // namespace
}  // namespace carom
