// Contacts of a pile as Gauss-Seidel iterations see them (gauss_seidel.h): many bodies in many
// contacts, whose velocities are all that counts.
#pragma once

#include <vector>

#include "core/types.h"

namespace carom {

/// A ball as a pile sees it. Its spin stands as the speed of its rim, s = R w, so that the
/// velocity of its material point at a contact with the normal n (towards the ball) is v + n x s.
struct PileBody {
    Vec3 velocity = Vec3::Zero();  ///< m/s
    Vec3 rim = Vec3::Zero();       ///< R w, m/s
    double inverse_mass = 0;       ///< 1/kg; 0 for what does not move
    double inverse_spin = 0;       ///< R^2 / I, 1/kg
    int changed = 0;               ///< when a contact last changed it, for the sweeps
};

/// One contact: what it wants, and the impulse that it has given so far.
struct PileRow {
    int ball = -1;
    int other = -1;                  ///< -1 for a surface
    Vec3 normal = Vec3::UnitZ();     ///< unit, towards `ball`
    double friction = 0;             ///< Coulomb's mu
    double target = 0;               ///< least speed along the normal afterwards, m/s
    double push = 0;                 ///< along the normal, N s, >= 0
    Vec3 tangential = Vec3::Zero();  ///< N s
    // Set by the sweeps.
    double normal_mass = 0, tangential_mass = 0;  ///< kg
    int relaxed = 0;
};

/// How long to sweep.
struct PileSweeps {
    int most = 12;
    double still = 1e-6;  ///< m/s: smaller changes of a body do not call on its other contacts
};

/// Gauss-Seidel iterations from the impulses that the rows hold at the start. A contact is only
/// looked at again when one of its bodies has changed since.
void sweep_pile(std::vector<PileBody>& bodies, std::vector<PileRow>& rows,
                const PileSweeps& sweeps);

/// Velocity of `ball`'s material point minus the other's at the contact [m/s].
inline Vec3 relative_velocity(const PileRow& row, const std::vector<PileBody>& bodies) {
    const PileBody& a = bodies[static_cast<std::size_t>(row.ball)];
    if (row.other < 0) return a.velocity + row.normal.cross(a.rim);
    const PileBody& b = bodies[static_cast<std::size_t>(row.other)];
    return a.velocity - b.velocity + row.normal.cross(a.rim + b.rim);
}

/// The part of it along the normal, which spin has no say in.
inline double normal_speed(const PileRow& row, const std::vector<PileBody>& bodies) {
    const Vec3& v = bodies[static_cast<std::size_t>(row.ball)].velocity;
    if (row.other < 0) return v.dot(row.normal);
    return (v - bodies[static_cast<std::size_t>(row.other)].velocity).dot(row.normal);
}

}  // namespace carom
