// Coefficients of restitution that depend on the approach speed.
#pragma once

#include <optional>
#include <utility>
#include <variant>

#include "core/monotone_curve.h"

namespace carom {

/// e = value (v / at_speed)^(-exponent), at most 1; exponent < 1. In the fully plastic limit the
/// exponent is 1/4 (K. L. Johnson, Contact Mechanics, 1985, section 11.5).
struct PowerRestitution {
    double value = 1;     ///< above 0, at most 1
    double at_speed = 1;  ///< m/s
    double exponent = 0;
};

/// e = 1 - gamma v^(1/5) + 3/5 gamma^2 v^(2/5), v in m/s; constant beyond its lowest point, 7/12.
/// (R. Ramirez, T. Poschel, N. V. Brilliantov, T. Schwager, "Coefficient of restitution of
/// colliding viscoelastic spheres", Phys. Rev. E 60, 4465, 1999.)
struct ViscoelasticRestitution {
    double gamma = 0;  ///< (s/m)^(1/5), >= 0
};

/// The first is measured: values over speeds [m/s].
using RestitutionLaw = std::variant<MonotoneCurve, PowerRestitution, ViscoelasticRestitution>;

/// The coefficient at an approach speed [m/s] >= 0; at 0 its limit.
double restitution_at(const RestitutionLaw& law, double speed);

/// Where the separation speed of an impact falls although the approach is faster.
struct FallingSeparation {
    double from = 0, to = 0;                        ///< approach speeds, m/s
    double separation_from = 0, separation_to = 0;  ///< m/s
};

/// The first such interval of one law, or of the product of two; none where the separation speed
/// never falls. Looks at the derivative at every point where a law changes its form and at some
/// hundred in between.
std::optional<FallingSeparation> falling_separation(const RestitutionLaw& law,
                                                    const RestitutionLaw* other = nullptr);

}  // namespace carom
