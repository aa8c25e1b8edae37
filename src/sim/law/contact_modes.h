// Which contacts of linked balls press, and which of them slide or roll.
#pragma once

#include "sim/law/coupled_forces.h"

namespace carom {

/// A slip of this fraction of the speeds is none: it rolls, if friction holds it.
inline constexpr double kNoCoupledSlip = 1e-11;

/// A slip that has begun follows what drives it, and how that turns, while its direction is no more
/// off than this [rad]: later it has its own one. Both are the same then, but before it the
/// equation of the slip is stiff, and its direction is lost in rounding.
inline constexpr double kMostLag = 1e-9;

/// What drives a slip that begins may be less than 0 by so much of gravity: the end of the grip is
/// where it is 0.
inline constexpr double kLeastDrive = 1e-9;

/// The size of the speeds at hand, m/s.
double speed_of(const CoupledContacts& system, const CoupledState& state);

/// Finds for each contact whether it presses, and its mode: kIncipient where it had that mode, or
/// where friction cannot prevent a slip. Puts rounding right. False where no answer is consistent.
bool choose_modes(CoupledContacts& system, CoupledState& state);

/// Where rolling would take more friction than there is, a slip begins. False where it would not
/// grow.
bool begin_slip(CoupledContacts& system, const CoupledState& state, std::size_t contact);

/// A contact that does not press, but does not part either: nothing pulls it open, nor shut, by
/// more than rounding.
bool is_idle(const CoupledContacts& system, const CoupledContactForces& forces);
/// How far from both [m/s^2]; below 0 it is not idle any more.
double idle_margin(const CoupledContacts& system, const CoupledContactForces& forces);

/// How much an incipient slip is off its direction [rad], beyond what rounding makes of that.
double lag_of(const CoupledContactForces& forces, double speed);

}  // namespace carom
