// What a scene says of the air and of how balls fly in it. SI units.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#include "core/monotone_curve.h"
#include "core/types.h"

namespace carom {

struct Air {
    double density = 1.225;      ///< kg/m^3
    double viscosity = 1.81e-5;  ///< dynamic, Pa s
    Vec3 wind = Vec3::Zero();    ///< m/s
    bool buoyancy = true;
};

/// The drag coefficient C_D of F = 1/2 rho A C_D u^2.
struct Drag {
    enum class Over {
        kNothing,  ///< `constant`
        kSphere,   ///< smooth_sphere_drag() of the Reynolds number 2 r u rho / viscosity
        kSpeed,    ///< `table` over u [m/s]
        kReynolds  ///< `table` over the Reynolds number
    };
    Over over = Over::kSphere;
    double constant = 0;
    std::shared_ptr<const MonotoneCurve> table;
};

/// The lift coefficient C_L of F = 1/2 rho A C_L u^2 along w x u, over the spin ratio S = r w / u,
/// w the part of the spin across u.
struct Lift {
    enum class Over {
        kNothing,    ///< `constant`
        kSpinRatio,  ///< C_L = S
        kTennis,     ///< 1 / (2 + 1/S)
        kBaseball,   ///< 1.12 S / (0.583 + 2.333 S)
        kTable       ///< `table` over S
    };
    Over over = Over::kNothing;
    double constant = 0;
    std::shared_ptr<const MonotoneCurve> table;
};

/// How one ball flies.
struct Flight {
    Drag drag;
    Lift lift;
    double spin_decay_s = std::numeric_limits<double>::infinity();  ///< time constant, s
};

/// The weight of the air that a ball [m, kg] displaces over its own.
double buoyant_part(const Air& air, double radius, double mass);

/// C_D of a smooth sphere up to a Reynolds number of 1e6, the drag crisis in it (F. A. Morrison, An
/// Introduction to Fluid Mechanics, 2013, p. 625); 24/Re as Re goes to 0.
double smooth_sphere_drag(double reynolds);

/// Density of moist air [kg/m^3] as an ideal gas: temperature [degrees Celsius], pressure [Pa],
/// relative humidity 0 ... 1, with the vapour pressure of A. L. Buck, "New equations for computing
/// vapor pressure", J. Appl. Meteorol. 20, 1981.
double air_density(double temperature_c, double pressure_pa, double humidity);

/// Dynamic viscosity of air [Pa s] (W. Sutherland, "The viscosity of gases and molecular force",
/// 1893, with 1.716e-5 Pa s at 273.15 K and 110.4 K).
double air_viscosity(double temperature_c);

}  // namespace carom
