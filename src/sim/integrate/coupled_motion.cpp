#include "sim/integrate/coupled_motion.h"

#include <algorithm>
#include <boost/numeric/odeint/util/odeint_error.hpp>
#include <cmath>
#include <limits>

#include "sim/integrate/coupled_ode.h"
#include "sim/law/contact_modes.h"
#include "sim/math/event_location.h"
#include "sim/math/hermite_fit.h"

namespace carom {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// As for one ball: how far a piece may turn a normal, or a ball [rad], and which part of a slip it
/// may take away.
constexpr double kLongestTurn = 0.7;
constexpr double kSlipPart = 0.6;

/// The first piece of a slip is no longer than so many of its times: explicit steps are.
constexpr double kFirstPiece = 20;

/// A piece whose error is too large is shortened, at most so many times.
constexpr int kMostTries = 60;

using Pieces = std::array<Piece, kMostLinkedBalls>;

/// A course over some seconds as pieces that start at 0, and how far they may be off.
struct Fit {
    Pieces pieces;
    double error = 0;  ///< as a multiple of what is allowed
};

/// The solution at one instant, with what its derivatives take.
struct Instant {
    LinkedNumbers numbers;
    LinkedState state;
    LinkedForces forces;

    Instant(const LinkedCourse& course, const LinkedNumbers& y)
        : numbers(y), state(course.state(y)), forces(course.forces(state)) {}
    CurveNode place(std::size_t b) const {
        return {part(numbers, b, 0), state[b].v, forces.acceleration[b]};
    }
    CurveNode turn(std::size_t b) const {
        const Vec3 u = part(numbers, b, 3);
        return {u, turn_rate(u, state[b].w), turn_second_rate(u, state[b].w, forces.spin_rate[b])};
    }
};

/// Between its nodes a fit's error is largest near the quarters.
double error_of(const Piece& p, const LinkedNumbers& quarter, std::size_t b, double s,
                double radius, double speed) {
    const Vec3 u = s * (p.spin + (0.5 * s) * p.spin_rate) + curve_value(p.curve->turn, 0.25);
    const Vec3 way = part(quarter, b, 0), turn = part(quarter, b, 3);
    const double speed_error = (p.velocity_at(s) - part(quarter, b, 1)).norm() +
                               radius * (p.spin_at(s) - part(quarter, b, 2)).norm();
    return std::max({(p.position_at(s) - way).norm() / (radius + way.norm()),
                     (u - turn).norm() / (1 + turn.norm()), speed_error / speed}) /
           kLinkedError;
}

Fit fit(const LinkedCourse& course, double h) {
    const Instant begin(course, course.first());
    LinkedNumbers y = begin.numbers;
    course.advance(y, 0.25 * h);
    const LinkedNumbers quarter = y;
    course.advance(y, 0.25 * h);
    const Instant middle(course, y);
    course.advance(y, 0.5 * h);
    const Instant end(course, y);

    Fit result;
    const double speed = speed_of(course.system(), course.start());
    for (std::size_t b = 0; b < course.system().ball_count; ++b) {
        const CurveNode place = begin.place(b), turn = begin.turn(b);
        Curve curve;
        curve.seconds = h;
        curve.position = curve_through(place, middle.place(b), end.place(b), h);
        curve.turn = curve_through(turn, middle.turn(b), end.turn(b), h);
        Piece& p = result.pieces[b];
        p.velocity = place.rate;
        p.acceleration = place.second;
        p.spin = turn.rate;
        p.spin_rate = turn.second;
        p.curve = OptionalCurve(curve);
        const double error =
            error_of(p, quarter, b, 0.25 * h, course.system().smallest_radius(), speed);
        result.error = error >= 0 ? std::max(result.error, error) : kInfinity;
    }
    return result;
}

/// The longest piece that its laws bear, before its error is known.
double longest_piece(const LinkedCourse& course, const LinkedForces& f) {
    const LinkedBalls& system = course.system();
    double h = kInfinity;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const LinkedContact& c = system.contacts[i];
        const LinkedContactForces& at = f.contacts[i];
        if (!c.presses) continue;
        h = std::min(h, kLongestTurn * std::sqrt(c.feature.distance / system.gravity.norm()));
        if (const double turning = at.normal_rate.norm(); turning > 0)
            h = std::min(h, kLongestTurn / turning);
        if (c.mode != CurvedMode::kSliding) continue;
        const double slip = at.slip.norm();
        const double slowing = -at.slip.dot(at.slip_rate) / slip;
        if (slowing > 0) h = std::min(h, kSlipPart * slip / slowing);
    }
    for (std::size_t b = 0; b < system.ball_count; ++b) {
        if (const double spin = course.start()[b].w.norm(); spin > 0)
            h = std::min(h, kLongestTurn / spin);
        if (const double rate = f.spin_rate[b].norm(); rate > 0)
            h = std::min(h, std::sqrt(2 * kLongestTurn / rate));
    }
    return h;
}

/// How fast the direction of a slip answers to what turns it, s: the smaller the slip, the stiffer.
double slip_time(const LinkedCourse& course, const LinkedForces& f) {
    const LinkedBalls& system = course.system();
    double shortest = kInfinity;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const LinkedContact& c = system.contacts[i];
        if (!c.presses || c.mode != CurvedMode::kSliding) continue;
        const double hold = f.contacts[i].friction.norm() * system.gravity.norm();
        if (hold > 0)
            shortest = std::min(shortest, f.contacts[i].slip.norm() * system.weight_at(c) / hold);
    }
    return shortest;
}

// ---- Where a piece ends
// --------------------------------------------------------------------------

