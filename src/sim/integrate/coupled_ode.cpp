#include "sim/integrate/coupled_ode.h"

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

namespace carom {

namespace {

namespace odeint = boost::numeric::odeint;

/// Errors of one step, as in Course: ten times as much, since forces from a system of equations
/// are less smooth by their rounding.
constexpr double kStepError = 1e-13;

/// Evaluations of the laws in a part of a piece; where more are needed a shorter piece is.
constexpr int kMostEvaluations = 1'000;

void set_part(LinkedNumbers& y, std::size_t ball, std::size_t i, const Vec3& v) {
    for (std::size_t k = 0; k < 3; ++k) y[12 * ball + 3 * i + k] = v[static_cast<Eigen::Index>(k)];
}

}  // namespace

LinkedNumbers LinkedCourse::first() const {
    LinkedNumbers y{};
    for (std::size_t b = 0; b < system_.ball_count; ++b) {
        set_part(y, b, 1, start_[b].v);
        set_part(y, b, 2, start_[b].w);
    }
    return y;
}

LinkedState LinkedCourse::state(const LinkedNumbers& y) const {
    LinkedState s;
    for (std::size_t b = 0; b < system_.ball_count; ++b)
        s[b] = {start_[b].x + part(y, b, 0), part(y, b, 1), part(y, b, 2)};
    return s;
}

void LinkedCourse::advance(LinkedNumbers& y, double seconds) const {
    if (!(seconds > 0)) return;
    // Its room for intermediate values is copied before it is filled; static, it starts as 0.
    static const odeint::runge_kutta_fehlberg78<LinkedNumbers> kStepper;
    auto stepper = odeint::make_controlled(0.01 * kStepError * system_.smallest_radius(),
                                           kStepError, kStepper);
    int evaluations = 0;
    const auto rates = [this, &evaluations](const LinkedNumbers& now, LinkedNumbers& rate, double) {
        if (++evaluations > kMostEvaluations)
            throw odeint::no_progress_error("too many steps in a piece");
        const LinkedState s = state(now);
        const LinkedForces f = forces(s);
        rate.fill(0);
        for (std::size_t b = 0; b < system_.ball_count; ++b) {
            set_part(rate, b, 0, s[b].v);
            set_part(rate, b, 1, f.acceleration[b]);
            set_part(rate, b, 2, f.spin_rate[b]);
            set_part(rate, b, 3, turn_rate(part(now, b, 3), s[b].w));
        }
    };
    odeint::integrate_adaptive(stepper, rates, y, 0.0, seconds, seconds);
}

}  // namespace carom
