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

struct CurveWords {
    std::string column, title, unit;  ///< before and after the number
};

/// Figures 5 and 6: the restitution over one of x and v, a curve for each value of the other one.
template <class Body>
Figure restitution_curves(const std::vector<double>& over, const std::string& column,
                          const std::vector<double>& others, const CurveWords& words,
                          const Body& body, const std::array<double, 2>& text_at) {
    Plot plot;
    plot.y = {.label = "restitution ε", .min = 0, .max = 1};
    std::vector<std::string> names = {column};
    std::vector<std::vector<double>> columns = {over};
    for (const double other : others) {
        columns.push_back(
            values(over, [&](double at) { return restitution_with(body(at, other)); }));
        names.push_back(fmt::format("{}{}", words.column, other));
        plot.series.push_back({.title = fmt::format("{}{} {}", words.title, other, words.unit),
                               .x = over,
                               .y = columns.back()});
    }
    plot.texts = {{text_at[0], text_at[1],
                   fmt::format("x_{{B}} = {} m, v_{{B}} = {} m/s, K = 4 1/s", kFixedDistance_m,
                               kFixedVelocity_m_s)}};
    return {plot, number_table(names, columns)};
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
    Figure figure = restitution_curves(steps(0.05, 10, 200), "velocity_m_s", {0.1, 0.5, 1.0},
                                       {"restitution_x", "x_{A} = ", "m"},
                                       [](double v, double x) {
                                           return VirtualBody{x, v};
                                       },
                                       {5.6, 0.42});
    figure.plot.title = "Figure 5: restitution against the virtual velocity v_{A}";
    figure.plot.x = {.label = "v_{A}, m/s", .min = 0, .max = 10};
    figure.plot.legend = Legend::kBottomRight;
    return figure;
}

Figure figure6() {
    Figure figure = restitution_curves(steps(0, 2), "distance_m", {5.0, 2.0, 1.0},
                                       {"restitution_v", "v_{A} = ", "m/s"},
                                       [](double x, double v) {
                                           return VirtualBody{x, v};
                                       },
                                       {1.12, 0.68});
    figure.plot.title = "Figure 6: restitution against the virtual distance x_{A}";
    figure.plot.x = {.label = "x_{A}, m", .min = 0, .max = 2};
    return figure;
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
