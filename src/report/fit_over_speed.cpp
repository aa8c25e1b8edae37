#include "report/fit_over_speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/fit_refusal.h"

namespace carom {

namespace {

constexpr double kGravity = 9.81;  // m/s^2, of a scene

/// A straight line y = level + slope (x - middle), and what its two numbers err by.
struct Line {
    double middle = 0, level = 0, slope = 0;
    double level_squared = 0, slope_squared = 0;  ///< of reading errors; with weights of 1, unused
    double residuals = 0;                         ///< weighted squares
    double weights = 0, spread = 0;
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& y,
              const std::vector<double>& weight) {
    Line line;
    for (std::size_t i = 0; i < x.size(); ++i) {
        line.weights += weight[i];
        line.middle += weight[i] * x[i];
        line.level += weight[i] * y[i];
    }
    line.middle /= line.weights;
    line.level /= line.weights;
    for (std::size_t i = 0; i < x.size(); ++i) {
        line.spread += weight[i] * std::pow(x[i] - line.middle, 2);
        line.slope += weight[i] * (x[i] - line.middle) * y[i];
    }
    line.slope /= line.spread;
    for (std::size_t i = 0; i < x.size(); ++i)
        line.residuals +=
            weight[i] * std::pow(y[i] - line.level - line.slope * (x[i] - line.middle), 2);
    line.level_squared = 1 / line.weights;
    line.slope_squared = 1 / line.spread;
    return line;
}

/// d(ln e + p ln v)^2 of a reading error E: e = sqrt(h/H), v ~ sqrt(H); air changes it little.
double reading_squared(double rebound, double drop, double exponent, double error) {
    return 0.25 * (std::pow(error / rebound, 2) + std::pow((1 - exponent) * error / drop, 2));
}

Interval95 interval(double value, double uncertainty, double covered) {
    return {value, uncertainty, value - covered * uncertainty, value + covered * uncertainty};
}

void require_enough(const SpeedFit& fit, const FitOptions& options) {
    // A tenth of a height apart: closer, and the law hangs on the readings' last digits.
    constexpr double kApartRatio = 1.05;
    if (!(fit.highest > kApartRatio * fit.lowest))
        refuse_fit(
            fmt::format("--over-speed: the impacts have speeds of {:.4g} to {:.4g} m/s, which are "
                        "one: drop from heights that differ, at best by a factor of 4",
                        fit.lowest, fit.highest));
    if (fit.speeds.size() < 3 && !options.reading_error)
        refuse_fit(
            "--over-speed: two drops fit every law exactly: give a third, or the --reading-error");
}

}  // namespace

double SpeedFit::law(double speed) const {
    return value.value * std::pow(speed / at_speed, -exponent.value);
}

double SpeedFit::relative_uncertainty(double speed) const {
    return std::hypot(value.uncertainty / value.value,
                      exponent.uncertainty * std::log(speed / at_speed));
}

SpeedFit fit_over_speed(const std::vector<MeasuredDrop>& drops, const FitOptions& options) {
    SpeedFit fit;
    fit.restitutions = fit_restitution({drops, {}}, options).single;
    std::vector<double> x, y;
    for (std::size_t i = 0; i < drops.size(); ++i) {
        const double drop = drops[i].drop_m;
        fit.speeds.push_back(options.air ? options.air->impact_speed(drop)
                                         : std::sqrt(2 * kGravity * drop));
        x.push_back(std::log(fit.speeds.back()));
        y.push_back(std::log(fit.restitutions[i]));
    }
    fit.lowest = *std::min_element(fit.speeds.begin(), fit.speeds.end());
    fit.highest = *std::max_element(fit.speeds.begin(), fit.speeds.end());
    require_enough(fit, options);

    std::vector<double> weight(drops.size(), 1.0);
    Line line = fit_line(x, y, weight);
    if (options.reading_error)
        for (int i = 0; i < 3; ++i) {  // the weights know the exponent
            for (std::size_t k = 0; k < drops.size(); ++k) {
                const double rebound =
                    drops[k].rebound_m -
                    (options.rebound_to == ReboundTo::kTop ? options.diameter_m : 0);
                weight[k] = 1 / reading_squared(rebound, drops[k].drop_m, -line.slope,
                                                *options.reading_error);
            }
            line = fit_line(x, y, weight);
        }
    if (!(-line.slope < 1))
        refuse_fit(
            fmt::format("--over-speed: an exponent of {:.4g}: from greater heights the ball would "
                        "rebound more slowly, which no scene has",
                        -line.slope));
    // With reading errors the weights are of their size, and residuals of 1 each are as expected.
    const int degrees = static_cast<int>(drops.size()) - 2;
    double scale = options.reading_error ? 1 : 0;
    fit.covered = kNormal95;
    if (degrees > 0 && line.residuals / degrees > scale) {
        scale = line.residuals / degrees;
        fit.covered = student_t95(degrees);
    }
    fit.at_speed = std::exp(line.middle);
    const double value = std::exp(line.level);
    fit.value = interval(value, value * std::sqrt(scale * line.level_squared), fit.covered);
    fit.exponent = interval(-line.slope, std::sqrt(scale * line.slope_squared), fit.covered);
    return fit;
}

namespace {

std::string power_snippet(const SpeedFit& fit, const std::string& name) {
    return fmt::format(
        "materials:\n  {}: {{restitution: {{power: {{value: {:.8g}, at_speed: {:.8g}, exponent: "
        "{:.8g}}}}}}}\n",
        name, fit.value.value, fit.at_speed, fit.exponent.value);
}

}  // namespace

std::string speed_fit_text(const SpeedFit& fit, const std::string& name) {
    const auto line = [](const char* what, const Interval95& found) {
        return fmt::format("# {} {:.6f} ± {:.2g} (standard uncertainty); 95 %: {:.6f} ... {:.6f}\n",
                           what, found.value, found.uncertainty, found.low, found.high);
    };
    std::string text = fmt::format(
        "# restitution over the approach speed v, of {} drops: e = e1 (v / {:.6g} m/s)^(-p)\n",
        fit.speeds.size(), fit.at_speed);
    text += line("e1 =", fit.value) + line("p =", fit.exponent);
    const bool constant = fit.exponent.low <= 0 && fit.exponent.high >= 0;
    if (constant) text += "# the drops do not tell it from one coefficient for all speeds\n";
    text += fmt::format("# measured from {:.4g} to {:.4g} m/s\n", fit.lowest, fit.highest);
    return text + power_snippet(fit, name);
}

std::string speed_fit_json(const SpeedFit& fit, const std::string& name) {
    const auto object = [](const Interval95& found) {
        return nlohmann::ordered_json{{"value", found.value},
                                      {"uncertainty", found.uncertainty},
                                      {"interval_95", {found.low, found.high}}};
    };
    nlohmann::ordered_json json;
    json["at_speed_m_s"] = fit.at_speed;
    json["restitution"] = object(fit.value);
    json["exponent"] = object(fit.exponent);
    json["speeds_m_s"] = fit.speeds;
    json["single"] = fit.restitutions;
    json["material"] = name;
    json["snippet"] = power_snippet(fit, name);
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Plot speed_fit_plot(const SpeedFit& fit) {
    constexpr int kSteps = 100;
    Plot plot;
    plot.title = fmt::format("e = {:.4f} (v / {:.4g} m/s)^{{−{:.4f}}}", fit.value.value,
                             fit.at_speed, fit.exponent.value);
    Series band{.title = "95 %", .style = SeriesStyle::kBand, .color = 0};
    Series law{.title = "power law", .color = 0};
    const double from = 0.8 * fit.lowest, to = 1.1 * fit.highest;
    double least = 1, most = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double v = from * std::pow(to / from, static_cast<double>(i) / kSteps);
        const double part = std::exp(fit.covered * fit.relative_uncertainty(v));
        band.x.push_back(v);
        band.y.push_back(fit.law(v) / part);
        band.upper.push_back(std::min(1.0, fit.law(v) * part));
        law.x.push_back(v);
        law.y.push_back(fit.law(v));
        least = std::min(least, band.y.back());
        most = std::max(most, band.upper.back());
    }
    for (const double e : fit.restitutions) least = std::min(least, e), most = std::max(most, e);
    plot.x = {.label = "approach speed, m/s", .min = from, .max = to};
    plot.y = {.label = "restitution", .min = 0.98 * least, .max = 1.02 * most};
    plot.series = {std::move(band), std::move(law)};
    plot.series.push_back({.title = "drops",
                           .style = SeriesStyle::kPoints,
                           .x = fit.speeds,
                           .y = fit.restitutions,
                           .color = 1});
    return plot;
}

}  // namespace carom
