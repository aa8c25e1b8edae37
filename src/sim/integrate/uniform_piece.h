// Linked balls whose forces do not change: their motion has a closed form.
#pragma once

#include <optional>

#include "sim/integrate/coupled_motion.h"

namespace carom {

/// A ball that rolls or slides straight on in a groove, along a wall or on two rails: no normal
/// turns, no slip changes its direction, no spin its axis. The piece goes on up to the end of a
/// slip or of a feature, at most for `horizon` seconds. None where anything turns.
std::optional<CoupledPiece> steady_piece(const CoupledContacts& system, const CoupledState& state,
                                         const CoupledForces& forces, double now, double horizon);

}  // namespace carom
