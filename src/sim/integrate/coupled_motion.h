// Integrates the motion of a few balls that lasting contacts link, piece by piece, up to where its
// laws change. Boost.Odeint's Runge-Kutta-Fehlberg method of order 8 steps, with error control.
#pragma once

#include "motion/motion.h"
#include "sim/law/coupled_forces.h"

namespace carom {

/// Why a piece ends, always at one contact.
enum class CoupledEnd {
    kNone,       ///< it is long enough; the same laws go on
    kParts,      ///< its normal force has reached 0 (see lift_off_threshold())
    kIdleEnds,   ///< it does not press, and opens or shuts
    kFeature,    ///< another feature of the surface is met
    kSlipGrows,  ///< an incipient slip now has its own direction
    kGripEnds    ///< friction cannot hold the rolling any more
};

struct CoupledPiece {
    struct OfBall {
        Vec3 acceleration = Vec3::Zero();
        Vec3 spin_rate = Vec3::Zero();
        Curve curve;
    };

    double seconds = 0;  ///< 0 when something ends at once
    bool curved = true;  ///< false: the curves are 0
    std::array<OfBall, kMostCoupledBalls> balls;
    CoupledEnd end = CoupledEnd::kNone;
    std::size_t contact = 0;  ///< where it ends
    double next_seconds = 0;  ///< a good length for the piece after it
};

/// Positions of a piece deviate from the integrated ones by less than this fraction of the
/// smallest radius, or of the way; turns by less than this [rad], velocities by this fraction of
/// the speeds.
inline constexpr double kCoupledError = 1e-12;

/// The next piece of a motion that is at `state` at `now` [s], where every contact has its mode
/// (contact_modes.h). `guess` [s] is the next_seconds of the piece before, 0 at the beginning. The
/// piece ends at a time that is a double; it has no length where something ends at once, or where
/// the integrator makes no progress.
CoupledPiece next_piece(const CoupledContacts& system, const CoupledState& state, double now,
                        double guess);

}  // namespace carom
