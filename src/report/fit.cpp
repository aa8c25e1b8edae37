#include "report/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/check.h"
#include "report/fit_refusal.h"
#include "scene/virtual_body.h"

namespace carom {

namespace {

/// Bottom to bottom, m.
double rebound_of(const MeasuredDrop& drop, const FitOptions& options) {
    if (!(drop.drop_m > 0))
        refuse_fit(fmt::format("{}: a drop of {} m; it must be above 0", drop.where, drop.drop_m));
    if (!(drop.rebound_m > 0))
        refuse_fit(
            fmt::format("{}: a rebound of {} m; it must be above 0 (a ball that does not rebound "
                        "has `restitution: 0`)",
                        drop.where, drop.rebound_m));
    double rebound = drop.rebound_m;
    if (options.rebound_to == ReboundTo::kTop) {
        rebound -= options.diameter_m;
        if (!(rebound > 0))
            refuse_fit(
                fmt::format("{}: a rebound of {} m to the top of a ball of {} m: it has not left "
                            "the floor",
                            drop.where, drop.rebound_m, options.diameter_m));
    }
    if (rebound > drop.drop_m)
        refuse_fit(fmt::format("{}: a rebound of {} m is higher than the drop of {} m", drop.where,
                               rebound, drop.drop_m));
    return rebound;
}

/// Estimate, and squared standard uncertainties of types A and B.
struct Estimate {
    double value = 0;
    std::optional<double> repeats_squared, reading_squared;
    int degrees = 0;  ///< of freedom of the repeats
};

Estimate estimate_of_drops(const std::vector<MeasuredDrop>& drops, const FitOptions& options,
                           std::vector<double>& single) {
    const auto count = static_cast<double>(drops.size());
    double reading = 0;
    for (const MeasuredDrop& drop : drops) {
        const double rebound = rebound_of(drop, options);
        single.push_back(options.air ? options.air->restitution(drop.drop_m, rebound)
                                     : std::sqrt(rebound / drop.drop_m));  // Eq. 9
        if (!(single.back() <= 1))
            refuse_fit(
                fmt::format("{}: a coefficient of {:.4g}: in this air the ball would have to gain "
                            "energy; are radius, mass and drag those of the ball?",
                            drop.where, single.back()));
        // dε = ε/2 (dh/h - dH/H)
        const double error = options.reading_error.value_or(0);
        reading += std::pow(0.5 * single.back(), 2) *
                   (std::pow(error / rebound, 2) + std::pow(error / drop.drop_m, 2));
    }
    Estimate estimate;
    estimate.value = std::accumulate(single.begin(), single.end(), 0.0) / count;
    estimate.degrees = static_cast<int>(drops.size()) - 1;
    if (drops.size() > 1) {
        double squares = 0;
        for (const double e : single) squares += std::pow(e - estimate.value, 2);
        estimate.repeats_squared = squares / (count - 1) / count;
    }
    if (options.reading_error) estimate.reading_squared = reading / (count * count);
    return estimate;
}

Estimate estimate_of_intervals(const std::vector<double>& times, const FitOptions& options,
                               std::vector<double>& single) {
    if (times.size() < 2)
        refuse_fit("one interval between bounces is not enough: their ratio is the coefficient");
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!(times[i] > 0))
            refuse_fit(fmt::format("interval {}: {} s; it must be above 0", i + 1, times[i]));
    // The logarithms that fall by ln ε from bounce to bounce, and their change with a time [1/s].
    std::vector<double> logs, rates;
    double lost = 0;
    for (const double time : times) {
        const double speed = options.air ? options.air->speed_of(time) : time;
        logs.push_back(std::log(speed) - lost);
        rates.push_back(options.air ? 1 / (speed * options.air->interval_rate(speed)) : 1 / time);
        if (options.air) lost += std::log(options.air->kept_part(speed));
    }
    for (std::size_t i = 1; i < times.size(); ++i)
        single.push_back(options.air ? std::exp(logs[i] - logs[i - 1]) : times[i] / times[i - 1]);

    // Least squares of ln t_n over n: the slope is sum (n - mean) ln t_n / sum (n - mean)^2.
    const auto count = static_cast<double>(times.size());
    const double middle = 0.5 * (count - 1);
    double spread = 0, slope = 0, level = 0, reading = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double off = static_cast<double>(i) - middle;
        spread += off * off;
        slope += off * logs[i];
        level += logs[i] / count;
        reading += std::pow(off * options.reading_error.value_or(0) * rates[i], 2);
    }
    slope /= spread;
    if (slope > 0)
        refuse_fit(
            fmt::format("the intervals grow, by a factor of {:.4g} from bounce to bounce; those of "
                        "a bouncing ball shrink",
                        std::exp(slope)));
    double residuals = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
        residuals += std::pow(logs[i] - level - slope * (static_cast<double>(i) - middle), 2);
    Estimate estimate;
    estimate.value = times.size() == 2 ? single.front() : std::exp(slope);
    const double per_slope = estimate.value * estimate.value;  // dε = ε d(ln ε)
    estimate.degrees = static_cast<int>(times.size()) - 2;
    if (times.size() > 2)
        estimate.repeats_squared = per_slope * residuals / estimate.degrees / spread;
    if (options.reading_error) estimate.reading_squared = per_slope * reading / (spread * spread);
    return estimate;
}

}  // namespace

double student_t95(int degrees) {
    CAROM_CHECK(degrees, >=, 1);
    // P(|T| < t) as a finite sum (Abramowitz and Stegun, 26.7.3 and 26.7.4).
    const auto probability = [&](double t) {
        const double angle = std::atan(t / std::sqrt(degrees));
        const double cosine = std::cos(angle), sine = std::sin(angle);
        const bool odd = degrees % 2 == 1;
        double term = odd ? cosine : 1, sum = 0;
        for (int k = odd ? 1 : 0; k <= degrees - 2; k += 2) {
            sum += term;
            term *= cosine * cosine * (k + 1) / (k + 2);
        }
        return odd ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
    };
    double low = 0, high = 20;  // of one degree it is 12.7
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (probability(middle) < 0.95 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

RestitutionFit fit_restitution(const Measurements& measured, const FitOptions& options) {
    RestitutionFit fit;
    const Estimate estimate = measured.drops.empty()
                                  ? estimate_of_intervals(measured.intervals_s, options, fit.single)
                                  : estimate_of_drops(measured.drops, options, fit.single);
    fit.restitution = estimate.value;
    double coverage = kNormal95;
    if (estimate.reading_squared) {
        fit.from_reading = std::sqrt(*estimate.reading_squared);
        fit.uncertainty = fit.from_reading;
    }
    if (estimate.repeats_squared) {
        fit.from_repeats = std::sqrt(*estimate.repeats_squared);
        if (!fit.uncertainty || *fit.from_repeats > *fit.uncertainty) {
            fit.uncertainty = fit.from_repeats;
            coverage = student_t95(estimate.degrees);
        }
    }
    if (fit.uncertainty) {
        fit.low = std::max(0.0, fit.restitution - coverage * *fit.uncertainty);
        fit.high = std::min(1.0, fit.restitution + coverage * *fit.uncertainty);
    }
    return fit;
}

VirtualBodyLine virtual_body_line(double restitution, double constant, double velocity) {
    VirtualBodyLine line;
    line.constant = constant;
    line.ratio_s = virtual_body_for(restitution, constant).distance_m;
    line.point = {line.ratio_s * velocity, velocity};
    return line;
}

}  // namespace carom
