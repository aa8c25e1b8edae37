#include "sim/curved_motion.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>

#include "core/failure.h"
#include "sim/bracketed_root.h"

namespace carom {

namespace {

namespace odeint = boost::numeric::odeint;

/// Errors of one step, relative to what the step changes; absolute ones a hundredth of that at the
/// ball's own size.
constexpr double kStepError = 1e-14;

/// A piece turns the normal, and the ball itself, by no more than about this [rad]: there all
/// series in use converge fast.
constexpr double kLongestTurn = 0.7;

/// A piece takes away at most this part of the slip that is left: at its end the slip turns ever
/// faster, so that the pieces must shorten with it.
constexpr double kSlipPart = 0.6;

/// A slip of this fraction of the ball's speeds is none.
constexpr double kNoSlip = 1e-12;

/// An incipient slip follows what drives it up to this fraction of the speeds. Its own direction
/// lags by (turning rate) (slip) / (drive), which leaves 1e-11 of a speed.
constexpr double kSmallSlip = 1e-7;

/// Events are looked for at so many places of a piece, which is short against its motion.
constexpr int kLooks = 8;

/// Evaluations of the laws in a part of a piece. Where more are needed, the slip passes through 0
/// on the way or hardly grows: a shorter piece, then.
constexpr int kMostEvaluations = 20'000;

/// A piece whose error is too large is shortened, at most so many times.
constexpr int kMostTries = 60;

/// d (way since the start), v, w and the turn since the start: four vectors.
using Numbers = std::array<double, 12>;

Vec3 part(const Numbers& y, std::size_t i) { return {y[3 * i], y[3 * i + 1], y[3 * i + 2]}; }
void set_part(Numbers& y, std::size_t i, const Vec3& v) {
    for (std::size_t k = 0; k < 3; ++k) y[3 * i + k] = v[static_cast<Eigen::Index>(k)];
}

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

/// The differential equation, and its solutions from one state on.
class Course {
  public:
    Course(const CurvedContact& contact, CurvedMode mode, const CurvedState& start)
        : contact_(contact),
          mode_(mode),
          start_(start),
          speed_(start.v.norm() + contact.radius * start.w.norm() +
                 std::sqrt(contact.gravity.norm() * contact.radius)) {}

    Numbers first() const {
        Numbers y{};
        set_part(y, 1, start_.v);
        set_part(y, 2, start_.w);
        return y;
    }
    CurvedState state(const Numbers& y) const {
        return {start_.x + part(y, 0), part(y, 1), part(y, 2)};
    }
    CurvedForces forces(const CurvedState& s) const { return curved_forces(contact_, mode_, s); }

    void advance(Numbers& y, double seconds) const {
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

    const CurvedContact& contact() const { return contact_; }
    CurvedMode mode() const { return mode_; }
    const CurvedState& start() const { return start_; }
    /// The size of the speeds at hand, m/s.
    double speed() const { return speed_; }

  private:
    const CurvedContact& contact_;
    CurvedMode mode_;
    const CurvedState& start_;
    double speed_;
};

// ---- The polynomial
// ------------------------------------------------------------------------------

/// A vector function and its first two derivatives at one place.
struct Node {
    Vec3 value, rate, second;
};

/// The terms that take a parabola with the values of `begin` through `middle` and `end` too:
/// Hermite's interpolation at u = 0, 1/2, 1 with two derivatives, solved for the powers 3 ... 8.
Curve::Terms curve_through(const Node& begin, const Node& middle, const Node& end, double h) {
    constexpr std::array<std::array<double, 6>, 6> kInverse = {
        {{256, -32, 8, -58, 10, -0.5},
         {-1536, 160, -56, 453, -79, 4},
         {3840, -288, 152, -1374, 243, -12.5},
         {-4864, 224, -200, 2012, -362, 19},
         {3072, -64, 128, -1416, 260, -14},
         {-768, 0, -32, 384, -72, 4}}};
    const auto rest = [&](const Node& node, double u) -> std::array<Vec3, 3> {
        const double s = u * h;
        return {node.value - begin.value - s * (begin.rate + (0.5 * s) * begin.second),
                h * (node.rate - begin.rate - s * begin.second),
                (h * h) * (node.second - begin.second)};
    };
    const std::array<Vec3, 3> at_middle = rest(middle, 0.5), at_end = rest(end, 1);
    Curve::Terms terms;
    for (std::size_t i = 0; i < 6; ++i) {
        terms[i] = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            terms[i] += kInverse[i][k] * at_middle[k] + kInverse[i][k + 3] * at_end[k];
    }
    return terms;
}

/// A course over some seconds as a piece that starts at 0, and how far it may be off.
struct Fit {
    Piece piece;
    CurvedState end;
    double error = 0;  ///< as a multiple of what is allowed
};

Node place_node(const Course& course, const Numbers& y) {
    const CurvedState s = course.state(y);
    return {part(y, 0), s.v, course.forces(s).acceleration};
}

Node turn_node(const Course& course, const Numbers& y) {
    const CurvedState s = course.state(y);
    const Vec3 u = part(y, 3);
    return {u, turn_rate(u, s.w), turn_second_rate(u, s.w, course.forces(s).spin_rate)};
}

Fit fit(const Course& course, double h) {
    const Numbers begin = course.first();
    Numbers quarter = begin;
    course.advance(quarter, 0.25 * h);
    Numbers middle = quarter;
    course.advance(middle, 0.25 * h);
    Numbers end = middle;
    course.advance(end, 0.5 * h);

    const Node place = place_node(course, begin), turn = turn_node(course, begin);
    Curve curve;
    curve.seconds = h;
    curve.position = curve_through(place, place_node(course, middle), place_node(course, end), h);
    curve.turn = curve_through(turn, turn_node(course, middle), turn_node(course, end), h);
    Fit result;
    result.end = course.state(end);
    Piece& p = result.piece;
    p.velocity = place.rate;
    p.acceleration = place.second;
    p.spin = turn.rate;
    p.spin_rate = turn.second;
    p.curve = OptionalCurve(curve);

    // Between the nodes the error is largest near the quarters.
    const double s = 0.25 * h, radius = course.contact().radius;
    const Vec3 u = s * (p.spin + (0.5 * s) * p.spin_rate) + curve_value(curve.turn, 0.25);
    const double place_error = (p.position_at(s) - part(quarter, 0)).norm();
    const double turn_error = (u - part(quarter, 3)).norm();
    const double speed_error = (p.velocity_at(s) - part(quarter, 1)).norm() +
                               radius * (p.spin_at(s) - part(quarter, 2)).norm();
    result.error = std::max({place_error / (kCurveError * (radius + part(end, 0).norm())),
                             turn_error / (kCurveError * (1 + part(end, 3).norm())),
                             speed_error / (kCurveSpeedError * course.speed())});
    if (!(result.error >= 0)) result.error = std::numeric_limits<double>::infinity();
    return result;
}

// ---- Ends
// ----------------------------------------------------------------------------------------

/// What must stay >= 0 in a piece, one after the other.
class Gates {
  public:
    explicit Gates(const Course& course) : course_(course) {}

