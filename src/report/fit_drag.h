// Restitution and drag together, from the times between many bounces in air.
#pragma once

#include <string>
#include <vector>

#include "report/fit_over_speed.h"

namespace carom {

/// A ball whose drag is asked for, in the air that it bounced in.
struct DragBall {
    Air air;
    double radius = 0, mass = 0;  ///< m, kg
    double gravity = 9.81;        ///< m/s^2
};

struct DragFit {
    Interval95 restitution;
    Interval95 drag;         ///< the coefficient C_D
    double terminal = 0;     ///< m/s
    double first_speed = 0;  ///< m/s: of the first rebound
    double density = 0;      ///< of the air, kg/m^3
    double residual_s = 0;   ///< root of the mean square, over the degrees of freedom
};

/// Least squares of the intervals T_n of bounces with one ε and one C_D: u_(n+1) = ε u_n / sqrt(1 +
/// (u_n / V)^2), T_n as FallInAir has it; all three of ε, V, u_0 are free. `reading_error` [s] is
/// the standard uncertainty of an interval; the intervals of 95 % are of the larger of it and the
/// scatter, as in fit_restitution().
///
/// Failure(kInput), with what would help, where the series does not carry it: fewer than four
/// intervals (five without a reading error), or a C_D that is not known to a half of itself.
DragFit fit_drag(const std::vector<double>& intervals_s, const DragBall& ball,
                 const std::optional<double>& reading_error);

std::string drag_fit_text(const DragFit& fit, const std::string& name);
std::string drag_fit_json(const DragFit& fit, const std::string& name);

}  // namespace carom
