// From measured drops to a coefficient of restitution, as `carom fit` does.
#pragma once

#include <carom/export.h>

#include <optional>
#include <string>
#include <vector>

CAROM_NAMESPACE_BEGIN

struct Fit {
    double restitution = 0;
    std::optional<double> uncertainty{};  ///< standard
    std::optional<double> low{}, high{};  ///< of the interval of 95 %
    double distance_per_velocity = 0;     ///< x / v of the virtual body, s
    std::string material{};               ///< lines of YAML to paste into a scene
};

/// Heights of the ball's bottom [m]; one rebound for each drop, or several from one height.
/// Throws Error for heights that no bouncing ball has.
CAROM_API Fit fit_drops(const std::vector<double>& drops, const std::vector<double>& rebounds,
                        double constant = 4, double velocity = 5,
                        std::optional<double> reading_error = {});
/// Times between successive bounces, in order [s].
CAROM_API Fit fit_intervals(const std::vector<double>& intervals, double constant = 4,
                            double velocity = 5, std::optional<double> reading_error = {});

CAROM_NAMESPACE_END