    int count() const {
        const CurvedMode mode = course_.mode();
        const int own = mode == CurvedMode::kRolling ? 1 : mode == CurvedMode::kIncipient ? 2 : 0;
        return 1 + course_.contact().gate_count + own;
    }
    CurvedEnd end(int i) const {
        if (i == 0) return CurvedEnd::kLiftOff;
        if (i <= course_.contact().gate_count) return CurvedEnd::kFeature;
        if (course_.mode() == CurvedMode::kRolling) return CurvedEnd::kGripEnds;
        return i == course_.contact().gate_count + 1 ? CurvedEnd::kSlipGrows : CurvedEnd::kSlipEnds;
    }
    double value(int i, const CurvedState& state) const {
        const CurvedContact& c = course_.contact();
        if (i > 0 && i <= c.gate_count)
            return c.gates[static_cast<std::size_t>(i - 1)].room(state.x);
        const CurvedForces f = course_.forces(state);
        switch (end(i)) {
            case CurvedEnd::kLiftOff:
                return f.push - least_push(c, state.x);
            case CurvedEnd::kGripEnds:
                return grip_left(c, f);
            case CurvedEnd::kSlipGrows:
                return kSmallSlip * course_.speed() - f.slip.norm();
            default:
                return f.slip.dot(f.drive);  // the slip goes back to 0
        }
    }

