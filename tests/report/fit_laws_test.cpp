// Coefficients over the speed and drag, from measurements: round trips through closed forms and
// through the simulation, how often the truth lies within the stated interval, and refusals.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "complaint.h"
#include "core/failure.h"
#include "report/fit_drag.h"
#include "report/fit_over_speed.h"
#include "scene/catalogue.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {
namespace {

constexpr double kGravity = 9.81;

/// Heights of a ball with e = value v^(-exponent) (v in m/s), in a vacuum.
std::vector<MeasuredDrop> power_drops(double value, double exponent,
                                      const std::vector<double>& heights) {
    std::vector<MeasuredDrop> drops;
    for (const double height : heights) {
        const double v = std::sqrt(2 * kGravity * height);
        drops.push_back({height, height * std::pow(value * std::pow(v, -exponent), 2), "here"});
    }
    return drops;
}

const std::vector<double> kHeights = {0.2, 0.4, 0.8, 1.2, 1.8, 2.5, 3.5};

/// 95 % of the trials, with 4 standard deviations of 10,000; where a known reading error is the
/// larger of two uncertainties, somewhat more.
void expect_95_percent(int held, int trials, bool known) {
    EXPECT_GT(held, 0.941 * trials);
    EXPECT_LT(held, (known ? 0.985 : 0.959) * trials);
}

TEST(FitOverSpeed, FindsThePowerLawOfItsHeights) {
    const SpeedFit fit = fit_over_speed(power_drops(0.9, 0.12, kHeights), {});
    EXPECT_NEAR(0.12, fit.exponent.value, 1e-12);
    EXPECT_NEAR(0.9 * std::pow(fit.at_speed, -0.12), fit.value.value, 1e-12);
    EXPECT_NEAR(0.9 * std::pow(4.0, -0.12), fit.law(4.0), 1e-12);
    EXPECT_LT(fit.exponent.uncertainty, 1e-12);
}

TEST(FitOverSpeed, FindsInAirWhatTheSimulationWasGiven) {
    FitOptions options;
    const Preset& ball = *find_preset("table_tennis");
    options.air.emplace(Air{}, ball.radius, ball.mass, ball.drag, kGravity);
    std::vector<MeasuredDrop> drops;
    for (const double height : kHeights) {
        const std::string text = fmt::format(
            "carom: 1\nsimulation: {{duration: 4}}\nair: {{}}\nmaterials: {{m: {{restitution: "
            "{{power: {{value: 0.92, at_speed: 2, exponent: 0.1}}}}}}}}\nsurfaces: [{{name: f, "
            "plane: {{}}}}]\nballs: [{{name: a, preset: table_tennis, material: m, drop_height: "
            "{}}}]\n",
            height);
        const SceneResult loaded = read_scene(text, "air.yaml");
        ASSERT_TRUE(loaded.scene);
        const Motion motion = simulate(*loaded.scene).motion;
        ASSERT_FALSE(motion.peaks.front().empty());
        drops.push_back({height, motion.peaks.front().front().height, "here"});
    }
    const SpeedFit fit = fit_over_speed(drops, options);
    EXPECT_NEAR(0.1, fit.exponent.value, 1e-6);
    EXPECT_NEAR(0.92, fit.law(2.0), 1e-6);
    // What the fit writes is a scene's material.
    EXPECT_TRUE(holds(speed_fit_text(fit, "m"), "restitution: {power: {value: "));
}

TEST(FitOverSpeed, TheTruthIsWithinItsInterval) {
    constexpr int kTrials = 10'000;
    const std::vector<MeasuredDrop> exact = power_drops(0.85, 0.15, kHeights);
    for (const bool known : {false, true}) {
        std::mt19937_64 random(5);
        // Without a known error the scatter of ln e is alike at all heights, as the fit takes it.
        std::normal_distribution<double> normal;
        int value = 0, exponent = 0;
        for (int trial = 0; trial < kTrials; ++trial) {
            std::vector<MeasuredDrop> drops = exact;
            for (MeasuredDrop& drop : drops) {
                if (known) {
                    drop.drop_m += 0.002 * normal(random);
                    drop.rebound_m += 0.002 * normal(random);
                } else {
                    drop.rebound_m *= std::exp(2 * 0.005 * normal(random));
                }
            }
            FitOptions options;
            if (known) options.reading_error = 0.002;
            const SpeedFit fit = fit_over_speed(drops, options);
            const double truth = 0.85 * std::pow(fit.at_speed, -0.15);
            value += fit.value.low <= truth && truth <= fit.value.high;
            exponent += fit.exponent.low <= 0.15 && 0.15 <= fit.exponent.high;
        }
        fmt::print("{}: value {:.2f} %, exponent {:.2f} %\n", known ? "reading error" : "scatter",
                   100.0 * value / kTrials, 100.0 * exponent / kTrials);
        expect_95_percent(value, kTrials, known);
        expect_95_percent(exponent, kTrials, known);
    }
}

TEST(FitOverSpeed, RefusesWhatTellsNoLaw) {
    EXPECT_TRUE(holds(complaint([] {
                          fit_over_speed(power_drops(0.9, 0.1, {1, 1, 1}), {});
                      }),
                      "drop from heights that differ"));
    EXPECT_TRUE(holds(complaint([] {
                          fit_over_speed(power_drops(0.9, 0.1, {1, 2}), {});
                      }),
                      "give a third"));
    EXPECT_TRUE(holds(complaint([] {
                          fit_over_speed(power_drops(0.9, 1.2, {1, 2, 3}), {});
                      }),
                      "rebound more slowly"));
}

DragBall table_tennis() {
    const Preset& ball = *find_preset("table_tennis");
    return {Air{}, ball.radius, ball.mass, kGravity};
}

/// Intervals of bounces by the closed forms, from a first rebound with u [m/s].
std::vector<double> series(const std::string& preset, double drag, double e, double u, int count) {
    const Preset& ball = *find_preset(preset);
    const FallInAir fall(Air{}, ball.radius, ball.mass, drag, kGravity);
    std::vector<double> times;
    for (int n = 0; n < count; ++n) {
        times.push_back(fall.interval(u));
        u *= e * fall.kept_part(u);
    }
    return times;
}

TEST(FitDrag, FindsBothInTheClosedForms) {
    for (const double drag : {0.1, 0.45, 1.2}) {
        const DragFit fit =
            fit_drag(series("table_tennis", drag, 0.9, 4, 10), table_tennis(), std::nullopt);
        EXPECT_NEAR(0.9, fit.restitution.value, 1e-9) << drag;
        EXPECT_NEAR(drag, fit.drag.value, 1e-7) << drag;
        EXPECT_NEAR(4, fit.first_speed, 1e-7);
    }
}

TEST(FitDrag, FindsWhatTheSimulationWasGiven) {
    const std::string text =
        "carom: 1\nsimulation: {duration: 6}\nair: {}\nmaterials: {m: {restitution: 0.88}}\n"
        "surfaces: [{name: f, plane: {}}]\n"
        "balls: [{name: a, preset: table_tennis, material: m, drop_height: 2.5, drag: 0.52}]\n";
    const SceneResult loaded = read_scene(text, "air.yaml");
    ASSERT_TRUE(loaded.scene);
    const Motion motion = simulate(*loaded.scene).motion;
    std::vector<double> at;
    for (const Event& event : motion.events)
        if (event.kind == EventKind::kImpact) at.push_back(event.time);
    ASSERT_GT(at.size(), 10U);
    std::vector<double> intervals;
    for (std::size_t i = 1; i < 11; ++i) intervals.push_back(at[i] - at[i - 1]);
    const DragFit fit = fit_drag(intervals, table_tennis(), std::nullopt);
    fmt::print("off by {:.1e} and {:.1e}\n", fit.restitution.value - 0.88, fit.drag.value - 0.52);
    EXPECT_NEAR(0.88, fit.restitution.value, 1e-6);
    EXPECT_NEAR(0.52, fit.drag.value, 1e-6);
}

TEST(FitDrag, TheTruthIsWithinItsInterval) {
    constexpr int kTrials = 10'000;
    const std::vector<double> exact = series("table_tennis", 0.45, 0.9, 5, 10);
    for (const bool known : {false, true}) {
        std::mt19937_64 random(7);
        std::normal_distribution<double> noise(0, 0.0005);
        int e = 0, drag = 0;
        for (int trial = 0; trial < kTrials; ++trial) {
            std::vector<double> times = exact;
            for (double& time : times) time += noise(random);
            const DragFit fit = fit_drag(times, table_tennis(),
                                         known ? std::optional<double>(0.0005) : std::nullopt);
            e += fit.restitution.low <= 0.9 && 0.9 <= fit.restitution.high;
            drag += fit.drag.low <= 0.45 && 0.45 <= fit.drag.high;
        }
        fmt::print("{}: restitution {:.2f} %, drag {:.2f} %\n", known ? "reading error" : "scatter",
                   100.0 * e / kTrials, 100.0 * drag / kTrials);
        expect_95_percent(e, kTrials, known);
        expect_95_percent(drag, kTrials, known);
    }
}

TEST(FitDrag, RefusesASeriesThatDoesNotCarryIt) {
    const auto refusal = [](const std::vector<double>& times, std::optional<double> error) {
        return complaint([&] { fit_drag(times, table_tennis(), error); });
    };
    // A heavy ball that is dropped from low, read to a millisecond: the drag is in the noise.
    EXPECT_TRUE(
        holds(refusal(series("table_tennis", 0.45, 0.9, 1, 5), 0.001), "do not tell the drag"));
    // A vacuum has none.
    EXPECT_TRUE(
        holds(refusal({1, 0.8, 0.64, 0.512, 0.4096, 0.32768}, 0.001), "do not tell the drag"));
    EXPECT_TRUE(
        holds(refusal(series("table_tennis", 0.45, 0.9, 4, 4), std::nullopt), "at least 5"));
    EXPECT_TRUE(holds(refusal({0.5, 0.6, 0.7, 0.8, 0.9}, 0.001), "shrink"));
    EXPECT_TRUE(holds(refusal({0.5, 0.4, 0, 0.3, 0.2}, 0.001), "interval 3"));
}

}  // namespace
}  // namespace carom
