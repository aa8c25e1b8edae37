#include "sim/integrate/single_motion.h"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/util/odeint_error.hpp>
#include <cmath>
#include <optional>

#include "sim/integrate/piece_end.h"
#include "sim/math/hermite_fit.h"

namespace carom {

namespace {

namespace odeint = boost::numeric::odeint;

/// A piece turns the normal, and the ball itself, by no more than about this [rad]: there all
/// series in use converge fast.
constexpr double kLongestTurn = 0.7;

/// A piece takes away at most this part of the slip that is left: at its end the slip turns ever
/// faster, so that the pieces must shorten with it.
constexpr double kSlipPart = 0.6;

/// A slip of this fraction of the ball's speeds is none.
constexpr double kNoSlip = 1e-12;

/// A piece whose error is too large is shortened, at most so many times.
constexpr int kMostTries = 60;

/// A course over some seconds as a piece that starts at 0, and how far it may be off.
struct Fit {
    Piece piece;
    CurvedState end;
    double error = 0;  ///< as a multiple of what is allowed
};

CurveNode place_node(const Course& course, const Numbers& y) {
    const CurvedState s = course.state(y);
    return {part(y, 0), s.v, course.forces(s).acceleration};
}

CurveNode turn_node(const Course& course, const Numbers& y) {
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

    const CurveNode place = place_node(course, begin), turn = turn_node(course, begin);
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

/// A slip that friction ends within this time [s] may end at once: gravity does no more than 1e-8
/// m/s meanwhile. Under large friction a slip that turns is stiff towards its end.
constexpr double kSudden = 1e-9;

/// The state after the impulse of friction that ends the slip: it changes the slip s by 1 + 1/k
/// times what it gives to the velocity. None where that takes longer.
std::optional<CurvedState> sudden_grip(const Course& course, const CurvedForces& f) {
    const CurvedContact& c = course.contact();
    const double k = c.inertia_factor;
    if (course.mode() != CurvedMode::kSliding || !(f.push > 0)) return std::nullopt;
    if (f.slip.norm() > kSudden * c.friction * f.push * (1 + 1 / k)) return std::nullopt;
    const Vec3 change = -f.slip / (1 + 1 / k);
    CurvedState state = course.start();
    state.v += change;
    state.w -= f.normal.cross(change) / (k * c.radius);
    return state;
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
        } catch (const odeint::odeint_error&) {
            h *= 0.25;
        }
        h = to_a_double(now, h);
    }
    if (const auto gripped = sudden_grip(course, forces)) {
        result.end = CurvedEnd::kSlipEnds;
        result.end_state = *gripped;
    } else {
        result.end = CurvedEnd::kGivenUp;
    }
    return result;
}

}  // namespace carom
