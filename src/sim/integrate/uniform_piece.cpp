#include "sim/integrate/uniform_piece.h"

#include <algorithm>

#include "sim/math/polynomial.h"

namespace carom {

namespace {

/// Fractions of the rates at hand below which they are rounding.
constexpr double kSteady = 1e-13;

/// What rounding leaves of accelerations that are 0 moves a ball by 1e-12 m in so many seconds.
constexpr double kLongest = 30;

bool is_parallel(const Vec3& a, const Vec3& b) {
    return a.cross(b).norm() <= kSteady * a.norm() * b.norm();
}

/// The rates of a ball's motion; what rounding of gravity left of a 0 is 0, so that it does not add
/// up.
Vec3 acceleration(const CoupledContacts& system, const CoupledForces& f, std::size_t ball) {
    const Vec3& a = f.acceleration[ball];
    return a.norm() > kSteady * system.gravity.norm() ? a : Vec3(Vec3::Zero());
}
Vec3 spin_rate(const CoupledContacts& system, const CoupledForces& f, std::size_t ball) {
    const Vec3& b = f.spin_rate[ball];
    const double rim = system.balls[ball].radius * b.norm();
    return rim > kSteady * system.gravity.norm() ? b : Vec3(Vec3::Zero());
}

bool is_steady(const CoupledContacts& system, const CoupledState& state, const CoupledForces& f) {
    if (system.in_air()) return false;
    for (std::size_t b = 0; b < system.ball_count; ++b)
        if (!is_parallel(state[b].w, spin_rate(system, f, b))) return false;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& c = system.contacts[i];
        const CoupledContactForces& at = f.contacts[i];
        // Two balls that touch turn about one another as soon as they move.
        if (c.other >= 0) return false;
        const auto ball = static_cast<std::size_t>(c.ball);
        // Nor does a ball go straight for longer than an instant where the core is a circle.
        if (c.feature.has_circle() && !state[ball].v.isZero(0)) return false;
        const Vec3 turning = c.feature.across * f.acceleration[ball];
        const Vec3 pull = turning - turning.dot(at.normal) * at.normal;
        if (at.normal_rate.norm() * c.feature.distance > kSteady * state[ball].v.norm() ||
            pull.norm() > kSteady * system.gravity.norm())
            return false;
        const bool slides = c.mode == ContactMode::kSliding || c.mode == ContactMode::kIncipient;
        if (slides && c.presses && !is_parallel(at.slip, at.slip_rate)) return false;
    }
    return true;
}

/// What stays >= 0 within a border while a ball keeps its acceleration: of a round one, the
/// difference of the squares of both distances from the axis.
Polynomial room_within(const FeatureBorder& edge, const ContactState& s, const Vec3& acceleration) {
    if (edge.slant == 0)
        return {{edge.margin(s.x), edge.direction.dot(s.v), 0.5 * edge.direction.dot(acceleration),
                 0, 0}};
    const auto across = [&edge](const Vec3& v) -> Vec3 { return v - edge.axis.dot(v) * edge.axis; };
    const Vec3 p = across(s.x - edge.origin), v = across(s.v), half = 0.5 * across(acceleration);
    const double sum = p.norm() + edge.offset / edge.slant;
    return {{sum * edge.margin(s.x), edge.slant * 2 * p.dot(v),
             edge.slant * (v.squaredNorm() + 2 * p.dot(half)), edge.slant * 2 * v.dot(half),
             edge.slant * half.squaredNorm()}};
}

double seconds_on(const CoupledContact& c, const ContactState& s, const Vec3& acceleration,
                  double horizon) {
    for (int k = 0; k < c.feature.border_count; ++k) {
        const FeatureBorder& edge = c.feature.borders[static_cast<std::size_t>(k)];
        const Roots out = downward_crossings(room_within(edge, s, acceleration), horizon);
        if (out.count > 0) horizon = std::min(horizon, out.at[0]);
    }
    return horizon;
}

}  // namespace

std::optional<CoupledPiece> steady_piece(const CoupledContacts& system, const CoupledState& state,
                                         const CoupledForces& forces, double now, double horizon) {
    if (!is_steady(system, state, forces)) return {};
    CoupledPiece piece;
    piece.curved = false;
    double seconds = std::min(horizon, kLongest);
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& c = system.contacts[i];
        const CoupledContactForces& at = forces.contacts[i];
        const auto ball = static_cast<std::size_t>(c.ball);
        seconds = seconds_on(c, state[ball], acceleration(system, forces, ball), seconds);
        const bool slows = at.slip.dot(at.slip_rate) < 0;
        if (c.presses && c.mode == ContactMode::kSliding && slows)
            seconds = std::min(seconds, at.slip.norm() / at.slip_rate.norm());
    }
    piece.seconds = (now + seconds) - now;
    if (!(piece.seconds > 0)) return {};
    for (std::size_t b = 0; b < system.ball_count; ++b) {
        piece.balls[b].acceleration = acceleration(system, forces, b);
        piece.balls[b].spin_rate = spin_rate(system, forces, b);
    }
    return piece;
}

}  // namespace carom
