#include "report/paper_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/paper_data.h"
#include "scene/catalogue.h"
#include "sim/contact/restitution.h"

namespace carom {

namespace {

constexpr int kPoints = 201;  ///< of a curve: smooth on paper

/// `count` numbers from `from` to `to`, both included.
std::vector<double> steps(double from, double to, int count = kPoints) {
    std::vector<double> result;
    for (int i = 0; i < count; ++i) result.push_back(from + (to - from) * i / (count - 1));
    return result;
}

template <class Function>
std::vector<double> values(const std::vector<double>& x, const Function& f) {
    std::vector<double> y;
    std::transform(x.begin(), x.end(), std::back_inserter(y), f);
    return y;
}

/// Eq. 6 and 7 with the fixed body of Figures 5 and 6.
double restitution_with(const VirtualBody& a) {
    const VirtualBody b{kFixedDistance_m, kFixedVelocity_m_s};
    return restitution_of_time(contact_time(a, b), kPaperConstant);
}

}  // namespace

Figure figure4() {
    constexpr double kLongest_s = 1.0;
    const std::vector<double> time = steps(0, kLongest_s);
    const std::vector<double> restitution =
        values(time, [](double t) { return restitution_of_time(t, kPaperConstant); });
    std::vector<double> ball_time, ball_restitution;
    for (const Preset& preset : catalogue()) {
        ball_time.push_back(virtual_time(preset.virtual_body));
        ball_restitution.push_back(restitution_of_time(ball_time.back(), kPaperConstant));
    }
    Plot plot;
    plot.title = "Figure 4: restitution against the time T of the virtual bodies";
    plot.x = {.label = "T, s", .min = 0, .max = kLongest_s};
    plot.y = {.label = "restitution ε", .min = 0, .max = 1};
    plot.series = {{.title = "ε = exp(−K T), K = 4 1/s", .x = time, .y = restitution},
                   {.title = "the five balls on steel",
                    .style = SeriesStyle::kPoints,
                    .x = ball_time,
                    .y = ball_restitution}};
    return {plot, number_table({"time_s", "restitution"}, {time, restitution})};
}

Figure figure5() {
    constexpr std::array kDistances = {0.1, 0.5, 1.0};  // m
    const std::vector<double> velocity = steps(0.05, 10, 200);
    Plot plot;
    plot.title = "Figure 5: restitution against the virtual velocity v_{A}";
    plot.x = {.label = "v_{A}, m/s", .min = 0, .max = 10};
    plot.y = {.label = "restitution ε", .min = 0, .max = 1};
    plot.legend = Legend::kBottomRight;
    std::vector<std::string> names = {"velocity_m_s"};
    std::vector<std::vector<double>> columns = {velocity};
    for (const double x : kDistances) {
        columns.push_back(values(velocity, [&](double v) { return restitution_with({x, v}); }));
        names.push_back(fmt::format("restitution_x{}", x));
        plot.series.push_back(
            {.title = fmt::format("x_{{A}} = {} m", x), .x = velocity, .y = columns.back()});
    }
    plot.texts = {{5.6, 0.42,
                   fmt::format("x_{{B}} = {} m, v_{{B}} = {} m/s, K = 4 1/s", kFixedDistance_m,
                               kFixedVelocity_m_s)}};
    return {plot, number_table(names, columns)};
}

Figure figure6() {
    constexpr std::array kVelocities = {5.0, 2.0, 1.0};  // m/s
    const std::vector<double> distance = steps(0, 2);
    Plot plot;
    plot.title = "Figure 6: restitution against the virtual distance x_{A}";
    plot.x = {.label = "x_{A}, m", .min = 0, .max = 2};
    plot.y = {.label = "restitution ε", .min = 0, .max = 1};
    std::vector<std::string> names = {"distance_m"};
    std::vector<std::vector<double>> columns = {distance};
    for (const double v : kVelocities) {
        columns.push_back(values(distance, [&](double x) { return restitution_with({x, v}); }));
        names.push_back(fmt::format("restitution_v{}", v));
        plot.series.push_back(
            {.title = fmt::format("v_{{A}} = {} m/s", v), .x = distance, .y = columns.back()});
    }
    plot.texts = {{1.12, 0.68,
                   fmt::format("x_{{B}} = {} m, v_{{B}} = {} m/s, K = 4 1/s", kFixedDistance_m,
                               kFixedVelocity_m_s)}};
    return {plot, number_table(names, columns)};
}

Figure figure7() {
    // Eq. 7 and 10: v = K x / (-2 ln ε).
    const double slope = kPaperConstant / (-2 * std::log(kFigure7Restitution));
    const std::vector<double> distance = steps(0, 1, 101);
    const std::vector<double> velocity = values(distance, [&](double x) { return slope * x; });
    const Table2Row& ball = paper_table2().front();
    Plot plot;
    plot.title = "Figure 7: virtual velocity against virtual distance, basketball";
    plot.x = {.label = "x, m", .min = 0, .max = 1};
    plot.y = {.label = "v, m/s", .min = 0, .max = 14};
    plot.legend = Legend::kTopLeft;
    plot.series = {
        {.title = fmt::format("v = {:.2f} x: ε = {}, K = 4 1/s", slope, kFigure7Restitution),
         .x = distance,
         .y = velocity},
        {.title = fmt::format("Table 2: x = {} m, v = {} m/s", ball.printed_velocity,
                              ball.printed_distance),
         .style = SeriesStyle::kPoints,
         .x = {ball.printed_velocity},
         .y = {ball.printed_distance}}};
    return {plot, number_table({"distance_m", "velocity_m_s"}, {distance, velocity})};
}

}  // namespace carom
