// The balls of the method `exact` between two events: each has its own clock and its current piece.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"
#include "sim/contact.h"
#include "sim/restitution.h"
#include "sim/time_of_impact.h"

namespace carom {

/// A ball, from piece.start on.
struct ExactBall {
    Piece piece;
    std::uint64_t stamp = 0;  ///< changes with every new piece: predictions know what they rest on
    int surface = -1;         ///< of its lasting contact, -1 in flight
    EventKind kind = EventKind::kLeave;  ///< of the lasting contact: kSlide, kRoll or kRest
    Vec3 normal = Vec3::UnitZ();         ///< of the lasting contact
    double phase_end = std::numeric_limits<double>::infinity();  ///< s, when the piece must change
    bool leaves_at_end = false;  ///< the phase ends because the face does
    /// s, when the row of the lasting contact is due: at the end of its bouncing series.
    double row_due = std::numeric_limits<double>::infinity();
};

/// Scene, balls and the geometry of who touches whom.
class ExactWorld {
  public:
    explicit ExactWorld(const Scene& scene);

    const Scene& scene;
    PairTable pairs;
    std::vector<ExactBall> balls;

    ExactBall& ball(int i) { return balls[static_cast<std::size_t>(i)]; }
    const ExactBall& ball(int i) const { return balls[static_cast<std::size_t>(i)]; }
    const Ball& body(int i) const { return scene.balls[static_cast<std::size_t>(i)]; }
    const Surface& surface(int i) const { return scene.surfaces[static_cast<std::size_t>(i)]; }
    BallState state(int i, double t) const { return ball(i).piece.at(t); }
    /// The path of a ball's centre from t on.
    Path path(int i, double t) const;
    std::string name(const Partner& partner) const;

    /// Two things touch when their gap is not above the rounding of their places.
    double touch_tolerance(const Vec3& a, const Vec3& b, double size) const;
    /// The contact of ball i with a partner at t, as geometry has it; of two balls, the scene's
    /// first one is `ball`.
    Contact contact_at(int i, const Partner& partner, double t) const;
    bool touches(const Contact& contact, double t) const;
};

/// Relative speed along the normal at which two touching bodies count as neither approaching nor
/// separating: rounding of their velocities.
inline constexpr double kStillFraction = 1e-13;

}  // namespace carom