/// What must stay >= 0 at one contact: its push, the room on its feature, its grip.
class LinkedGates {
  public:
    LinkedGates(const LinkedCourse& course, const Pieces& pieces, double h)
        : course_(course),
          pieces_(pieces),
          h_(h),
          speed_(speed_of(course.system(), course.start())) {
        for (std::size_t j = 0; j <= kGateLooks; ++j) {
            states_[j] = on_fit(gate_place(h, j));
            forces_[j] = course.forces(states_[j]);
        }
    }

    /// The first end of the piece, or none.
    void find(LinkedPiece& piece) const {
        piece.seconds = h_;
        const LinkedBalls& system = course_.system();
        for (std::size_t i = 0; i < system.contact_count; ++i) {
            const LinkedContact& c = system.contacts[i];
            if (!c.presses) {
                look(piece, i, LinkedEnd::kIdleEnds,
                     [&](const LinkedState&, const LinkedForces& f) {
                         return idle_room(system, f.contacts[i]);
                     });
                continue;
            }
            look(piece, i, LinkedEnd::kParts, [&](const LinkedState& s, const LinkedForces& f) {
                return f.contacts[i].push - least_push(system, c, s);
            });
            if (c.mode == CurvedMode::kRolling)
                look(piece, i, LinkedEnd::kGripEnds,
                     [&](const LinkedState&, const LinkedForces& f) {
                         return grip_left(c, f.contacts[i]);
                     });
            if (c.mode == CurvedMode::kIncipient)
                look(piece, i, LinkedEnd::kSlipGrows,
                     [&](const LinkedState&, const LinkedForces& f) {
                         const LinkedContactForces& at = f.contacts[i];
                         const double drive =
                             at.slip_rate.dot(at.direction) / system.gravity.norm();
                         return std::min(kMostLag - lag_of(at, speed_), drive + kLeastDrive);
                     });
            for (int k = 0; c.other < 0 && k < c.feature.gate_count; ++k)
                look(piece, i, LinkedEnd::kFeature, [&](const LinkedState& s, const LinkedForces&) {
                    const FeatureGate& gate = c.feature.gates[static_cast<std::size_t>(k)];
                    return gate.room(s[static_cast<std::size_t>(c.ball)].x);
                });
        }
    }

  private:
    template <class Gate>
    void look(LinkedPiece& piece, std::size_t contact, LinkedEnd end, const Gate& gate) const {
        const GateLooks looks(
            h_, [&](std::size_t j) { return gate(states_[j], forces_[j]); },
            [&](double s) {
                const LinkedState state = on_fit(s);
                return gate(state, course_.forces(state));
            });
        // From the latest instant before the crossing that is known on, which comes nearer to it.
        double known = 0;
        LinkedNumbers there = course_.first();
        const auto on_course = [&](double s) {
            LinkedNumbers y = s >= known ? there : course_.first();
            course_.advance(y, s >= known ? s - known : s);
            const LinkedState state = course_.state(y);
            const double value = gate(state, course_.forces(state));
            if (value >= 0 && s > known) {
                known = s;
                there = y;
            }
            return value;
        };
        const std::optional<double> s = looks.first_negative(on_course, piece.seconds, false);
        if (!s || *s >= piece.seconds) return;
        piece.seconds = *s;
        piece.end = end;
        piece.contact = contact;
    }

    LinkedState on_fit(double s) const {
        LinkedState state;
        for (std::size_t b = 0; b < course_.system().ball_count; ++b)
            state[b] = {course_.start()[b].x + pieces_[b].position_at(s), pieces_[b].velocity_at(s),
                        pieces_[b].spin_at(s)};
        return state;
    }

    const LinkedCourse& course_;
    const Pieces& pieces_;
    double h_;
    double speed_;
    std::array<LinkedState, kGateLooks + 1> states_;
    std::array<LinkedForces, kGateLooks + 1> forces_;
};

/// The largest duration not above h that leads from `now` to a double.
double to_a_double(double now, double h) {
    const double seconds = (now + h) - now;
    return seconds > 0 ? seconds : 0;
}

void take(const Fit& fitted, std::size_t balls, LinkedPiece& piece) {
    for (std::size_t b = 0; b < balls; ++b) {
        const Piece& p = fitted.pieces[b];
        piece.balls[b] = {p.acceleration, p.spin_rate, *p.curve};
    }
}

}  // namespace

LinkedPiece next_piece(const LinkedBalls& system, const LinkedState& state, double now,
                       double guess) {
    namespace odeint = boost::numeric::odeint;
    const LinkedCourse course(system, state);
    const LinkedForces forces = course.forces(state);
    LinkedPiece result;
    const double longest = longest_piece(course, forces);
    const double first = std::min(0.25 * longest, kFirstPiece * slip_time(course, forces));
    double h = to_a_double(now, std::min(longest, guess > 0 ? guess : first));
    for (int tries = 0; tries < kMostTries && h > 0; ++tries) {
        try {
            Fit fitted = fit(course, h);
            if (fitted.error <= 1) {
                LinkedGates(course, fitted.pieces, h).find(result);
                result.next_seconds =
                    h * std::min(2.0, 0.9 * std::pow(std::max(fitted.error, 1e-6), -1.0 / 9));
                if (result.end != LinkedEnd::kNone) {
                    result.seconds = to_a_double(now, result.seconds);
                    if (!(result.seconds > 0)) return result;
                    fitted = fit(course, result.seconds);
                }
                take(fitted, system.ball_count, result);
                return result;
            }
            h *= std::clamp(0.9 * std::pow(fitted.error, -1.0 / 9), 0.2, 0.9);
        } catch (const odeint::odeint_error&) {
            h *= 0.25;
        }
        h = to_a_double(now, h);
    }
    result.seconds = 0;
    return result;
}

}  // namespace carom
