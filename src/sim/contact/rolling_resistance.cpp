#include "sim/contact/rolling_resistance.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// A roll that is slower than this part of the rim's speed is what rounding left of none.
constexpr double kStillRolling = 1e-13;

/// (1 + k) R: the lever of rolling resistance, which makes its deceleration rolling N/m.
double lever_of(const ResistedBall& ball) {
    return ball.radius + ball.inertia / (ball.mass * ball.radius);
}

/// Takes up to `most` [N m s] of a turn about the unit vector `axis` from what `ball` turns faster
/// than `other`.
void slow_turn(const Vec3& axis, double most, const ResistedBall& ball, const ResistedBall* other) {
    double relative = ball.velocities->spin.dot(axis), inverse = 1 / ball.inertia;
    if (other != nullptr) {
        relative -= other->velocities->spin.dot(axis);
        inverse += 1 / other->inertia;
    }
    const double moment = std::clamp(relative / inverse, -most, most);
    ball.velocities->spin -= moment / ball.inertia * axis;
    if (other != nullptr) other->velocities->spin += moment / other->inertia * axis;
}

/// Takes up to `most` [m/s] from a roll on a surface along a unit vector.
void slow_roll(const Vec3& normal, const Vec3& along, double most, const ResistedBall& ball) {
    Velocities& v = *ball.velocities;
    const Vec3 axis = normal.cross(along);
    const double change = std::min(most, v.linear.dot(along));
    v.linear -= change * along;
    v.spin -= std::clamp(v.spin.dot(axis), 0.0, change / ball.radius) * axis;
}

}  // namespace

void resist(const Touch& contact, const StepImpulse& impulse, const ResistedBall& ball,
            const ResistedBall* other) {
    const ContactLaws& laws = *contact.laws;
    const Vec3& n = contact.normal;
    slow_turn(n, laws.pivoting * impulse.normal, ball, other);
    // The way in which the ball rolls: with its centre, or as it turns over the other one.
    const Vec3 roll = other == nullptr
                          ? tangential_part(ball.velocities->linear, n)
                          : Vec3((ball.velocities->spin - other->velocities->spin).cross(n));
    const double speed = roll.norm();
    // Taking all of it leaves a part of 1e-16, step by step, until products of it are no doubles.
    if (!(laws.rolling > 0) ||
        !(speed > kStillRolling * ball.radius * ball.velocities->spin.norm()))
        return;
    const Vec3 along = roll / speed;
    const double grip = contact.friction * impulse.normal - std::abs(impulse.tangential.dot(along));
    const double rolling = std::min(laws.rolling * impulse.normal, grip);
    if (!(rolling > 0)) return;
    if (other == nullptr) return slow_roll(n, along, rolling / ball.mass, ball);
    const double lever = 1 / (1 / lever_of(ball) + 1 / lever_of(*other));
    slow_turn(n.cross(along), rolling * lever, ball, other);
}

}  // namespace carom
