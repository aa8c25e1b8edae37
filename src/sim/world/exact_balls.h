// The balls of the method `exact` between two events: each has its own clock, its phase and its
// current piece.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "motion/motion.h"
#include "motion/motion_log.h"
#include "scene/scene.h"
#include "sim/collide/time_of_impact.h"
#include "sim/contact/contact.h"
#include "sim/law/air_force.h"

namespace carom {

/// What a ball is doing. ExactBalls::set_phase() alone changes it.
enum class Phase : std::uint8_t {
    kFlight,
    kFlat,          ///< a flat surface holds it: its motion has a closed form
    kIntegrated,    ///< any surface holds it, and its motion is integrated
    kIsland,        ///< in an island (links.h) that is integrated or stepped
    kIslandAsleep,  ///< in one that rests until something touches it
    kPile,          ///< a member of the pile (pile.h)
    kPileAsleep     ///< one that rests until something wakes it
};
inline bool has_island(Phase p) { return p == Phase::kIsland || p == Phase::kIslandAsleep; }
inline bool in_pile(Phase p) { return p == Phase::kPile || p == Phase::kPileAsleep; }
inline bool is_asleep(Phase p) { return p == Phase::kIslandAsleep || p == Phase::kPileAsleep; }

/// A ball, from piece.start on. What its neighbours ask for stands first, in two lines of cache.
struct alignas(64) ExactBall {
    std::uint64_t stamp = 0;  ///< changes with every new piece: predictions know what they rest on
    double radius = 0;        ///< m
    /// m/s: relative speeds below this are what its last impacts left of a zero.
    double rounding_speed = 0;
    int surface = -1;  ///< that holds it, -1 for none

    Phase phase() const { return phase_; }

  private:
    friend class ExactBalls;
    Phase phase_ = Phase::kFlight;

  public:
    bool leaves_at_end = false;  ///< of kFlat: it ends because the face does
    Piece piece;
    double mass = 0;            ///< kg
    double inertia_factor = 0;  ///< as in Ball
    int material = 0;
    EventKind kind = EventKind::kLeave;  ///< of the lasting contact: kSlide, kRoll or kRest
    Vec3 normal = Vec3::UnitZ();         ///< of the lasting contact
    double phase_end = std::numeric_limits<double>::infinity();  ///< s, when the piece must change
    std::uint64_t resolved = 0;  ///< the last instant at which an impact of it was resolved
    /// ODE steps its island: its gaps and speeds are known to what a step can tell.
    bool coarse = false;
    /// s, when the row of the lasting contact is due: at the end of its bouncing series.
    double event_due = std::numeric_limits<double>::infinity();
};

/// What those that pass by a ball ask first, in one line of cache: how it falls freely. Of one that
/// does anything else `radius` is negative. Its last digits may be older than those of the piece.
struct alignas(64) Glance {
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    double start = 0;    ///< s
    double radius = -1;  ///< m
    bool falls() const { return radius > 0; }
};

class ExactBalls {
  public:
    explicit ExactBalls(const Scene& scene);

    const Scene& scene;
    std::vector<ExactBall> balls;
    /// All pieces that balls have begun.
    MotionLog log;

    ExactBall& ball(int i) { return balls[static_cast<std::size_t>(i)]; }
    const ExactBall& ball(int i) const { return balls[static_cast<std::size_t>(i)]; }
    const Ball& body(int i) const { return scene.balls[static_cast<std::size_t>(i)]; }

    /// The weight of the air that a ball displaces over its own.
    double buoyant_part(int i) const { return air_.empty() ? 0 : air(i).buoyant_part(); }
    /// Gravity less buoyancy, m/s^2.
    Vec3 pull(int i) const { return (1 - buoyant_part(i)) * scene.simulation.gravity; }
    /// Whether there is air whose forces change with the ball's motion.
    bool feels_air(int i) const { return !air_.empty() && air(i).acts(); }
    bool spin_decays(int i) const { return !air_.empty() && air(i).spin_decay() > 0; }
    /// Only where the scene has air.
    const AirForce& air(int i) const { return air_[static_cast<std::size_t>(i)]; }
    /// What air does to a ball that moves like this, buoyancy too, m/s^2.
    Vec3 air_on(int i, const Velocities& moving) const {
        return air_.empty() ? Vec3(Vec3::Zero())
                            : Vec3(pull_on(i, moving) - scene.simulation.gravity);
    }
    /// pull() and what air does to a ball that moves like this, m/s^2.
    Vec3 pull_on(int i, const Velocities& moving) const {
        return air_.empty() ? scene.simulation.gravity
                            : Vec3(pull(i) + air(i).acceleration(moving.linear, moving.spin));
    }

    const Glance& glance(int i) const { return glances_[static_cast<std::size_t>(i)]; }
    /// Where one that falls is at t [s], but for roundings.
    Vec3 glimpse(int i, double t) const {
        const Glance& g = glance(i);
        const double s = t - g.start;
        return g.position + s * (g.velocity + (0.5 * s) * scene.simulation.gravity);
    }

    BallState state(int i, double t) const { return ball(i).piece.at(t); }
    /// The same without the orientation, which is what costs time.
    Vec3 position(int i, double t) const { return ball(i).piece.position_at(t); }
    Velocities velocities(int i, double t) const {
        const Piece& p = ball(i).piece;
        return {p.velocity_at(t), p.spin_at(t)};
    }
    /// The path of a ball's centre from t on.
    Path path(int i, double t) const {
        const Piece& p = ball(i).piece;
        return {p.position_at(t), p.velocity_at(t), p.acceleration_at(t)};
    }

    /// A ball's phase changes: what belongs to the one before is forgotten.
    void set_phase(int i, Phase phase);
    /// What the ball does from `now` [s] on, until it begins another piece. Throws Failure(kRun)
    /// where its state is not finite.
    void begin_piece(int i, double now, const BallState& at, const Vec3& acceleration,
                     const Vec3& spin_rate, OptionalCurve curve = {});
    /// Its piece goes on, but predictions that rest on it do not hold any more.
    void renew(int i) { ball(i).stamp = next_stamp_++; }

    /// Has a ball's memory on its way when it is looked at a little later.
    void fetch(int i) const {
        const auto* bytes = reinterpret_cast<const char*>(&ball(i));
        __builtin_prefetch(bytes);
        __builtin_prefetch(bytes + 64);
    }
    /// The same of what is glanced at.
    void fetch_glance(int i) const { __builtin_prefetch(&glance(i)); }

  private:
    std::vector<Glance> glances_;  ///< per ball
    std::vector<AirForce> air_;    ///< per ball; empty where the scene has no air
    std::uint64_t next_stamp_ = 1;
};

}  // namespace carom
