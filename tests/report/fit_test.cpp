// From measurements to a coefficient: closed forms, uncertainties, and round trips through the
// simulation and through the scene reader.
#include "report/fit.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "complaint.h"
#include "core/failure.h"
#include "scene/reader.h"
#include "scene/virtual_body.h"
#include "sim/simulate.h"

namespace carom {
namespace {

constexpr double kFitGravity = 9.81;

Measurements drops_of(const std::vector<std::pair<double, double>>& heights) {
    Measurements measured;
    for (const auto& [drop, rebound] : heights) measured.drops.push_back({drop, rebound, "here"});
    return measured;
}

Measurements intervals_of(const std::vector<double>& times) { return {{}, times}; }

TEST(Fit, OneDropIsTheRootOfTheHeights) {
    const RestitutionFit fit = fit_restitution(drops_of({{1.8, 1.3}}), {});
    EXPECT_NEAR(0.849837, fit.restitution, 1e-6);
    EXPECT_FALSE(fit.uncertainty);
    EXPECT_FALSE(fit.low);
}

TEST(Fit, BottomToTopTakesTheDiameterOff) {
    FitOptions options;
    options.rebound_to = ReboundTo::kTop;
    options.diameter_m = 0.243;
    // Erratum 7: 1.20 to 1.40 m to the top is a coefficient of 0.73 to 0.80.
    EXPECT_NEAR(0.7292, fit_restitution(drops_of({{1.8, 1.2}}), options).restitution, 1e-4);
    EXPECT_NEAR(0.8017, fit_restitution(drops_of({{1.8, 1.4}}), options).restitution, 1e-4);
}

TEST(Fit, RepeatsGiveMeanAndScatter) {
    // ε = 0.8, 0.7, 0.9: mean 0.8, deviation 0.1, of the mean 0.1/√3; t of 2 degrees is 4.303.
    const RestitutionFit fit = fit_restitution(drops_of({{1, 0.64}, {1, 0.49}, {1, 0.81}}), {});
    EXPECT_NEAR(0.8, fit.restitution, 1e-15);
    EXPECT_NEAR(0.1 / std::sqrt(3), *fit.uncertainty, 1e-15);
    EXPECT_NEAR(0.8 - 4.302653 * 0.1 / std::sqrt(3), *fit.low, 1e-6);
    EXPECT_EQ(1, *fit.high);
}

TEST(Fit, ReadingErrorPropagates) {
    FitOptions options;
    options.reading_error = 0.002;
    const RestitutionFit fit = fit_restitution(drops_of({{1.8, 1.3}}), options);
    const double expected = 0.5 * fit.restitution * std::hypot(0.002 / 1.3, 0.002 / 1.8);
    EXPECT_NEAR(expected, *fit.uncertainty, 1e-15);
    EXPECT_NEAR(fit.restitution + 1.959964 * expected, *fit.high, 1e-8);
}

// Against the spread of many measurements with errors of that size.
TEST(Fit, UncertaintiesAreThoseOfSimulatedReadings) {
    std::mt19937 random(1);
    std::normal_distribution<double> error(0, 0.004);
    constexpr int kRuns = 4000, kDrops = 4;
    double sum = 0, squares = 0, claimed = 0;
    int inside = 0;
    for (int run = 0; run < kRuns; ++run) {
        Measurements measured;
        for (int i = 0; i < kDrops; ++i)
            measured.drops.push_back({1.8 + error(random), 1.3 + error(random), ""});
        const RestitutionFit fit = fit_restitution(measured, {});
        sum += fit.restitution;
        squares += fit.restitution * fit.restitution;
        claimed += *fit.uncertainty * *fit.uncertainty;
        const double truth = std::sqrt(1.3 / 1.8);
        inside += *fit.low < truth && truth < *fit.high ? 1 : 0;
    }
    const double spread = std::sqrt(squares / kRuns - std::pow(sum / kRuns, 2));
    const double mean_claim = std::sqrt(claimed / kRuns);
    const double share = static_cast<double>(inside) / kRuns;
    fmt::print("spread {:.6f}, claimed {:.6f}; the truth lies inside {:.1f} % of 95 %\n", spread,
               mean_claim, 100 * share);
    EXPECT_NEAR(1, mean_claim / spread, 0.05);
    EXPECT_NEAR(0.95, share, 0.012);
}

TEST(Fit, IntervalsGiveTheSlopeOfTheirLogarithms) {
    EXPECT_EQ(0.75, fit_restitution(intervals_of({1, 0.75}), {}).restitution);
    const RestitutionFit exact = fit_restitution(intervals_of({1, 0.8, 0.64, 0.512}), {});
    EXPECT_NEAR(0.8, exact.restitution, 1e-15);
    EXPECT_NEAR(0, *exact.uncertainty, 1e-15);
    // ln t = 0, a, 2 a + d: slope a + d/2, residuals d/6 (1, -2, 1).
    const double a = std::log(0.8), d = 0.03;
    const RestitutionFit three =
        fit_restitution(intervals_of({1, std::exp(a), std::exp(2 * a + d)}), {});
    EXPECT_NEAR(std::exp(a + d / 2), three.restitution, 1e-15);
    EXPECT_NEAR(three.restitution * std::sqrt(d * d / 6 / 2), *three.from_repeats, 1e-15);
}

TEST(Fit, ReadingErrorOfTwoIntervals) {
    FitOptions options;
    options.reading_error = 0.001;
    const RestitutionFit fit = fit_restitution(intervals_of({1, 0.8}), options);
    EXPECT_NEAR(0.8 * std::hypot(0.001, 0.001 / 0.8), *fit.uncertainty, 1e-15);
}

TEST(Fit, StudentIsThatOfTheTables) {
    // Quantiles 0.975, as in any statistics table.
    const std::pair<int, double> kTable[] = {{1, 12.7062},  {2, 4.30265},   {3, 3.18245},
                                             {4, 2.77645},  {9, 2.26216},   {10, 2.22814},
                                             {30, 2.04227}, {1000, 1.96234}};
    for (const auto& [degrees, t] : kTable) EXPECT_NEAR(t, student_t95(degrees), 1e-4) << degrees;
}

TEST(Fit, ImpossibleMeasurementsAreRefused) {
    const auto drop = [](double height, double rebound) {
        return complaint([&] { fit_restitution(drops_of({{height, rebound}}), {}); });
    };
    EXPECT_TRUE(holds(drop(1, 1.2), "higher than the drop"));
    EXPECT_TRUE(holds(drop(0, 1), "must be above 0"));
    EXPECT_TRUE(holds(drop(-1, 1), "must be above 0"));
    EXPECT_TRUE(holds(drop(1, 0), "restitution: 0"));
    EXPECT_TRUE(holds(drop(1, -0.5), "must be above 0"));
    EXPECT_EQ("", drop(1, 1));
    EXPECT_TRUE(holds(complaint([] { fit_restitution(intervals_of({1}), {}); }), "not enough"));
    EXPECT_TRUE(holds(complaint([] { fit_restitution(intervals_of({1, 0}), {}); }), "interval 2"));
    EXPECT_TRUE(holds(complaint([] { fit_restitution(intervals_of({1, 1.1}), {}); }), "grow"));
    FitOptions top;
    top.rebound_to = ReboundTo::kTop;
    top.diameter_m = 0.3;
    EXPECT_TRUE(holds(complaint([&] {
                          fit_restitution(drops_of({{1, 0.2}}), top);
                      }),
                      "has not left the floor"));
}

// Simulate a drop, measure it as one would, fit it, get the coefficient back.
TEST(FitRoundTrip, SimulatedDropsGiveTheirCoefficientBack) {
    double worst = 0;
    for (const double restitution : {0.05, 0.3, 0.7, 0.845354, 0.95, 0.999}) {
        Scene scene;
        scene.simulation.method = Method::kExact;
        scene.materials.resize(2);
        scene.materials[1].virtual_body = virtual_body_for(restitution, 4);
        Surface floor;
        floor.shape = PlaneShape{};
        scene.surfaces.push_back(floor);
        Ball ball;
        ball.radius = 0.121;
        ball.material = 1;
        ball.position = Vec3(0, 0, 1.8 + ball.radius);
        scene.balls.push_back(ball);
        const double fall = std::sqrt(2 * 1.8 / kFitGravity);
        scene.simulation.duration = fall * (1 + 4 * restitution);  // a bit beyond three impacts
        const Motion motion = simulate(scene).motion;
        ASSERT_FALSE(motion.peaks.front().empty());
        const double rebound = motion.peaks.front().front().height;

        const double bottom = fit_restitution(drops_of({{1.8, rebound}}), {}).restitution;
        FitOptions to_top;
        to_top.rebound_to = ReboundTo::kTop;
        to_top.diameter_m = 2 * ball.radius;
        const double top =
            fit_restitution(drops_of({{1.8, rebound + 2 * ball.radius}}), to_top).restitution;

        std::vector<double> impacts;
        for (const Event& event : motion.events)
            if (event.kind == EventKind::kImpact) impacts.push_back(event.time);
        ASSERT_GE(impacts.size(), 3U) << restitution;
        const double sound =
            fit_restitution(intervals_of({impacts[1] - impacts[0], impacts[2] - impacts[1]}), {})
                .restitution;
        for (const double fitted : {bottom, top, sound})
            worst = std::max(worst, std::abs(fitted - restitution));
    }
    fmt::print("round trip: off by {:.1e} at most (bound 1e-9)\n", worst);
    EXPECT_LT(worst, 1e-9);
}

// The snippet, pasted into a scene, is a material of the same coefficient.
TEST(FitRoundTrip, SnippetReadsBackAsTheSameCoefficient) {
    double worst = 0;
    for (const double constant : {4.0, 1.7}) {
        for (const double restitution : {1e-6, 0.3, 0.849836585598797, 0.999999, 1.0}) {
            for (const double velocity : {5.0, 0.1}) {
                const VirtualBodyLine line = virtual_body_line(restitution, constant, velocity);
                RestitutionFit fit;
                fit.restitution = restitution;
                // The whole text is YAML: what is not the snippet is comment.
                const std::string text = "carom: 1\n" + fit_text(fit, line, "my_ball") +
                                         "balls: [{name: a, radius: 0.1, position: [0, 0, 1], "
                                         "material: my_ball}]\n";
                const SceneResult read = read_scene(text, "pasted.yaml");
                ASSERT_TRUE(read.scene) << text;
                const Scene& scene = *read.scene;
                const auto material = static_cast<std::size_t>(scene.balls.front().material);
                const double back = rigid_restitution(scene.materials[material].virtual_body,
                                                      scene.simulation.restitution_constant);
                worst = std::max(worst, std::abs(back / restitution - 1));
            }
        }
    }
    fmt::print("snippet: off by {:.1e} at most\n", worst);
    EXPECT_LT(worst, 1e-14);
}

TEST(FitReport, JsonHasEveryNumber) {
    FitOptions options;
    options.reading_error = 0.001;
    const RestitutionFit fit = fit_restitution(drops_of({{1.8, 1.3}, {1.8, 1.31}}), options);
    const auto json =
        nlohmann::json::parse(fit_json(fit, virtual_body_line(fit.restitution, 4, 5), "m"));
    EXPECT_EQ(fit.restitution, json.at("restitution"));
    EXPECT_EQ(2U, json.at("single").size());
    EXPECT_EQ(*fit.low, json.at("interval_95").at(0));
    EXPECT_EQ(5, json.at("point").at("velocity_m_s"));
    const double ratio = json.at("distance_per_velocity_s");
    EXPECT_NEAR(fit.restitution, std::exp(-4 * ratio / 2), 1e-15);
    EXPECT_TRUE(holds(json.at("snippet"), "virtual_body"));
}

TEST(FitReport, PlotHasLineBandAndPoint) {
    FitOptions options;
    options.reading_error = 0.01;
    const RestitutionFit fit = fit_restitution(drops_of({{1.8, 1.3}}), options);
    const Plot plot = fit_plot(fit, virtual_body_line(fit.restitution, 4, 5));
    ASSERT_EQ(3U, plot.series.size());
    const Series& band = plot.series[0];
    ASSERT_EQ(SeriesStyle::kBand, band.style);
    for (std::size_t i = 1; i < 100; ++i) {
        EXPECT_LT(band.y[i], band.upper[i]);
        EXPECT_NEAR(*fit.low, std::exp(-4 * band.x[i] / (2 * band.y[i])), 1e-12);
    }
    // A ball that loses nothing has no slope: its line stands upright.
    const RestitutionFit lossless = fit_restitution(drops_of({{1, 1}}), {});
    const Plot upright = fit_plot(lossless, virtual_body_line(1, 4, 5));
    EXPECT_EQ(0, upright.series[0].x.back());
    EXPECT_GT(upright.series[0].y.back(), 5);
}

class MeasurementFile : public ::testing::Test {
  protected:
    ~MeasurementFile() override { std::filesystem::remove(path_); }
    Measurements read(const std::string& text) {
        std::ofstream(path_) << text;
        return read_measurements(path_);
    }
    std::string mistake(const std::string& text) {
        return complaint([&] { read(text); });
    }
    const std::string path_ = (std::filesystem::temp_directory_path() /
                               ("carom-measured-" + std::to_string(::getpid()) + ".csv"))
                                  .string();
};

TEST_F(MeasurementFile, HeadersNameUnits) {
    for (const char* text :
         {"drop [cm],rebound [cm]\n180,130\n", "rebound_m, drop_m\n1.3, 1.8\n",
          "\xEF\xBB\xBF# basketball\r\nDrop (mm);Rebound (cm)\r\n1800;130\r\n\r\n",
          "drop [cm]\trebound [mm]\n180\t1300\n"}) {
        const Measurements measured = read(text);
        ASSERT_EQ(1U, measured.drops.size()) << text;
        EXPECT_EQ(1.8, measured.drops[0].drop_m) << text;
        EXPECT_EQ(1.3, measured.drops[0].rebound_m) << text;
    }
    EXPECT_EQ(2.54, read("drop_in,rebound_in\n100,58\n").drops[0].drop_m);
    const Measurements times = read("interval [ms]\n860\n731\n");
    EXPECT_EQ((std::vector<double>{0.86, 0.731}), times.intervals_s);
}

TEST_F(MeasurementFile, MistakesAreNamedWithTheirLine) {
    EXPECT_TRUE(holds(mistake("drop,rebound_m\n1,1\n"), ":1: the column 'drop' has no unit"));
    EXPECT_TRUE(holds(mistake("drop_kg,rebound_m\n1,1\n"), ":1: 'kg' is no unit of a length"));
    EXPECT_TRUE(holds(mistake("interval_m\n1\n"), "'m' is no unit of a time"));
    EXPECT_TRUE(holds(mistake("fall_m,rebound_m\n1,1\n"), ":1: unknown column 'fall_m'"));
    EXPECT_TRUE(holds(mistake("drop_m\n1\n"), ":1: there must be the columns"));
    EXPECT_TRUE(holds(mistake("drop_m,drop_cm\n1,1\n"), "stands twice"));
    EXPECT_TRUE(holds(mistake("drop_m,rebound_m\n1,0.5\n1\n"), ":3: 1 values under 2 columns"));
    EXPECT_TRUE(holds(mistake("drop_m,rebound_m\n1,high\n"), ":2: 'high' is no number"));
    EXPECT_TRUE(holds(mistake("drop_m,rebound_m\n1,0.5m\n"), ":2: '0.5m' is no number"));
    EXPECT_TRUE(holds(mistake("drop_m,rebound_m\n"), "no measurement"));
    EXPECT_TRUE(holds(mistake(""), "empty"));
    EXPECT_TRUE(holds(complaint([] { read_measurements("/nowhere.csv"); }), "no such file"));
}

TEST(Quantities, UnitsAreConverted) {
    EXPECT_EQ(1.8, parse_quantity("1.8", Quantity::kLength, ""));
    EXPECT_EQ(1.8, parse_quantity("180cm", Quantity::kLength, ""));
    EXPECT_EQ(1.8, parse_quantity(" 1800 mm ", Quantity::kLength, ""));
    EXPECT_EQ(0.512, parse_quantity("512 ms", Quantity::kTime, ""));
    EXPECT_TRUE(holds(complaint([] { parse_quantity("3 kg", Quantity::kLength, "--drop"); }),
                      "--drop: 'kg' is no unit of a length"));
    EXPECT_TRUE(holds(complaint([] { parse_quantity("", Quantity::kLength, "--drop"); }),
                      "--drop: '' is no number"));
    EXPECT_TRUE(
        holds(complaint([] { parse_quantity("inf", Quantity::kLength, "--drop"); }), "no number"));
}

// ---- In air
// ------------------------------------------------------------------------------------

/// A preset's numbers, in air of 1.225 kg/m^3 without buoyancy.
FallInAir air_of(double radius, double mass, double drag) {
    Air air;
    air.buoyancy = false;
    return {air, radius, mass, drag, kFitGravity};
}

/// The coefficients that give the presets' own first rebounds in air, six digits of an independent
/// calculation.
TEST(FitInAir, SameRebound) {
    struct Row {
        double radius, mass, drag, drop, vacuum, air;
    };
    constexpr double kTurn = 6.283185307179586;
    for (const Row& row : {Row{0.7645 / kTurn, 0.6085, 0.50, 1.8, 0.845354, 0.876385},
                           Row{0.66 / kTurn, 0.27, 0.47, 1.0, 0.786628, 0.810458},
                           Row{0.69 / kTurn, 0.4325, 0.50, 2.0, 0.818731, 0.856140},
                           Row{0.066995 / 2, 0.0577, 0.507, 2.54, 0.744978, 0.773315},
                           Row{0.02, 0.0027, 0.45, 0.305, 0.904837, 0.937571}}) {
        FitOptions options;
        options.air = air_of(row.radius, row.mass, row.drag);
        const double rebound = row.vacuum * row.vacuum * row.drop;
        const double e = fit_restitution(drops_of({{row.drop, rebound}}), options).restitution;
        EXPECT_NEAR(row.air, e, 1e-6);
    }
}

/// A table tennis ball of e = 0.9 in air with buoyancy: its simulated heights and intervals give
/// 0.9 again, and something else without air.
TEST(FitInAir, RoundTrip) {
    const SceneResult read = read_scene(
        "carom: 1\n"
        "simulation: {duration: 4}\n"
        "air: {density: 1.2}\n"
        "surfaces: [{name: floor, plane: {}}]\n"
        "materials: {it: {restitution: 0.9}}\n"
        "balls: [{name: a, preset: table_tennis, material: it, drop_height: 0.305}]\n",
        "scene.yaml");
    ASSERT_TRUE(read.scene);
    const Motion motion = simulate(*read.scene).motion;
    std::vector<double> intervals;
    for (std::size_t i = 1; i <= 10; ++i)
        intervals.push_back(motion.events[i].time - motion.events[i - 1].time);
    const Ball& ball = read.scene->balls[0];
    FitOptions options;
    options.air = FallInAir(*read.scene->air, ball.radius, ball.mass, 0.45, kFitGravity);
    const Measurements times = intervals_of(intervals);
    const Measurements heights = drops_of({{0.305, motion.peaks[0][0].height},
                                           {motion.peaks[0][0].height, motion.peaks[0][1].height}});
    EXPECT_NEAR(0.9, fit_restitution(times, options).restitution, 1e-10);
    EXPECT_NEAR(0.9, fit_restitution(heights, options).restitution, 1e-10);
    EXPECT_NEAR(0.890, fit_restitution(times, {}).restitution, 1e-3);
}

/// Readings of intervals that scatter by 1 ms: the interval of 95 % holds the truth as often.
TEST(FitInAir, ConfidenceIsWhatItSays) {
    FitOptions options;
    options.air = air_of(0.02, 0.0027, 0.45);
    options.reading_error = 1e-3;
    std::vector<double> exact;
    for (double speed = 2.1; exact.size() < 6; speed *= 0.9 * options.air->kept_part(speed))
        exact.push_back(options.air->interval(speed));
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 1e-3);
    int inside = 0;
    constexpr int kTrials = 10'000;
    for (int i = 0; i < kTrials; ++i) {
        std::vector<double> read = exact;
        for (double& time : read) time += noise(random);
        const RestitutionFit fit = fit_restitution(intervals_of(read), options);
        inside += *fit.low <= 0.9 && 0.9 <= *fit.high ? 1 : 0;
    }
    std::printf("in air %.4f of %d intervals of 95 %% hold the truth\n",
                static_cast<double>(inside) / kTrials, kTrials);
    EXPECT_GT(inside, 0.945 * kTrials);
}

TEST(FitInAir, MistakesAreNamed) {
    Air thick;
    thick.density = 2000;
    EXPECT_TRUE(holds(complaint([&] { FallInAir(thick, 0.1, 1, 0.5, kFitGravity); }),
                      "lighter than the air"));
    FitOptions options;
    options.air = air_of(0.1, 0.1, 0.5);
    EXPECT_TRUE(holds(complaint([&] {
                          fit_restitution(drops_of({{1, 0.99}}), options);
                      }),
                      "would have to gain energy"));
}

}  // namespace
}  // namespace carom
