// Which runs there are, and the values that are drawn for them.
#include "sweep/file/plan.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "scene/fields.h"
#include "sweep_testing.h"

namespace carom {
namespace {

std::vector<double> column(const Plan& plan, std::size_t axis) {
    std::vector<double> values;
    for (std::int64_t run = 0; run < plan.count(); ++run)
        values.push_back(node_number(plan.values(run)[axis]));
    return values;
}

std::string rows(const Plan& plan) {
    std::string text;
    for (std::int64_t run = 0; run < plan.count(); ++run) {
        for (const Node& value : plan.values(run)) text += flow_text(value) + " ";
        text += "; ";
    }
    return text;
}

std::string rows_of(const std::string& text) { return rows(Plan(SweepFiles(text).sweep())); }

TEST(Plan, OfAGridChangesTheLastAxisFastest) {
    EXPECT_EQ(rows_of("base: base.yaml\naxes:\n  balls.a.mass: [1, 2]\n"
                      "  balls.a.position[2]: {from: 1, to: 2, steps: 3}\n"),
              "1 1 ; 1 1.5 ; 1 2 ; 2 1 ; 2 1.5 ; 2 2 ; ");
}

TEST(Plan, OfAZipTakesColumnsTogetherAndRepeatsOneValue) {
    EXPECT_EQ(rows_of("base: base.yaml\nmode: zip\naxes:\n  balls.a.mass: [1, 2, 3]\n"
                      "  simulation.gravity[2]: [-5]\n"
                      "  film.size: [[64, 64], [32, 32], [16, 16]]\n"),
              "1 -5 [64, 64] ; 2 -5 [32, 32] ; 3 -5 [16, 16] ; ");
}

TEST(Plan, RangesEndAtTheirEndsWithoutDebrisOfRounding) {
    EXPECT_EQ(rows_of("base: base.yaml\nmode: zip\naxes:\n"
                      "  balls.a.mass: {from: 0.1, to: 0.7, steps: 7}\n"
                      "  balls.a.radius: {from: 0.001, to: 1000, steps: 7, scale: log}\n"),
              "0.1 0.001 ; 0.2 0.01 ; 0.3 0.1 ; 0.4 1 ; 0.5 10 ; 0.6 100 ; 0.7 1000 ; ");
}

TEST(Plan, RangesMayHaveSubnormalValues) {
    EXPECT_EQ(
        rows_of("base: base.yaml\naxes:\n  balls.a.position[0]: {from: 0, to: 4e-308, steps: 5}\n"),
        "0 ; 1e-308 ; 2e-308 ; 3e-308 ; 4e-308 ; ");
}

TEST(Plan, OfALatinHypercubeMeetsEachPartOfEachAxisOnce) {
    const Sweep sweep = SweepFiles(
                            "base: base.yaml\nmode: lhs\ncount: 200\nseed: 3\naxes:\n"
                            "  balls.a.mass: {uniform: [2, 4]}\n"
                            "  balls.a.radius: {log_uniform: [0.01, 1]}\n"
                            "  balls.a.material: [rubber, rubber]\n")
                            .sweep();
    const Plan plan(sweep);
    std::set<int> linear, logarithmic;
    for (const double value : column(plan, 0))
        linear.insert(static_cast<int>((value - 2) / 2 * 200));
    for (const double value : column(plan, 1))
        logarithmic.insert(static_cast<int>(std::log10(value / 0.01) / 2 * 200));
    EXPECT_EQ(linear.size(), 200U);
    EXPECT_EQ(logarithmic.size(), 200U);
    // The columns are shuffled apart from each other: a correlation of 200 pairs by chance is
    // within 4 / sqrt(200).
    const std::vector<double> x = column(plan, 0), y = column(plan, 1);
    double sxy = 0, sxx = 0, syy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = x[i] - 3, dy = std::log10(y[i]) + 1;
        sxy += dx * dy;
        sxx += dx * dx;
        syy += dy * dy;
    }
    EXPECT_LT(std::abs(sxy / std::sqrt(sxx * syy)), 4 / std::sqrt(200.0));
}

TEST(Plan, OfDrawsDoesNotChangeItsFirstRunsWithTheirNumber) {
    const std::string text =
        "base: base.yaml\nmode: random\nseed: 5\naxes:\n  balls.a.mass: {normal: [2, 0.1]}\n";
    const Sweep few = SweepFiles(text + "count: 10\n").sweep();
    const Sweep many = SweepFiles(text + "count: 1000\n").sweep();
    const std::vector<double> a = column(Plan(few), 0), b = column(Plan(many), 0);
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
    EXPECT_EQ(std::set<double>(b.begin(), b.end()).size(), 1000U);
    std::string other = text + "count: 10\n";
    other.replace(other.find("seed: 5"), 7, "seed: 6");
    EXPECT_NE(column(Plan(SweepFiles(other).sweep()), 0), a);
}

/// Mean and deviation of 4000 draws against those of the distribution, within 5 standard errors.
TEST(Draws, HaveTheMeanAndDeviationOfTheirDistribution) {
    struct Case {
        const char* draw;
        double mean, deviation;
    };
    const double third = std::sqrt(1 / 12.0);
    const double log_mean = 0.9 / std::log(10.0);  // of 1 / (x ln 10) on [0.1, 1]
    const double log_square = 0.5 * 0.99 / std::log(10.0);
    const Case cases[] = {
        {"{uniform: [2, 3]}", 2.5, third},
        {"{normal: [2, 0.25]}", 2, 0.25},
        // Of a normal cut at its mean: |x| of a normal has mean sqrt(2/pi) and variance 1 - 2/pi.
        {"{normal: [2, 0.25], within: [2, 100]}", 2 + 0.25 * std::sqrt(2 / M_PI),
         0.25 * std::sqrt(1 - 2 / M_PI)},
        {"{log_uniform: [0.1, 1]}", log_mean, std::sqrt(log_square - log_mean * log_mean)},
        {"{integer: [1, 6]}", 3.5, std::sqrt(35 / 12.0)},
        {"{choice: [1, 5], weights: [3, 1]}", 2, std::sqrt(3.0)},
        {"[1, 2, 3]", 2, std::sqrt(2 / 3.0)},
    };
    for (const Case& one : cases) {
        const Sweep sweep =
            SweepFiles(std::string("base: base.yaml\nmode: random\ncount: 4000\naxes:\n") +
                       "  balls.a.mass: " + one.draw + "\n")
                .sweep();
        const std::vector<double> values = column(Plan(sweep), 0);
        double sum = 0, squares = 0;
        for (const double value : values) sum += value;
        const double mean = sum / 4000;
        for (const double value : values) squares += (value - mean) * (value - mean);
        const double deviation = std::sqrt(squares / 3999);
        EXPECT_NEAR(mean, one.mean, 5 * one.deviation / std::sqrt(4000.0)) << one.draw;
        EXPECT_NEAR(deviation, one.deviation, 0.1 * one.deviation) << one.draw;
    }
}

TEST(Draws, StayWithinTheirBounds) {
    for (const char* draw : {"{uniform: [2, 2.5]}", "{normal: [2, 9], within: [2, 2.5]}",
                             "{log_uniform: [2, 2.5]}", "{integer: [2, 2]}"}) {
        const Sweep sweep =
            SweepFiles(std::string("base: base.yaml\nmode: lhs\ncount: 500\naxes:\n") +
                       "  balls.a.mass: " + draw + "\n")
                .sweep();
        const std::vector<double> values = column(Plan(sweep), 0);
        EXPECT_GE(*std::min_element(values.begin(), values.end()), 2) << draw;
        EXPECT_LE(*std::max_element(values.begin(), values.end()), 2.5) << draw;
    }
}

TEST(Draws, OfAGridAreAsManyAsWanted) {
    const Sweep sweep = SweepFiles(
                            "base: base.yaml\naxes:\n  balls.a.radius: [0.1, 0.2]\n"
                            "  balls.a.mass: {uniform: [1, 2], draws: 3}\n")
                            .sweep();
    const Plan plan(sweep);
    ASSERT_EQ(plan.count(), 6);
    const std::vector<double> mass = column(plan, 1);
    EXPECT_TRUE(std::equal(mass.begin(), mass.begin() + 3, mass.begin() + 3));
    EXPECT_NE(mass[0], mass[1]);
}

TEST(FlowText, ReadsBackAsTheSame) {
    for (const char* text : {"1.5", "true", "name", "\"two words\"", "\"true\"", "\"1\"",
                             "[1, \"a, b\", {k: [2, x]}]", "\"#ff0000\"", "\"null\"", "\"\""}) {
        Diagnostics none;
        const std::optional<Node> node = parse_document(text, "", none);
        const std::optional<Node> again = parse_document(flow_text(node.value()), "", none);
        EXPECT_TRUE(none.empty()) << flow_text(*node);
        EXPECT_EQ(fingerprint(*node), fingerprint(again.value())) << text;
        EXPECT_EQ(flow_text(*node), text);
    }
}

TEST(Plan, AHypercubeThatTakesTooLongToShuffleIsRefused) {
    const auto messages = [](int axes) {
        std::string text = "base: base.yaml\nmode: lhs\ncount: 10000000\naxes:\n";
        for (const char* path : {"balls.a.mass", "balls.a.radius", "film.fps"})
            if (axes-- > 0) text += std::string("  ") + path + ": {uniform: [0.05, 0.06]}\n";
        std::string all;
        const SweepResult read = SweepFiles(text).read();
        for (const Diagnostic& d : read.diagnostics.items()) all += d.message;
        return all;
    };
    EXPECT_EQ(messages(2), "");
    EXPECT_NE(messages(3).find("10000000 runs of 3 axes are too many"), std::string::npos)
        << messages(3);
}

}  // namespace
}  // namespace carom
