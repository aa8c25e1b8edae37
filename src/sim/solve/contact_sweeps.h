// Impacts and islands by Gauss-Seidel iterations (gauss_seidel.h): slower than ODE's direct solver
// where contacts are few, but they always end and keep momentum exactly, also where that one fails
// (chains of touching balls solved at once, contacts that support each other).
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

/// Impacts of one instant: Newton's law for all `contacts` at once, w+ >= e max(u, 0). Reads
/// normal, arms, restitution, friction and approach_speed (u, before the impact) of the contacts;
/// sets the velocities of the bodies and impulse and tangential_impulse of the contacts. Where it
/// does not converge within its bound, the bodies still approach a little; momentum is exact all
/// the same.
void solve_by_gauss_seidel(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts);

/// One step of an island: finds impulses with which each contact's separation speed reaches its
/// `targets` [m/s]. It starts from `pushes` [N s on the contact's ball], those of the step before,
/// so that a pile at rest keeps the solution that it has found; they are replaced by those of this
/// step. `bodies` have the velocities that they would have without contacts, and get those with
/// them. Ends after a bounded number of sweeps with what has been reached: the next step goes on
/// from it.
void solve_island_by_gauss_seidel(std::vector<ImpactBody>& bodies,
                                  const std::vector<SolverContact>& contacts,
                                  const std::vector<double>& targets, std::vector<Vec3>& pushes);

/// Of the bodies' centres, m/s: relative speeds are known to its rounding.
double fastest_centre(const std::vector<ImpactBody>& bodies);

}  // namespace carom
