// One contact between two bodies, as iterations over the impulses see it.
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

/// A contact, the masses that it feels, and the impulse that it has given so far.
struct ContactRow {
    /// `body` and `other_body` of the contact (unless a surface) index the bodies; the row keeps
    /// pointers to them and to the contact.
    ContactRow(std::vector<ImpactBody>& bodies, const SolverContact& contact, double target);

    ImpactBody* ball = nullptr;
    ImpactBody* other = nullptr;  ///< null for a surface
    const SolverContact* contact = nullptr;
    double target = 0;                ///< least speed along the normal afterwards, m/s
    Vec3 slip_target = Vec3::Zero();  ///< the slip that friction aims at, m/s
    double normal_mass = 0;           ///< kg: impulse per change of the speed along the normal
    double tangential_mass = 0;       ///< kg, the same across it, spin included
    double normal = 0;                ///< N s, >= 0
    Vec3 tangential = Vec3::Zero();   ///< N s

    /// Velocity of the ball's material point over the other's, m/s.
    Vec3 speed() const;
    /// The part along the normal, m/s: of a ball, spin has none.
    double speed_along() const;
    void push_along(double impulse) const;
    void push(const Vec3& impulse) const;
    /// The tangential impulse that friction allows of a wanted one.
    Vec3 within_cone(const Vec3& wanted) const;
    /// Begins with the impulse of an earlier solution.
    void start_from(const Vec3& impulse);
    /// Sets the contact right: Newton's law, then Coulomb's cone. Returns the largest change of
    /// speed that it needed, m/s.
    double relax();
};

}  // namespace carom
