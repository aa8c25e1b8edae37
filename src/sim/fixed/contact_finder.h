// The near callback: which pairs touch, and what their virtual bodies make of it.
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/restitution.h"
#include "sim/fixed/ode_world.h"

namespace carom {

/// Finds the touching pairs of `world` where the bodies stand now, sorted by ball, then partner
/// (surfaces first), so that the order does not depend on how ODE searches. Fills what comes "from
/// collision detection"; every pair here has at most one point, because balls and surfaces are
/// convex. `found` is cleared first.
void find_contacts(OdeWorld& world, const PairTable& pairs, std::vector<Contact>& found);

}  // namespace carom