  private:
    const Course& course_;
};

/// The first place in (0, h] where a gate turns negative.
struct Crossing {
    double seconds = std::numeric_limits<double>::infinity();
    CurvedEnd end = CurvedEnd::kNone;
};

/// The lowest place of a function between two others that are higher, by thirds.
double lowest_between(const auto& f, double lo, double hi) {
    constexpr int kThirds = 40;
    for (int i = 0; i < kThirds; ++i) {
        const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
        (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
    }
    return 0.5 * (lo + hi);
}

Crossing first_crossing(const Course& course, const Piece& piece, bool settled) {
    const Gates gates(course);
    const double h = piece.curve->seconds;
    const auto on_piece = [&](double s) -> CurvedState {
        return {course.start().x + piece.position_at(s), piece.velocity_at(s), piece.spin_at(s)};
    };
    const auto exact = [&](double s) {
        Numbers y = course.first();
        course.advance(y, s);
        return course.state(y);
    };
    std::array<CurvedState, kLooks + 1> states;
    for (int j = 0; j <= kLooks; ++j)
        states[static_cast<std::size_t>(j)] = on_piece(h * j / kLooks);

    Crossing first;
    for (int i = 0; i < gates.count(); ++i) {
        const auto place = [h](int j) { return h * j / kLooks; };
        const auto look = [&](int j) {
            return gates.value(i, states[static_cast<std::size_t>(j)]);
        };
        double above = -1;  // the last place where it was above 0
        double before = look(0), here = before;
        for (int j = 0; j <= kLooks; ++j) {
            if (place(j - 1) > first.seconds) break;
            const double after = j < kLooks ? look(j + 1) : here;
            double below = -1;
            if (here < 0 && (j > 0)) below = place(j);
            if (here > 0) above = place(j);
            if (here > 0 && j > 0 && j < kLooks && here <= before && here < after) {
                // A dip between two looks.
                const double s =
                    lowest_between([&](double t) { return gates.value(i, on_piece(t)); },
                                   place(j - 1), place(j + 1));
                if (gates.value(i, on_piece(s)) < 0) {
                    below = s;
                    if (s < above) above = place(j - 1);
                }
            }
            before = here;
            here = after;
            if (below < 0) continue;
            if (above < 0) {
                // It was never above 0: over at once, unless that has been tried.
                const bool gone_back = gates.end(i) == CurvedEnd::kSlipEnds;
                if (settled || gone_back) continue;
                return {0, gates.end(i)};
            }
            const double root =
                bracketed_root([&](double s) { return gates.value(i, exact(s)); }, above, below);
            if (root < first.seconds) first = {root, gates.end(i)};
            break;
        }
    }
    return first;
}

/// The longest piece that its laws bear, before its error is known.
double longest_piece(const Course& course, const CurvedForces& f) {
    const CurvedContact& c = course.contact();
    const CurvedState& s = course.start();
    double h = std::numeric_limits<double>::infinity();
    h = std::min(h, kLongestTurn * std::sqrt(c.distance / c.gravity.norm()));
    if (const double turning = f.normal_rate.norm(); turning > 0)
        h = std::min(h, kLongestTurn / turning);
    if (const double spin = s.w.norm(); spin > 0) h = std::min(h, kLongestTurn / spin);
    if (const double b = f.spin_rate.norm(); b > 0)
        h = std::min(h, std::sqrt(2 * kLongestTurn / b));
    if (course.mode() != CurvedMode::kSliding) return h;
    const double slip = f.slip.norm();
    const double slowing = -f.slip.dot(f.drive + (1 + 1 / c.inertia_factor) * f.friction) / slip;
    return slowing > 0 ? std::min(h, kSlipPart * slip / slowing) : h;
}

/// The largest duration not above h that leads from `now` to a double.
double to_a_double(double now, double h) {
    const double seconds = (now + h) - now;
    return seconds > 0 ? seconds : 0;
}

}  // namespace

CurvedState integrate(const CurvedContact& contact, CurvedMode mode, const CurvedState& state,
                      double seconds) {
    const Course course(contact, mode, state);
    Numbers y = course.first();
    course.advance(y, seconds);
    return course.state(y);
}

CurvedPiece next_piece(const CurvedContact& contact, CurvedMode mode, const CurvedState& state,
                       double now, double guess, bool settled) {
    const Course course(contact, mode, state);
    const CurvedForces forces = course.forces(state);
    CurvedPiece result;
    result.end_state = state;
    if (mode == CurvedMode::kSliding && forces.slip.norm() <= kNoSlip * course.speed() &&
        forces.slip.dot(forces.drive + (1 + 1 / contact.inertia_factor) * forces.friction) <= 0) {
        result.end = CurvedEnd::kSlipEnds;
        return result;
    }
    const double longest = longest_piece(course, forces);
    double h = to_a_double(now, std::min(longest, guess > 0 ? guess : 0.25 * longest));
    std::string trouble = "the error stays too large";
    for (int tries = 0; tries < kMostTries && h > 0; ++tries) {
        Fit fitted;
        try {
            fitted = fit(course, h);
            if (fitted.error <= 1) {
                const Crossing crossing = first_crossing(course, fitted.piece, settled);
                result.end = crossing.end;
                const double growth =
                    std::min(2.0, 0.9 * std::pow(std::max(fitted.error, 1e-6), -1.0 / 9));
                result.next_seconds = h * growth;
                if (crossing.end != CurvedEnd::kNone) {
                    h = to_a_double(now, crossing.seconds);
                    if (!(h > 0)) return result;
                    fitted = fit(course, h);
                }
                result.seconds = h;
                result.acceleration = fitted.piece.acceleration;
                result.spin_rate = fitted.piece.spin_rate;
                result.curve = *fitted.piece.curve;
                result.end_state = fitted.end;
                project(contact, mode, result.end_state);
                return result;
            }
            h *= std::clamp(0.9 * std::pow(fitted.error, -1.0 / 9), 0.2, 0.9);
        } catch (const odeint::odeint_error& e) {
            trouble = e.what();
            h *= 0.25;
        }
        h = to_a_double(now, h);
    }
    throw Failure(FailureKind::kRun,
                  fmt::format("a curved contact cannot be integrated at {} s: {}", now, trouble));
}

}  // namespace carom
