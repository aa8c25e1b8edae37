// The result of a fit as text, JSON and plot; declared in fit.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/fit.h"

namespace carom {

namespace {

constexpr double kDefaultConstant = 4;  // of a scene

nlohmann::ordered_json maybe(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// v / x of the line, 1/s; infinite for a coefficient of 1.
double slope_of(double restitution, double constant) {
    return 1 / virtual_body_line(restitution, constant, 1).ratio_s;
}

}  // namespace

std::string material_snippet(const std::string& name, const VirtualBodyLine& line) {
    std::string text;
    if (line.constant != kDefaultConstant)
        text += fmt::format("simulation: {{restitution_constant: {}}}\n", line.constant);
    return text +
           fmt::format("materials:\n  {}: {{virtual_body: {{distance: {}, velocity: {}}}}}\n", name,
                       line.point.distance_m, line.point.velocity_m_s);
}

std::string fit_text(const RestitutionFit& fit, const VirtualBodyLine& line,
                     const std::string& name) {
    std::string text = fmt::format("# restitution ε = {:.6f}", fit.restitution);
    if (fit.uncertainty)
        text += fmt::format(" ± {:.2g} (standard uncertainty); 95 %: {:.6f} ... {:.6f}",
                            *fit.uncertainty, *fit.low, *fit.high);
    text += '\n';
    if (fit.from_repeats)
        text +=
            fmt::format("# scatter of {} values: ± {:.2g}\n", fit.single.size(), *fit.from_repeats);
    if (fit.from_reading) text += fmt::format("# reading error: ± {:.2g}\n", *fit.from_reading);
    if (!fit.uncertainty)
        text += "# no uncertainty is known: repeat the drop, or give --reading-error\n";
    text += fmt::format("# K = {} 1/s: T = {:.6g} s, x / v = {:.6g} s; ", line.constant,
                        0.5 * line.ratio_s, line.ratio_s);
    text += line.ratio_s > 0
                ? fmt::format("every point of v = {:.6g} x will do\n", 1 / line.ratio_s)
                : std::string("x = 0 with any v loses nothing\n");
    text += fmt::format("# suggested point: x = {:.6g} m, v = {:.6g} m/s\n", line.point.distance_m,
                        line.point.velocity_m_s);
    return text + material_snippet(name, line);
}

std::string fit_json(const RestitutionFit& fit, const VirtualBodyLine& line,
                     const std::string& name) {
    nlohmann::ordered_json json;
    json["restitution"] = fit.restitution;
    json["uncertainty"] = maybe(fit.uncertainty);
    json["interval_95"] =
        fit.low ? nlohmann::ordered_json({*fit.low, *fit.high}) : nlohmann::ordered_json(nullptr);
    json["from_repeats"] = maybe(fit.from_repeats);
    json["from_reading"] = maybe(fit.from_reading);
    json["single"] = fit.single;
    json["constant"] = line.constant;
    json["contact_time_s"] = 0.5 * line.ratio_s;
    json["distance_per_velocity_s"] = line.ratio_s;
    json["point"] = {{"distance_m", line.point.distance_m},
                     {"velocity_m_s", line.point.velocity_m_s}};
    json["material"] = name;
    json["snippet"] = material_snippet(name, line);
    // File names need be no UTF-8, JSON has to be.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Plot fit_plot(const RestitutionFit& fit, const VirtualBodyLine& line) {
    const VirtualBody& point = line.point;
    const double widest = point.distance_m > 0 ? 2 * point.distance_m : 1;
    const double highest = 2.5 * point.velocity_m_s;
    Plot plot;
    plot.title = fmt::format("Virtual bodies of ε = {:.4f}", fit.restitution);
    plot.x = {.label = "x, m", .min = 0, .max = widest};
    plot.y = {.label = "v, m/s", .min = 0, .max = highest};
    plot.legend = Legend::kTopLeft;

    // The whole width, beyond the top of the plot where the line is steep; x = 0 stands upright.
    if (fit.low) {
        constexpr int kSteps = 200;
        Series band{.title = fmt::format("95 %: ε = {:.4f} ... {:.4f}", *fit.low, *fit.high),
                    .style = SeriesStyle::kBand,
                    .color = 0};
        for (int i = 0; i <= kSteps; ++i) {
            const double x = widest * i / kSteps;
            const auto on_line = [&](double restitution) {
                if (x == 0 || restitution <= 0) return 0.0;
                return std::min(slope_of(restitution, line.constant) * x, highest);
            };
            band.x.push_back(x);
            band.y.push_back(on_line(*fit.low));
            band.upper.push_back(on_line(*fit.high));
        }
        plot.series.push_back(std::move(band));
    }
    const bool upright = line.ratio_s * highest < 1e-9 * widest;
    plot.series.push_back({.title = upright ? fmt::format("x = 0, K = {} 1/s", line.constant)
                                            : fmt::format("v = {:.4g} x, K = {} 1/s",
                                                          1 / line.ratio_s, line.constant),
                           .x = {0, upright ? 0 : widest},
                           .y = {0, upright ? highest : widest / line.ratio_s},
                           .color = 0});
    plot.series.push_back(
        {.title = fmt::format("x = {:.4g} m, v = {:.4g} m/s", point.distance_m, point.velocity_m_s),
         .style = SeriesStyle::kPoints,
         .x = {point.distance_m},
         .y = {point.velocity_m_s},
         .color = 1});
    return plot;
}

}  // namespace carom
