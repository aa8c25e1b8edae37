// Impacts of one instant, solved by sweeping over the contacts: slower than ODE's direct solver,
// but it always ends and keeps momentum exactly, also where that one fails (chains of touching
// balls solved at once, contacts that support each other).
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

/// Newton's law for all `contacts` at once, w+ >= e max(u, 0) with impulses that only push, and
/// Coulomb's true cone: projected Gauss-Seidel over the impulses (J. J. Moreau, "Unilateral contact
/// and dry friction in finite freedom dynamics", 1988). Reads normal, arms, restitution, friction
/// and approach_speed (u, before the impact) of the contacts; sets the velocities of the bodies and
/// impulse and tangential_impulse of the contacts. Where it does not converge within its bound, the
/// bodies still approach a little; momentum is exact all the same.
void solve_by_gauss_seidel(std::vector<ImpactBody>& bodies, std::vector<Contact>& contacts);

/// Of the bodies' centres, m/s: relative speeds are known to its rounding.
double fastest_centre(const std::vector<ImpactBody>& bodies);

}  // namespace carom
