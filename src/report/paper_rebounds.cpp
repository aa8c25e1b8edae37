// Figure 8: heights of the dropped ball; declared in paper_figures.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/paper_figures.h"

namespace carom {

double Drop::fall_s() const { return std::sqrt(2 * height_m / gravity_m_s2); }

double Drop::rebound_m(int n) const { return std::pow(restitution, 2 * n) * height_m; }

double Drop::rebound_time_s(int n) const {
    // Impact k + 1 comes 2 ε^k fall after impact k; the top lies half a flight after the last.
    double time = fall_s(), flight = fall_s();
    for (int k = 1; k <= n; ++k) {
        flight *= restitution;
        time += k < n ? 2 * flight : flight;
    }
    return time;
}

double Drop::height_at(double t) const {
    if (t <= fall_s()) return height_m - 0.5 * gravity_m_s2 * t * t;
    if (restitution <= 0) return 0;
    double impact = fall_s(), half = fall_s() * restitution;
    // A ball whose bounces have died away lies still.
    constexpr double kNoTime = 1e-12;  // s
    while (t > impact + 2 * half) {
        impact += 2 * half;
        half *= restitution;
        if (half < kNoTime) return 0;
    }
    const double s = t - impact;
    return 0.5 * gravity_m_s2 * s * (2 * half - s);
}

Figure figure8_height(const Motion& motion, double radius_m, const Drop& drop) {
    constexpr int kPerSecond = 100;
    std::vector<double> time, simulated, closed, difference;
    const auto last = static_cast<int>(std::floor(motion.duration * kPerSecond + 1e-9));
    for (int k = 0; k <= last; ++k) {
        time.push_back(static_cast<double>(k) / kPerSecond);
        simulated.push_back(motion.balls.front().at(time.back()).position.z() - radius_m);
        closed.push_back(drop.height_at(time.back()));
        difference.push_back(simulated.back() - closed.back());
    }
    std::vector<double> top_time, top_height;
    for (const Peak& peak : motion.peaks.front()) {
        top_time.push_back(peak.time);
        top_height.push_back(peak.height);
    }
    Plot plot;
    plot.title = fmt::format("Figure 8: basketball dropped from {} m", drop.height_m);
    plot.x = {.label = "time, s", .min = 0, .max = motion.duration};
    plot.y = {.label = "height of the ball's bottom, m", .min = 0, .max = 2};
    plot.series = {
        {.title = "simulated", .x = time, .y = simulated, .color = 6, .width = 6},
        {.title = fmt::format("closed form, ε = {:.6f}", drop.restitution),
         .style = SeriesStyle::kDashedLine,
         .x = time,
         .y = closed,
         .color = 0,
         .width = 1.5},
        {.title = "tops: ε^{2n} H", .style = SeriesStyle::kPoints, .x = top_time, .y = top_height}};
    return {plot, number_table({"time_s", "height_m", "closed_form_m", "difference_m"},
                               {time, simulated, closed, difference})};
}

TextTable figure8_rebounds(const Motion& motion, const Drop& drop) {
    TextTable table;
    table.columns = {{"rebound", "Rebound n"},
                     {"time_s", "Time [s]"},
                     {"height_m", "Height, simulated [m]"},
                     {"closed_form_m", "ε²ⁿ H [m]"},
                     {"relative_deviation", "Relative deviation"}};
    int n = 0;
    for (const Peak& peak : motion.peaks.front()) {
        const double expected = drop.rebound_m(++n);
        table.rows.push_back({{static_cast<double>(n), 0},
                              {peak.time, 6},
                              {peak.height, 9},
                              {expected, 9},
                              {peak.height / expected - 1, 12}});
    }
    return table;
}

}  // namespace carom
