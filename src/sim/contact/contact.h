// One touching pair of a step: what collision detection found, and what the solver made of it.
#pragma once

#include "core/types.h"
#include "motion/motion.h"

namespace carom {

struct ContactLaws;  // contact_laws.h

/// How a ball touches another ball or a surface. World frame, SI units.
struct Touch {
    // From collision detection.
    Vec3 normal = Vec3::UnitZ();  ///< unit, towards the ball
    double depth = 0;         ///< of the real surfaces, m; negative for a gap (at most kTouch r)
    Vec3 arm = Vec3::Zero();  ///< from the centre of the ball to where forces act, m
    Vec3 arm_other = Vec3::Zero();  ///< from the centre of the other ball; zero for a surface
    Vec3 point = Vec3::Zero();      ///< on the surface that is met; between two balls, the middle
    /// Where it depends on the approach speed: its limit for slow ones, until the impact is solved.
    double restitution = 1;
    double friction = 0;
    const ContactLaws* laws = nullptr;  ///< of the pair; null for none but these two numbers

    // From the velocities before the step.
    double approach_speed = 0;  ///< along the normal, m/s; negative when they separate
    Vec3 slip = Vec3::Zero();   ///< tangential velocity of the ball at the contact over the other's
    bool impact = false;        ///< approach speed above the method's threshold
    bool alone = true;          ///< the only contact of its island

    // From the step.
    double separation_speed = 0;  ///< along the normal, m/s; negative when they still approach
    Vec3 slip_after = Vec3::Zero();
    double impulse = 0;             ///< along the normal, N s
    double tangential_impulse = 0;  ///< N s, >= 0
};

/// A touch of two things of the scene. Of two balls, `ball` is the one that the scene names first.
struct Contact : Touch {
    int ball = -1;
    Partner other;
};

/// Centre velocity and spin of a ball, world axes.
struct Velocities {
    Vec3 linear = Vec3::Zero();
    Vec3 spin = Vec3::Zero();
};

/// What is left of `v` along the surface with this unit normal.
inline Vec3 tangential_part(const Vec3& v, const Vec3& normal) {
    return v - v.dot(normal) * normal;
}

/// Velocity of the ball's material point at the contact minus the other's [m/s].
inline Vec3 relative_velocity(const Touch& contact, const Velocities& ball,
                              const Velocities& other) {
    return ball.linear + ball.spin.cross(contact.arm) -
           (other.linear + other.spin.cross(contact.arm_other));
}

}  // namespace carom
