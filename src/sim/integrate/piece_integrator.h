// The next piece of a motion under a law (contact_ode.h): a polynomial through the solution, as
// long as its error allows, up to where the law ends.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/util/odeint_error.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "motion/motion.h"
#include "sim/integrate/contact_ode.h"
#include "sim/math/event_location.h"
#include "sim/math/hermite_fit.h"

namespace carom {

/// A piece turns a normal, and a ball itself, by no more than about this [rad]: there all series in
/// use converge fast.
inline constexpr double kLongestTurn = 0.7;

/// A piece takes away at most this part of a slip that is left: at its end the slip turns ever
/// faster, so that the pieces must shorten with it.
inline constexpr double kSlipPart = 0.6;

/// The energy of a piece deviates at a quarter of it from that of the integrated motion by less
/// than this fraction of what is in play; elsewhere by 2.2 times that.
inline constexpr double kEnergyError = 1e-13;

template <class Law>
struct IntegratedPiece {
    double seconds = 0;                     ///< 0 where something ends at once, or nothing gets on
    std::array<Piece, Law::kBalls> pieces;  ///< they start at time 0, and at the place 0
    typename Law::State end_state;
    int guard = -1;           ///< which one ends it; -1 where the law goes on
    bool given_up = false;    ///< the integrator makes no progress
    double next_seconds = 0;  ///< a good length for the piece after it
};

/// The longest time in which a ball at `spin` [rad/s], which changes by `rate` [rad/s^2], turns by
/// kLongestTurn.
inline double longest_turn(const Vec3& spin, const Vec3& rate) {
    double h = std::numeric_limits<double>::infinity();
    if (const double w = spin.norm(); w > 0) h = kLongestTurn / w;
    if (const double b = rate.norm(); b > 0) h = std::min(h, std::sqrt(2 * kLongestTurn / b));
    return h;
}

template <class Law>
class PieceIntegrator {
  public:
    using Ode = ContactOde<Law>;
    using Numbers = typename Ode::Numbers;
    using State = typename Law::State;
    using Forces = typename Law::Forces;

    PieceIntegrator(const Law& law, const State& start) : law_(law), ode_(law, start) {}

    /// From `now` [s] on. Tries `guess` [s] first; the piece ends at a time that is a double, so
    /// that no rounding of times adds up.
    IntegratedPiece<Law> next(double now, double guess) const {
        IntegratedPiece<Law> result;
        result.end_state = ode_.start();
        double h = to_a_double(now, guess);
        for (int tries = 0; tries < kMostTries && h > 0; ++tries) {
            try {
                Fit fitted = fit(h);
                if (fitted.error <= 1) {
                    result.next_seconds = h * growth_after(fitted.error);
                    double end = h;
                    result.guard = first_guard(fitted, end);
                    if (result.guard >= 0) {
                        end = to_a_double(now, end);
                        if (!(end > 0)) return result;
                        fitted = fit(end);
                    }
                    result.seconds = end;
                    result.pieces = fitted.pieces;
                    result.end_state = fitted.end;
                    return result;
                }
                h *= std::clamp(0.9 * std::pow(fitted.error, -1.0 / 9), 0.2, 0.9);
            } catch (const boost::numeric::odeint::odeint_error&) {
                h *= 0.25;
            }
            h = to_a_double(now, h);
        }
        result.given_up = true;
        return result;
    }

  private:
    /// A piece whose error is too large is shortened, at most so many times.
    static constexpr int kMostTries = 60;

    /// The solution over some seconds as pieces that start at 0, and how far they may be off.
    struct Fit {
        std::array<Piece, Law::kBalls> pieces;
        State end;
        double seconds = 0;
        double error = 0;  ///< as a multiple of what is allowed
    };

    /// The solution at one instant, with what its derivatives take.
    struct Instant {
        Numbers numbers;
        State state;
        Forces forces;

        Instant(const Ode& ode, const Numbers& y)
            : numbers(y), state(ode.state(y)), forces(ode.law().forces(state)) {}
        CurveNode place(const Law& law, std::size_t b) const {
            return {Ode::way(numbers, b), state[b].v, law.acceleration(forces, b)};
        }
        CurveNode turn(const Law& law, std::size_t b) const {
            const Vec3 u = Ode::turn(numbers, b);
            return {u, turn_rate(u, state[b].w),
                    turn_second_rate(u, state[b].w, law.spin_rate(forces, b))};
        }
    };

    static double growth_after(double error) {
        return std::min(2.0, 0.9 * std::pow(std::max(error, 1e-6), -1.0 / 9));
    }

    /// The largest duration not above h that leads from `now` to a double.
    static double to_a_double(double now, double h) {
        const double seconds = (now + h) - now;
        return seconds > 0 ? seconds : 0;
    }

