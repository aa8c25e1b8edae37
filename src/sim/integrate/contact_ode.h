// The motion of balls under a law as a differential equation, and its solutions from one state on.
// Boost.Odeint's Runge-Kutta-Fehlberg method of order 8 steps, with error control.
//
// A Law says what acts on up to kBalls balls:
//   kBalls, kStepError, kMostEvaluations, kFitError, kFitSpeedError    constants (see there)
//   State     an array of ContactState, Forces     what forces(state) gives
//   ball_count(), size() [m: the smallest radius], speed() [m/s: the size of the speeds at hand]
//   forces(state), acceleration(forces, ball) [m/s^2], spin_rate(forces, ball) [rad/s^2]
//   energy_error(a, b)    the energy of a less that of b, as a fraction of what is in play at
//                         b; of states whose places are ways since the start
//   guard_count(), guard(i, state, forces)    what must stay >= 0 for the law to hold
//   skip_start(i)    whether a guard that is not open at the start ends nothing there
#pragma once

#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cstddef>

#include "sim/integrate/turn_rate.h"
#include "sim/law/single_contact.h"

namespace carom {

template <class Law>
class ContactOde {
  public:
    using State = typename Law::State;
    using Forces = typename Law::Forces;
    /// Per ball the way since the start [m], v, w, and the turn since the start [rad].
    using Numbers = std::array<double, 12 * Law::kBalls>;

    ContactOde(const Law& law, const State& start) : law_(law), start_(start) {}

    static Vec3 part(const Numbers& y, std::size_t ball, std::size_t i) {
        const std::size_t at = 12 * ball + 3 * i;
        return {y[at], y[at + 1], y[at + 2]};
    }
    static Vec3 way(const Numbers& y, std::size_t ball) { return part(y, ball, 0); }
    static Vec3 turn(const Numbers& y, std::size_t ball) { return part(y, ball, 3); }

    Numbers first() const {
        Numbers y{};
        for (std::size_t b = 0; b < law_.ball_count(); ++b) {
            set_part(y, b, 1, start_[b].v);
            set_part(y, b, 2, start_[b].w);
        }
        return y;
    }
    State state(const Numbers& y) const {
        State s;
        for (std::size_t b = 0; b < law_.ball_count(); ++b)
            s[b] = {start_[b].x + part(y, b, 0), part(y, b, 1), part(y, b, 2)};
        return s;
    }

    /// Goes on from y. Throws odeint's own error when it makes no progress.
    void advance(Numbers& y, double seconds) const {
        namespace odeint = boost::numeric::odeint;
        if (!(seconds > 0)) return;
        // Its room for intermediate values is copied before it is filled; static, it starts as 0.
        static const odeint::runge_kutta_fehlberg78<Numbers> kStepper;
        // Errors of one step are relative to what the step changes; absolute ones a hundredth of
        // that at the ball's own size.
        auto stepper = odeint::make_controlled(0.01 * Law::kStepError * law_.size(),
                                               Law::kStepError, kStepper);
        int evaluations = 0;
        const auto rates = [this, &evaluations](const Numbers& now, Numbers& rate, double) {
            // Where more are needed a slip passes through 0 on the way, or hardly grows: a shorter
            // piece, then.
            if (++evaluations > Law::kMostEvaluations)
                throw odeint::no_progress_error("too many steps in a piece");
            const State s = state(now);
            const Forces f = law_.forces(s);
            rate.fill(0);
            for (std::size_t b = 0; b < law_.ball_count(); ++b) {
                set_part(rate, b, 0, s[b].v);
                set_part(rate, b, 1, law_.acceleration(f, b));
                set_part(rate, b, 2, law_.spin_rate(f, b));
                set_part(rate, b, 3, turn_rate(turn(now, b), s[b].w));
            }
        };
        odeint::integrate_adaptive(stepper, rates, y, 0.0, seconds, seconds);
    }

    const Law& law() const { return law_; }
    const State& start() const { return start_; }

  private:
    static void set_part(Numbers& y, std::size_t ball, std::size_t i, const Vec3& v) {
        for (std::size_t k = 0; k < 3; ++k)
            y[12 * ball + 3 * i + k] = v[static_cast<Eigen::Index>(k)];
    }

    const Law& law_;
    const State& start_;
};

}  // namespace carom
