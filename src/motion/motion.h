// Motion is a function of time: per ball a list of pieces, and the events between them.
// The film, the CSV files and the figures all evaluate it, at any instant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"
#include "motion/curve.h"

namespace carom {

/// Position [m], velocity [m/s], orientation (world from ball) and spin [rad/s, world axes].
struct BallState {
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Quat orientation = Quat::Identity();
    Vec3 spin = Vec3::Zero();
};

/// A polynomial piece: from `start` to the next piece's start, with s = t - start,
///   position    p + v s + a s^2 / 2
///   spin        w + b s
///   orientation exp(w s + b s^2 / 2 - w x b s^3 / 12) q
/// The last is exact where b is parallel to w or one of them is 0, otherwise the fourth-order
/// Magnus series of q' = spin q / 2, good for s so short that |w|^2 |w x b| s^5 / 720 is (Blanes,
/// Casas, Oteo, Ros, "The Magnus expansion and some of its applications", Physics Reports 470,
/// 2009).
///
/// A piece with a curve is the numerical solution of a motion without closed form: the curve adds
/// higher powers of s to the position, and to the turn u of the orientation exp(u) q, which is then
/// w s + b s^2 / 2 plus those; the spin follows from it.
struct Piece {
    double start = 0;  ///< s
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 acceleration = Vec3::Zero();
    OptionalCurve curve = {};  ///< here, so that what a place takes lies together
    Quat orientation = Quat::Identity();
    Vec3 spin = Vec3::Zero();
    Vec3 spin_rate = Vec3::Zero();

    // t in seconds of the motion, not since start.
    BallState at(double t) const;
    Vec3 position_at(double t) const {
        const double s = t - start;
        const Vec3 parabola = position + s * (velocity + (0.5 * s) * acceleration);
        if (!curve) return parabola;
        return parabola + curve_value(curve->position, s / curve->seconds);
    }
    Vec3 velocity_at(double t) const {
        const double s = t - start;
        const Vec3 line = velocity + s * acceleration;
        if (!curve) return line;
        return line + curve_rate(curve->position, s / curve->seconds, curve->seconds);
    }
    Vec3 acceleration_at(double t) const {
        if (!curve) return acceleration;
        const double u = (t - start) / curve->seconds;
        return acceleration + curve_second_rate(curve->position, u, curve->seconds);
    }
    Vec3 spin_at(double t) const {
        const double s = t - start;
        return curve ? curved_spin(s) : Vec3(spin + s * spin_rate);
    }
    /// A bound of |acceleration| all over the piece, m/s^2.
    double largest_acceleration() const;

  private:
    Vec3 curved_turn(double s) const;
    Vec3 curved_spin(double s) const;
};

enum class EventKind { kImpact, kSlide, kRoll, kRest, kLeave };
const char* event_kind_name(EventKind kind);

/// Something met by a ball: another ball, or a surface.
struct Partner {
    bool is_surface = true;
    int index = -1;  ///< into Scene::balls or Scene::surfaces
    bool operator==(const Partner&) const = default;
};

/// One row of EVENTS.csv. Of two balls, `ball` is the one that the scene names first.
struct Event {
    double time = 0;
    int ball = -1;
    Partner other;
    EventKind kind = EventKind::kImpact;
    Vec3 point = Vec3::Zero();      ///< contact point, m
    Vec3 normal = Vec3::UnitZ();    ///< unit, towards `ball`
    double approach_speed = 0;      ///< m/s along the normal, >= 0; impacts only, as are all below
    double separation_speed = 0;    ///< m/s
    double restitution = 0;         ///< of the pair, as computed
    double impulse = 0;             ///< N s along the normal
    double tangential_impulse = 0;  ///< N s
};

/// A top of the gap under a ball between two impacts.
struct Peak {
    double time = 0;    ///< s
    double height = 0;  ///< m, gap between the ball and what it bounced from
};

/// The path of one ball: pieces in order of time, the first starting at 0.
class Trajectory {
  public:
    /// Starts must not decrease; a piece that starts where the last one does replaces it.
    void append(Piece piece);
    void reserve(std::size_t pieces) { pieces_.reserve(pieces); }
    BallState at(double t) const;
    const std::vector<Piece>& pieces() const { return pieces_; }
    /// May let pieces go that end before t: at() holds from there on. Costs little if called often.
    void let_go_before(double t);
    /// Index of the piece that holds at t: the last one with start <= t.
    std::size_t piece_index(double t) const;

  private:
    std::vector<Piece> pieces_;
    double last_start_ = 0;  ///< s, of the last piece: it is asked for when that is out of cache
};

struct Motion {
    double duration = 0;  ///< s
    std::vector<std::string> ball_names;
    std::vector<std::string> surface_names;
    std::vector<Trajectory> balls;         ///< in the scene's order
    std::vector<Event> events;             ///< in order of time
    std::vector<std::vector<Peak>> peaks;  ///< per ball, in order of time

    /// Fingerprint of all pieces and events: equal for equal motions, whatever the film rate.
    std::uint64_t hash() const;
};

}  // namespace carom
