#include "page/scatter_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/markup.h"
#include "page/plot_frame.h"

namespace carom {

namespace {

constexpr double kByPowers = 50;  // largest over smallest value

struct ValueRange {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool empty() const { return !(low <= high); }
    /// With room at both ends.
    void widen() {
        const double room = high > low ? 0.05 * (high - low) : low == 0 ? 1 : 0.05 * std::abs(low);
        low -= room;
        high += room;
    }
};

/// One class of points, and lines between them where they are joined.
std::string drawn(const ScatterSeries& series, const PlotFrame& frame, bool by_powers, bool joined,
                  std::size_t color) {
    std::vector<std::size_t> order(series.x.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](std::size_t i) {
        return !std::isfinite(series.x[i]) || !std::isfinite(series.y[i]);
    });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return series.x[a] < series.x[b]; });
    const std::size_t stride = (order.size() + kMostPoints - 1) / kMostPoints;
    std::string points, line;
    for (std::size_t k = 0; k < order.size(); k += stride) {
        const std::size_t i = order[k];
        const double x = frame.x(by_powers ? std::log10(series.x[i]) : series.x[i]);
        const double y = frame.y(series.y[i]);
        points += fmt::format("M{:.1f} {:.1f}h0", x, y);
        line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x, y);
    }
    std::string text;
    if (joined) text += fmt::format("<path class=\"curve thin s{}\" d=\"{}\"/>\n", color, line);
    return text + fmt::format("<path class=\"points s{}\" d=\"{}\"/>\n", color, points);
}

}  // namespace

std::string scatter_plot(const ScatterPlot& plot) {
    ValueRange across, upwards;
    std::size_t points = 0;
    for (const ScatterSeries& series : plot.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
            across.add(series.x[i]);
            upwards.add(series.y[i]);
            ++points;
        }
    if (across.empty()) return "";
    const std::string label = fmt::format("{} over {}: {} points, {:.4g} to {:.4g}", plot.upwards,
                                          plot.across, points, upwards.low, upwards.high);
    const bool by_powers = across.low > 0 && across.high >= kByPowers * across.low;
    if (by_powers) across = {std::log10(across.low), std::log10(across.high)};
    across.widen();
    upwards.widen();
    const PlotFrame frame{across.low, across.high, upwards.low, upwards.high};
    std::string text =
        fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}",
                    PlotFrame::kWidth, PlotFrame::kHeight, escaped(label),
                    frame.axes((by_powers ? "log₁₀ " : "") + escaped(plot.across), ""));
    for (std::size_t i = 0; i < plot.series.size(); ++i)
        text += drawn(plot.series[i], frame, by_powers, plot.joined, i % kMostSeries);
    text += "</svg>\n";
    if (plot.series.size() < 2) return text;
    text += "<ul class=\"key\">\n";
    for (std::size_t i = 0; i < plot.series.size(); ++i)
        text += fmt::format(
            "<li><svg viewBox=\"0 0 32 10\" aria-hidden=\"true\"><path class=\"points s{}\" "
            "d=\"M16 5h0\"/></svg>{}</li>\n",
            i % kMostSeries, escaped(plot.series[i].name));
    return text + "</ul>\n";
}

}  // namespace carom
