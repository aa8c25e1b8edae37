// The energy of a few balls over a step or a correction of their places, which must not rise.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/contact.h"

namespace carom {

class EnergyAccount {
  public:
    /// A ball [kg, kg m^2, m] under a constant `pull` [m/s^2], whose potential energy is 0 at
    /// `place` [m].
    void add(double mass, double inertia, double radius, const Vec3& place, const Vec3& pull);

    /// Kinetic and potential energy, J; one place and one pair of velocities per ball.
    double total(std::span<const Vec3> places, std::span<const Velocities> velocities) const;
    double kinetic(std::span<const Velocities> velocities) const;  ///< J
    /// Kinetic energy, and what a fall by its radius gives to each ball, J.
    double in_play(std::span<const Velocities> velocities) const;
    /// What all weigh on the way from one set of places to another, J: > 0 where they are lifted.
    double lift(std::span<const Vec3> from, std::span<const Vec3> to) const;
    /// The rate at which the energy's rate changes [W/s] while all accelerations [m/s^2, rad/s^2]
    /// are constant.
    double second_rate(std::span<const Vec3> accelerations, std::span<const Vec3> spin_rates) const;

    /// Whether the speeds have an excess of energy [J], or there is none beyond rounding.
    bool can_pay(double excess, std::span<const Velocities> velocities) const;
    /// Takes an excess of energy [J] from speeds relative to the centre of mass, if that suffices.
    /// False where there is none beyond rounding.
    bool take_away(double excess, std::span<Velocities> velocities) const;

  private:
    struct Body {
        double mass, inertia, radius;
        Vec3 place, pull;
    };

    std::vector<Body> bodies_;
};

/// How far an energy rises above what it had been before, J, on a parabola that loses `loss` from
/// one end to the other and stands, in its middle, `bulge` above or below their mean.
double rise_of_parabola(double loss, double bulge);

}  // namespace carom
