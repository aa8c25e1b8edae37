#include "scene/air.h"

#include <cmath>
#include <numbers>

namespace carom {

namespace {

constexpr double kZeroCelsius = 273.15;       // K
constexpr double kGasConstantDry = 287.055;   // J/(kg K)
constexpr double kGasConstantVapour = 461.5;  // J/(kg K)

}  // namespace

double buoyant_part(const Air& air, double radius, double mass) {
    return air.density * (4.0 / 3 * std::numbers::pi * radius * radius * radius) / mass;
}

double smooth_sphere_drag(double re) {
    const double a = re / 5, b = re / 2.63e5, c = re / 1e6;
    // (Re/2.63e5)^-7.94 / (1 + (Re/2.63e5)^-8) without a power that overflows.
    const double crisis = std::pow(b, 0.06) / (1 + std::pow(b, 8));
    return 24 / re + 2.6 * a / (1 + std::pow(a, 1.52)) + 0.411 * crisis + 0.25 * c / (1 + c);
}

double air_density(double temperature_c, double pressure_pa, double humidity) {
    const double t = temperature_c, kelvin = t + kZeroCelsius;
    const double saturation = 611.21 * std::exp((18.678 - t / 234.5) * (t / (257.14 + t)));
    const double vapour = humidity * saturation;
    return (pressure_pa - vapour) / (kGasConstantDry * kelvin) +
           vapour / (kGasConstantVapour * kelvin);
}

double air_viscosity(double temperature_c) {
    const double kelvin = temperature_c + kZeroCelsius;
    return 1.716e-5 * std::pow(kelvin / kZeroCelsius, 1.5) * (kZeroCelsius + 110.4) /
           (kelvin + 110.4);
}

}  // namespace carom
