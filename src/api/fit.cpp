#include "report/fit.h"

#include <carom/fit.h>
#include <fmt/format.h>

#include "api/inner.h"

namespace carom::v1 {

namespace {

Fit fitted(const Measurements& measured, double constant, double velocity,
           std::optional<double> reading_error) {
    return translated([&] {
        if (!(constant > 0) || !(velocity > 0))
            throw Error("constant and velocity must be above 0");
        FitOptions options;
        options.reading_error = reading_error;
        const RestitutionFit fit = fit_restitution(measured, options);
        const VirtualBodyLine line = virtual_body_line(fit.restitution, constant, velocity);
        return Fit{fit.restitution, fit.uncertainty, fit.low,
                   fit.high,        line.ratio_s,    material_snippet("measured", line)};
    });
}

}  // namespace

Fit fit_drops(const std::vector<double>& drops, const std::vector<double>& rebounds,
              double constant, double velocity, std::optional<double> reading_error) {
    if (drops.empty() || (drops.size() != 1 && drops.size() != rebounds.size()))
        throw Error(
            fmt::format("{} drops and {} rebounds: one rebound for each drop, or several "
                        "from one height",
                        drops.size(), rebounds.size()));
    Measurements measured;
    for (std::size_t i = 0; i < rebounds.size(); ++i)
        measured.drops.push_back({drops.size() == 1 ? drops.front() : drops[i], rebounds[i],
                                  fmt::format("measurement {}", i + 1)});
    return fitted(measured, constant, velocity, reading_error);
}

Fit fit_intervals(const std::vector<double>& intervals, double constant, double velocity,
                  std::optional<double> reading_error) {
    Measurements measured;
    measured.intervals_s = intervals;
    return fitted(measured, constant, velocity, reading_error);
}

}  // namespace carom::v1
