// The laws of motion of a few balls that lasting contacts link.
#pragma once

#include "sim/law/coupled_contacts.h"

namespace carom {

/// Solves for all contact forces together: what presses keeps its distance,
///   n . (a - a') + n' . (v - v') = 0,
/// and where it rolls its slip s = v - v' - (R w + R' w') x n stays 0. What slides is held back by
/// mu N against its slip, an incipient slip against the direction in which it grows. Of forces that
/// the motion leaves undetermined (a ball that rolls in a groove) friction is next to none, and the
/// others are the smallest ones.
CoupledForces coupled_forces(const CoupledContacts& system, const CoupledState& state);

/// Puts rounding right: what presses at its distance, and moving neither along its normals nor,
/// where it rolls, by a slip; the heavier ball is moved less. Speeds along a normal that are no
/// rounding are lost, as in an inelastic impact.
void project(const CoupledContacts& system, CoupledState& state);

/// Of contacts whose last bounces are summed, takes away the speeds along the normals with what
/// friction the impacts would not have, where a contact gives that back: without_bounces() of one
/// ball (flat_contact.h). Others lose theirs without friction.
void land(const CoupledContacts& system, const std::array<bool, kMostCoupledContacts>& gives_back,
          CoupledState& state);

/// mu N - |f|: a contact rolls while this is >= 0 [N].
double grip_left(const CoupledContact& contact, const CoupledContactForces& forces);

/// Below this push [N] a contact has parted, a negative trifle as in lift_off_threshold() of one
/// ball.
double lift_off_threshold(const CoupledContacts& system, const CoupledContact& contact,
                          const CoupledState& state);

}  // namespace carom
