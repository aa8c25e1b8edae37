// Balls and their contacts as a solver sees them: under numbers of its own.
#pragma once

#include "sim/contact/contact.h"

namespace carom {

struct ImpactBody {
    Vec3 position = Vec3::Zero();  ///< m
    Velocities velocities;
    double mass = 1;       ///< kg
    double inertia = 0.4;  ///< kg m^2, about any axis
    /// m/s^2: what air does to it, beside gravity, all through a step.
    Vec3 air = Vec3::Zero();
};

/// A touch of two of a solver's bodies, or of one and a surface. Balls of the scene have other
/// numbers (Contact): neither passes for the other.
struct SolverContact : Touch {
    int body = -1;
    int other_body = -1;  ///< -1 for a surface

    SolverContact() = default;
    SolverContact(const Touch& touch, int of_body, int of_other_body)
        : Touch(touch), body(of_body), other_body(of_other_body) {}
    bool on_surface() const { return other_body < 0; }
};

}  // namespace carom
