#include "sim/integrate/single_ode.h"

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

namespace carom {

namespace {

namespace odeint = boost::numeric::odeint;

/// Errors of one step, relative to what the step changes; absolute ones a hundredth of that at the
/// ball's own size.
constexpr double kStepError = 1e-14;

/// Evaluations of the laws in a part of a piece. Where more are needed, the slip passes through 0
/// on the way or hardly grows: a shorter piece, then.
constexpr int kMostEvaluations = 20'000;

/// c(x^2) = (1 - x/2 cot(x/2)) / x^2 as its series, and its derivative by x^2; |x| < 2 pi, meant
/// for |x| <= 1. The coefficients are |B_2n| / (2n)!, B the Bernoulli numbers.
struct TurnFactor {
    double value = 0, slope = 0;
    explicit TurnFactor(double x2) {
        constexpr std::array<double, 10> kTerms = {1.0 / 12,
                                                   1.0 / 720,
                                                   1.0 / 30240,
                                                   1.0 / 1209600,
                                                   1.0 / 47900160,
                                                   691.0 / 1307674368000,
                                                   1.0 / 74724249600,
                                                   3617.0 / 10670622842880000,
                                                   43867.0 / 5109094217170944000,
                                                   174611.0 / 802857662698291200000.0};
        for (std::size_t i = kTerms.size(); i-- > 0;) {
            slope = value + x2 * slope;
            value = kTerms[i] + x2 * value;
        }
    }
};

/// The rate of a turn u of q = exp(u) q0 for q' = w q / 2, the inverse of spin_of_turn():
/// u' = w - u x w / 2 + c u x (u x w).

}  // namespace

/// The rate of a turn u of q = exp(u) q0 for q' = w q / 2, the inverse of spin_of_turn():
/// u' = w - u x w / 2 + c u x (u x w).
Vec3 turn_rate(const Vec3& u, const Vec3& w) {
    const Vec3 across = u.cross(w);
    return w - 0.5 * across + TurnFactor(u.squaredNorm()).value * u.cross(across);
}

/// u'' for a spin that changes by b.
Vec3 turn_second_rate(const Vec3& u, const Vec3& w, const Vec3& b) {
    const TurnFactor c(u.squaredNorm());
    const Vec3 rate = turn_rate(u, w), across = u.cross(w);
    const Vec3 across_rate = rate.cross(w) + u.cross(b);
    return b - 0.5 * across_rate + (2 * u.dot(rate) * c.slope) * u.cross(across) +
           c.value * (rate.cross(across) + u.cross(across_rate));
}

void Course::advance(Numbers& y, double seconds) const {
    if (!(seconds > 0)) return;
    // Its room for intermediate values is copied before it is filled; static, it starts as 0.
    static const odeint::runge_kutta_fehlberg78<Numbers> kStepper;
    auto stepper =
        odeint::make_controlled(0.01 * kStepError * contact_.radius, kStepError, kStepper);
    int evaluations = 0;
    const auto rates = [this, &evaluations](const Numbers& now, Numbers& rate, double) {
        if (++evaluations > kMostEvaluations)
            throw odeint::no_progress_error("too many steps in a piece");
        const CurvedState s = state(now);
        const CurvedForces f = forces(s);
        set_part(rate, 0, s.v);
        set_part(rate, 1, f.acceleration);
        set_part(rate, 2, f.spin_rate);
        set_part(rate, 3, turn_rate(part(now, 3), s.w));
    };
    odeint::integrate_adaptive(stepper, rates, y, 0.0, seconds, seconds);
}

}  // namespace carom
