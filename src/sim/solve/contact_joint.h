// A contact as ODE's contact joint: the one place that fills a dContact.
#pragma once

#include "sim/contact/contact.h"
#include "sim/solve/ode_handles.h"

namespace carom {

/// Constraint force mixing of contacts that share an island [m/(N s)]: with 0 redundant contacts
/// make the solver's matrix singular and a pile of 200 explodes; a single contact needs none, and
/// with 0 loses nothing of its coefficient.
inline constexpr double kIslandCfm = 1e-10;

/// Where the contact is and which way it pushes, without what it does along its normal (see below).
/// `center` is where ODE has the ball [m]. The first axis of friction lies along `slip` [m/s],
/// which makes ODE's friction box Coulomb's cone for one contact; any axes do where that is zero.
dContact contact_joint(const Touch& contact, const Vec3& center, const Vec3& slip);

/// The joint gives Newton's law with the contact's coefficient, whatever the approach speed.
void let_bounce(dContact& joint, double restitution);

/// The joint leaves minus `part` times `slip` [m/s] along its first axis of friction, as far as
/// friction does that.
void reverse_slip(dContact& joint, double part, const Vec3& slip);

/// The joint keeps the speed along the normal at or above `speed` [m/s] after the step, without
/// ODE's own correction of places.
void keep_above(dContact& joint, double speed);

/// For a contact that is not alone in its island: push and friction give way by kIslandCfm.
void share_island(dContact& joint);

/// Friction only along the first axis.
void resist_first_axis_only(dContact& joint);

}  // namespace carom
