// Integrates the motion of one ball on a curved contact, piece by piece, up to where its laws
// change. Boost.Odeint's Runge-Kutta-Fehlberg method of order 8 steps, with error control.
#pragma once

#include "motion/motion.h"
#include "sim/law/single_contact.h"

namespace carom {

/// Why a piece ends.
enum class SingleEnd {
    kNone,        ///< it is long enough; the same laws go on
    kLiftOff,     ///< the normal force has reached 0 (see lift_off_threshold())
    kFeature,     ///< another feature of the surface is met
    kSlipEnds,    ///< no slip is left
    kSlipGrows,   ///< an incipient slip now has its own direction
    kGripEnds,    ///< friction cannot hold the rolling any more
    kRollEnds,    ///< rolling resistance has stopped it
    kRollGrows,   ///< a roll that has begun now has its own direction
    kPivotEnds,   ///< no spin about the normal is left
    kPivotSlips,  ///< the turning normal gives it one again
    kGivenUp      ///< the integrator makes no progress from here
};

struct SinglePiece {
    double seconds = 0;  ///< 0 when something ends at once
    Vec3 acceleration = Vec3::Zero();
    Vec3 spin_rate = Vec3::Zero();
    Curve curve;
    ContactState end_state;
    SingleEnd end = SingleEnd::kNone;
    double next_seconds = 0;  ///< a good length for the piece after it
};

/// Positions of a piece deviate from the integrated ones by less than this fraction of the ball's
/// radius, or of the way; turns by less than this [rad].
inline constexpr double kCurveError = 2e-14;

/// Velocities of a piece, as a fraction of the ball's speeds.
inline constexpr double kCurveSpeedError = 1e-12;

/// The state after `seconds` on the same feature and by the same laws, right to 1e-14 a step.
ContactState integrate(const SingleContact& contact, ContactMode mode, const ContactState& state,
                       double seconds);

/// The next piece of a motion that is at `state` at `now` [s]. `guess` [s] is the next_seconds of
/// the piece before, 0 at the beginning of a phase. The piece ends at a time that is a double, so
/// that no rounding of times adds up. `settled`: something ended at once again and again; go on
/// until it is past. Where the integrator makes no progress the piece has no length: a slip that
/// would be over within a nanosecond then ends at once, without a change of the momentum that
/// friction cannot change; anything else is kGivenUp.
SinglePiece next_piece(const SingleContact& contact, ContactMode mode, const ContactState& state,
                       double now, double guess, bool settled);

}  // namespace carom
