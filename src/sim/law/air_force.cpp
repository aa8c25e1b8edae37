#include "sim/law/air_force.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace carom {

AirForce::AirForce(const Air& air, const Ball& ball)
    : drag_(ball.flight.drag),
      lift_(ball.flight.lift),
      drags_(drag_.over != Drag::Over::kNothing || drag_.constant != 0),
      lifts_(lift_.over != Lift::Over::kNothing || lift_.constant != 0),
      wind_(air.wind),
      radius_(ball.radius),
      per_speed_(0.5 * air.density * std::numbers::pi * ball.radius * ball.radius / ball.mass),
      reynolds_(2 * ball.radius * air.density / air.viscosity),
      spin_decay_(1 / ball.flight.spin_decay_s) {
    if (air.buoyancy) buoyant_part_ = carom::buoyant_part(air, ball.radius, ball.mass);
}

double AirForce::drag_coefficient(double speed) const {
    switch (drag_.over) {
        case Drag::Over::kNothing:
            return drag_.constant;
        case Drag::Over::kSphere:
            return smooth_sphere_drag(reynolds_ * speed);
        case Drag::Over::kSpeed:
            return drag_.table->at(speed);
        case Drag::Over::kReynolds:
            return drag_.table->at(reynolds_ * speed);
    }
    return 0;
}

double AirForce::lift_coefficient(double s) const {
    switch (lift_.over) {
        case Lift::Over::kNothing:
            return lift_.constant;
        case Lift::Over::kSpinRatio:
            return s;
        case Lift::Over::kTennis:
            return s / (2 * s + 1);
        case Lift::Over::kBaseball:
            return 1.12 * s / (0.583 + 2.333 * s);
        case Lift::Over::kTable:
            return lift_.table->at(s);
    }
    return 0;
}

Vec3 AirForce::through_air(const Vec3& u, const Vec3& w) const {
    const double speed = u.norm();
    if (!(speed > 0)) return Vec3::Zero();
    Vec3 a = Vec3::Zero();
    if (drags_) a = (-per_speed_ * drag_coefficient(speed) * speed) * u;
    if (!lifts_) return a;
    const Vec3 across = w.cross(u);  // as long as u times the spin across it
    const double size = across.norm();
    if (!(size > 0)) return a;
    const double lift = lift_coefficient(radius_ * size / (speed * speed));
    return a + (per_speed_ * lift * speed * speed / size) * across;
}

double AirForce::until_still(const Vec3& v, const Vec3& w, const Vec3& pull) const {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    constexpr double kAlong = 1e-12;
    const Vec3 u = v - wind_;
    const double speed = u.norm(), g = pull.norm();
    if (drag_.over != Drag::Over::kNothing || !(g > 0) || !(-u.dot(pull) > 0)) return kNever;
    if (u.cross(pull).norm() > kAlong * speed * g) return kNever;
    if (lifts_ && w.cross(u).norm() > 0) return kNever;
    const double k = per_speed_ * drag_.constant;
    if (!(k > 0)) return speed / g;
    const double terminal = std::sqrt(g / k);
    return terminal / g * std::atan(speed / terminal);
}

}  // namespace carom
