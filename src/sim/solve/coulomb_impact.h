// Impacts of one instant at several contacts with friction.
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

/// The law. With u the approach speed of a contact before, w the relative velocity after, n its
/// normal and p its impulse, at all contacts at once:
///
///   Newton   w.n >= s e max(u, 0), p.n >= 0, one of them with equality;
///   Coulomb  |p_t| <= mu p.n, and either w_t = 0 (the contact grips), or p_t = -mu (p.n) w_t/|w_t|
///            (it slips): the round cone, against the slip that the impact leaves
///
/// (J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", 1988). s is 1,
/// unless no impulses obey both laws (a ball driven into a steep groove of high friction), or only
/// some above a hundred times the momentum that is there (near such a groove), or those that do add
/// kinetic energy (T. R. Kane's paradox, 1984). Then it is the largest of 0 ... 1 at which nothing
/// of this is so: the contacts give back less together, and friction keeps its cone. At s = 0 no
/// energy is ever gained: w.p <= 0 at each contact, and the change is w.p - p G p / 2.

/// Solves it to rounding. Reads normal, arms, restitution, friction and approach_speed of the
/// contacts; sets the velocities of the bodies and impulse and tangential_impulse of the contacts.
/// False, with nothing changed, where no solution was found.
bool solve_with_friction(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts);

/// Whether these impulses [N s on the contact's ball] obey the law with s = 1 for the bodies as
/// they were before.
bool obeys_friction(const std::vector<ImpactBody>& before,
                    const std::vector<SolverContact>& contacts, const std::vector<Vec3>& impulses);

}  // namespace carom
