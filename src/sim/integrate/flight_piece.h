// The next piece of a flight through air: a polynomial through the solution of its equation.
#pragma once

#include "motion/curve.h"
#include "sim/law/air_force.h"

namespace carom {

/// What sets out from where, for one piece.
struct FlightStart {
    Vec3 velocity = Vec3::Zero();  ///< m/s
    Vec3 spin = Vec3::Zero();      ///< rad/s
    Vec3 pull = Vec3::Zero();      ///< gravity less buoyancy, m/s^2
    double way = 0.1;              ///< m: places are right to some 1e-14 of this and of the piece
    double speed = 0;              ///< m/s: velocities to 1e-13 of this and of their own size
};

struct FlightPiece {
    double seconds = 0;
    Vec3 acceleration = Vec3::Zero();  ///< at the start, m/s^2
    Vec3 spin_rate = Vec3::Zero();     ///< at the start, rad/s^2
    Curve curve;
    double next_seconds = 0;  ///< a good length for the piece after it
};

/// From `now` [s] on, at most `longest` [s], first tried with `guess` [s]. The acceleration is a
/// polynomial of degree 6 that obeys the equation at Lobatto's seven nodes, which makes the place
/// one of degree 8 (Lobatto IIIA of order 12 at the end: E. Hairer, G. Wanner, Solving Ordinary
/// Differential Equations II, 1996, IV.5); it is found by Picard's iteration, and what is left of
/// the equation between the nodes says how long the piece may be. It ends at a time that is a
/// double. Failure(kRun) where no length will do.
FlightPiece flight_piece(const AirForce& air, const FlightStart& start, double now, double guess,
                         double longest);

}  // namespace carom
