// One step of a large island, solved by sweeping over its contacts.
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

/// Finds impulses that only push, so that each contact's separation speed reaches its `targets`
/// [m/s], with Coulomb's true cone: projected Gauss-Seidel over the impulses (J. J. Moreau,
/// "Unilateral contact and dry friction in finite freedom dynamics", 1988). It starts from `pushes`
/// [N s on the contact's ball], those of the step before, so that a pile at rest keeps the solution
/// that it has found; they are replaced by those of this step.
/// `bodies` have the velocities that they would have without contacts, and get those with them.
/// Ends after a bounded number of sweeps with what has been reached: the next step goes on from it.
void solve_island_by_gauss_seidel(std::vector<ImpactBody>& bodies,
                                  const std::vector<Contact>& contacts,
                                  const std::vector<double>& targets, std::vector<Vec3>& pushes);

}  // namespace carom
