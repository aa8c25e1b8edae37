// Rolling resistance and pivoting of contacts that are stepped: what a step takes from velocities.
#pragma once

#include "sim/contact/contact_laws.h"

namespace carom {

/// A ball of a step; its velocities are changed.
struct ResistedBall {
    Velocities* velocities = nullptr;
    double radius = 0.1;   ///< m
    double mass = 1;       ///< kg
    double inertia = 0.4;  ///< kg m^2
};

/// What a contact did to its ball in a step [N s].
struct StepImpulse {
    double normal = 0;
    Vec3 tangential = Vec3::Zero();
};

/// Takes what a step's impulses allow from a ball that rolls on a surface, or from two that roll on
/// each other: `contact` gives laws, normal and friction, `other` is null for a surface. On a
/// surface velocity and spin are slowed together, so that no slip comes of it and what stands on a
/// slope goes on to do so; between two balls by the moment J L on their relative spin, with L of
/// 1/L = 1/((1 + k) R) + 1/((1 + k') R'). J is rolling times the normal impulse, or what friction
/// has left along the roll where that is less: a contact that slides along it is not resisted.
/// Never gives energy.
void resist(const Touch& contact, const StepImpulse& impulse, const ResistedBall& ball,
            const ResistedBall* other);

}  // namespace carom