    Fit fit(double h) const {
        const Instant begin(ode_, ode_.first());
        Numbers y = begin.numbers;
        ode_.advance(y, 0.25 * h);
        const Numbers quarter = y;
        ode_.advance(y, 0.25 * h);
        const Instant middle(ode_, y);
        ode_.advance(y, 0.5 * h);
        const Instant end(ode_, y);

        Fit result;
        result.end = end.state;
        result.seconds = h;
        for (std::size_t b = 0; b < law_.ball_count(); ++b) {
            const CurveNode place = begin.place(law_, b), turn = begin.turn(law_, b);
            Curve curve;
            curve.seconds = h;
            curve.position = curve_through(place, middle.place(law_, b), end.place(law_, b), h);
            curve.turn = curve_through(turn, middle.turn(law_, b), end.turn(law_, b), h);
            Piece& p = result.pieces[b];
            p.velocity = place.rate;
            p.acceleration = place.second;
            p.spin = turn.rate;
            p.spin_rate = turn.second;
            p.curve = OptionalCurve(curve);
            const double error = error_of(p, quarter, end.numbers, b);
            result.error = error >= 0 ? std::max(result.error, error)
                                      : std::numeric_limits<double>::infinity();
        }
        result.error = std::max(result.error, energy_error_of(result, quarter) / kEnergyError);
        return result;
    }

    /// Between its nodes a fit's error is largest near the quarters.
    double error_of(const Piece& p, const Numbers& quarter, const Numbers& end,
                    std::size_t b) const {
        const double s = 0.25 * p.curve->seconds, radius = law_.size();
        const Vec3 u = s * (p.spin + (0.5 * s) * p.spin_rate) + curve_value(p.curve->turn, 0.25);
        const double place_error = (p.position_at(s) - Ode::way(quarter, b)).norm();
        const double turn_error = (u - Ode::turn(quarter, b)).norm();
        const double speed_error = (p.velocity_at(s) - Ode::part(quarter, b, 1)).norm() +
                                   radius * (p.spin_at(s) - Ode::part(quarter, b, 2)).norm();
        return std::max({place_error / (Law::kFitError * (radius + Ode::way(end, b).norm())),
                         turn_error / (Law::kFitError * (1 + Ode::turn(end, b).norm())),
                         speed_error / (Law::kFitSpeedError * law_.speed())});
    }

    /// The same of the energy of all balls, as a fraction of what is in play.
    double energy_error_of(const Fit& fitted, const Numbers& quarter) const {
        State on_pieces, on_solution;  // places from the start on
        for (std::size_t b = 0; b < law_.ball_count(); ++b) {
            const Piece& p = fitted.pieces[b];
            const double s = 0.25 * fitted.seconds;
            on_pieces[b] = {p.position_at(s), p.velocity_at(s), p.spin_at(s)};
            on_solution[b] = {Ode::way(quarter, b), Ode::part(quarter, b, 1),
                              Ode::part(quarter, b, 2)};
        }
        return std::abs(law_.energy_error(on_pieces, on_solution));
    }

    State on_fit(const Fit& fitted, double s) const {
        State state;
        for (std::size_t b = 0; b < law_.ball_count(); ++b) {
            const Piece& p = fitted.pieces[b];
            state[b] = {ode_.start()[b].x + p.position_at(s), p.velocity_at(s), p.spin_at(s)};
        }
        return state;
    }

    /// The guard that turns negative first in (0, seconds], and when; -1 where none does. Looked
    /// for on the fit, located on the solution itself, to rounding.
    int first_guard(const Fit& fitted, double& seconds) const {
        std::array<State, kSamplesPerPiece + 1> states;
        std::array<Forces, kSamplesPerPiece + 1> forces;
        for (std::size_t j = 0; j <= kSamplesPerPiece; ++j) {
            states[j] = on_fit(fitted, sample_time(fitted.seconds, j));
            forces[j] = law_.forces(states[j]);
        }
        int first = -1;
        for (int i = 0; i < law_.guard_count(); ++i) {
            const EventLocation location(
                fitted.seconds, [&](std::size_t j) { return law_.guard(i, states[j], forces[j]); },
                [&](double s) {
                    const State state = on_fit(fitted, s);
                    return law_.guard(i, state, law_.forces(state));
                });
            // From the latest known instant before the crossing on, which comes nearer to it.
            double known = 0;
            Numbers there = ode_.first();
            const auto on_solution = [&](double s) {
                Numbers y = s >= known ? there : ode_.first();
                ode_.advance(y, s >= known ? s - known : s);
                const State state = ode_.state(y);
                const double value = law_.guard(i, state, law_.forces(state));
                if (value >= 0 && s > known) {
                    known = s;
                    there = y;
                }
                return value;
            };
            const std::optional<double> s =
                location.first_negative(on_solution, seconds, law_.skip_start(i));
            if (!s || *s >= seconds) continue;
            seconds = *s;
            first = i;
        }
        return first;
    }

    const Law& law_;
    Ode ode_;
};

}  // namespace carom
