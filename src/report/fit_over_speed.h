// A coefficient of restitution over the approach speed, from drops of several heights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/fit.h"

namespace carom {

/// An estimate with its standard uncertainty and the interval of 95 %.
struct Interval95 {
    double value = 0;
    double uncertainty = 0;
    double low = 0, high = 0;
};

/// e = value (v / at_speed)^(-exponent), the power law of the scene's materials.
struct SpeedFit {
    double at_speed = 0;  ///< m/s: the mean of the impacts' speeds, by logarithms
    Interval95 value;     ///< there, where it and the exponent err independently
    Interval95 exponent;
    std::vector<double> speeds;        ///< of the impacts, m/s
    std::vector<double> restitutions;  ///< of each drop
    double covered = 0;  ///< what 95 % is of a standard uncertainty: 1.96, or Student's t
    double lowest = 0, highest = 0;  ///< speeds
    double law(double speed) const;
    /// Standard uncertainty of ln law(speed).
    double relative_uncertainty(double speed) const;
};

/// Least squares of ln e over ln v, each drop weighted by its reading error where one is given
/// (of drop and rebound alike; a drop's error is in e and in v), else all alike. The uncertainty is
/// the larger of what the reading errors and what the scatter about the law make, as in
/// fit_restitution(). Failure(kInput) for fewer than two heights, for two drops without a reading
/// error, and for a law that no scene can have (an exponent of 1 or more).
SpeedFit fit_over_speed(const std::vector<MeasuredDrop>& drops, const FitOptions& options);

/// The result as YAML for people, JSON for programs, and as a plot of e over v.
std::string speed_fit_text(const SpeedFit& fit, const std::string& name);
std::string speed_fit_json(const SpeedFit& fit, const std::string& name);
Plot speed_fit_plot(const SpeedFit& fit);

}  // namespace carom
