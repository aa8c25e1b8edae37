// Vertical bounces in still air with a constant drag coefficient, in closed form.
#pragma once

#include "scene/scene.h"

namespace carom {

/// With V the terminal speed and q = V^2/2g: a fall from h ends with V sqrt(1 - exp(-h/q)); what
/// leaves with u rises for V/g arctan(u/V) to q ln(1 + (u/V)^2), falls for V/g arsinh(u/V), and is
/// back with u / sqrt(1 + (u/V)^2). (Integrals of v' = -g -+ g (v/V)^2.)
class FallInAir {
  public:
    /// A ball of this radius [m], mass [kg] and constant drag coefficient above 0; buoyancy lessens
    /// `gravity` [m/s^2]. Failure(kInput) for a ball that the air carries.
    FallInAir(const Air& air, double radius, double mass, double drag, double gravity);

    double terminal_speed() const { return terminal_; }  ///< m/s
    /// At the end of a fall [m], m/s.
    double impact_speed(double drop) const;
    /// Of a drop and its rebound [m].
    double restitution(double drop, double rebound) const;
    /// Seconds from an impact to the next of what leaves with `speed` [m/s], and their change with
    /// it [s^2/m].
    double interval(double speed) const;
    double interval_rate(double speed) const;
    /// The speed that gives an interval [s].
    double speed_of(double interval) const;
    /// The part of its speed that a ball has left when it is back.
    double kept_part(double speed) const;

  private:
    double gravity_, terminal_;
};

}  // namespace carom
