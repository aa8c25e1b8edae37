#include "report/fall_in_air.h"

#include <cmath>
#include <numbers>

#include "core/failure.h"

namespace carom {

FallInAir::FallInAir(const Air& air, double radius, double mass, double drag, double gravity)
    : gravity_(gravity) {
    if (air.buoyancy) gravity_ *= 1 - buoyant_part(air, radius, mass);
    if (!(gravity_ > 0))
        throw Failure(FailureKind::kInput,
                      "the ball is lighter than the air that it displaces: it does not fall");
    const double area = std::numbers::pi * radius * radius;
    terminal_ = std::sqrt(2 * mass * gravity_ / (air.density * area * drag));
}

double FallInAir::impact_speed(double drop) const {
    const double q = terminal_ * terminal_ / (2 * gravity_);
    return terminal_ * std::sqrt(-std::expm1(-drop / q));
}

double FallInAir::restitution(double drop, double rebound) const {
    const double q = terminal_ * terminal_ / (2 * gravity_);
    return std::sqrt(std::expm1(rebound / q) / -std::expm1(-drop / q));
}

double FallInAir::interval(double speed) const {
    const double x = speed / terminal_;
    return terminal_ / gravity_ * (std::atan(x) + std::asinh(x));
}

double FallInAir::interval_rate(double speed) const {
    const double x = speed / terminal_, r = 1 + x * x;
    return (1 / r + 1 / std::sqrt(r)) / gravity_;
}

double FallInAir::speed_of(double interval_s) const {
    double speed = 0.5 * gravity_ * interval_s;  // in a vacuum: below the answer
    for (int i = 0; i < 60; ++i) {
        const double step = (interval_s - interval(speed)) / interval_rate(speed);
        speed += step;
        if (std::abs(step) <= 1e-15 * speed) break;
    }
    return speed;
}

double FallInAir::kept_part(double speed) const {
    const double x = speed / terminal_;
    return 1 / std::sqrt(1 + x * x);
}

}  // namespace carom
