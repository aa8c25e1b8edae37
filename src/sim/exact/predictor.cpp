#include "sim/exact/predictor.h"

#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"
#include "sim/collide/sure_miss.h"
#include "sim/collide/time_of_impact.h"
#include "sim/collide/time_of_impact_high_degree.h"
#include "sim/exact/refusal.h"
#include "sim/group/island_step.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// An acceleration of this fraction of gravity is rounding.
constexpr double kLeavingBalance = 1e-11;

/// Of two partners met at the same instant the first one counts: surfaces, then balls in order.
bool comes_first(const Partner& a, const Partner& b) {
    if (a.is_surface != b.is_surface) return a.is_surface;
    return a.index < b.index;
}

/// How long bounces take of which the first takes `first` seconds, the next one e times that ...
/// Without loss they go on for ever, and there is no end to wait for.
double series_seconds(double first, double restitution) {
    return restitution < 1 ? first / (1 - restitution) : 0;
}

/// Two balls, one of them at least on a curved piece, which ends with its phase. As far as that is
/// known, whatever comes before: the answer's last digits must not depend on who else was asked.
TimeOfImpact impact_at_high_degree(const ExactBall& a, const ExactBall& b, double sum,
                                   bool touching, double from) {
    double until = std::numeric_limits<double>::infinity();
    if (a.piece.curve) until = std::min(until, a.phase_end);
    if (b.piece.curve) until = std::min(until, b.phase_end);
    if (!(until > from)) return {};
    const double seconds = until - from;
    return impact_with_sphere(high_degree_path(a.piece, from, seconds)
                                  .relative_to(high_degree_path(b.piece, from, seconds)),
                              sum, touching);
}

}  // namespace

Outlook Predictor::look_ahead(int ball, double now) const {
    const ExactBall& b = world_.ball(ball);
    Outlook out;
    out.next.time = std::min(b.phase_end, b.event_due);
    out.next.ball = ball;
    out.next.stamp = b.stamp;
    if (!in_pile(b.phase())) look_at_surfaces(out, now);
    world_.for_each_near(ball, [&](int other) { look_at_ball(out, other, now); });
    return out;
}

// ---- One partner
// ---------------------------------------------------------------------------------
//
// A pair is looked at from the instant on since which both have been on their pieces, not from now:
// so the answer does not depend on when, and how often, it is asked for. After a press nothing else
// is looked for: it is due now.

/// Planes first: they are quick to look at, and what the ball meets there shortens the look ahead.
void Predictor::look_at_surfaces(Outlook& out, double now) const {
    const int ball = out.next.ball;
    const ExactBall& b = world_.ball(ball);
    const double& found = out.next.time;
    const bool flies = b.phase() == Phase::kFlight && !b.piece.curve;
    const Path whole{b.piece.position, b.piece.velocity, b.piece.acceleration};
    for (const int plane : world_.planes) {
        // The common case: it comes nowhere near.
        if (flies &&
            surely_clear_of(std::get<PlaneShape>(world_.surface(plane).shape), whole, b.radius,
                            world_.place_rounding, std::min(found, end_) - b.piece.start))
            continue;
        if (plane != b.surface) look_at_surface(out, plane, now);
    }
    double until = std::min(found, end_);
    if (!(until > now) || world_.bounded_surfaces.empty()) return;
    Box3 ahead = bounds_of(world_.path(ball, now), 0, until - now);
    const auto is_ahead = [&](int surface) {
        if (!world_.surface_tree || b.piece.curve) return true;
        if (found < until) {
            until = found;
            ahead = bounds_of(world_.path(ball, now), 0, until - now);
        }
        return world_.surface_tree->is_near(surface, ahead, world_.reach(ball));
    };
    world_.for_each_surface_ahead(ball, now, until - now, [&](int surface) {
        if (surface != b.surface && is_ahead(surface)) look_at_surface(out, surface, now);
    });
}

void Predictor::look_at_surface(Outlook& out, int surface, double now) const {
    const int ball = out.next.ball;
    const Partner partner{true, surface};
    const double until = std::min(out.next.time, end_);
    if (until <= now) return;
    const bool stepped = has_island(world_.ball(ball).phase());
    if (stepped && (links_.linked(ball, partner) || is_beside_link(ball, surface, now) ||
                    joins_island(out, partner, now)))
        return;
    const double from = stepped ? now : world_.ball(ball).piece.start;
    const Path path = world_.path(ball, from);
    const double radius = world_.ball(ball).radius;
    const SurfaceShape& shape = world_.surface(surface).shape;
    const Nearest nearest = nearest_on(shape, path.position, radius);
    const bool touching =
        stepped ? rules_.in_reach(world_.contact_at(ball, partner, now))
                : nearest.gap <= world_.touch_tolerance(ball, partner, from, path.position,
                                                        nearest.point, radius);
    const double separation = touching ? path.velocity.dot(nearest.normal) : 0;
    const double still = kStillFraction * path.velocity.norm() + world_.ball(ball).rounding_speed;
    TimeOfImpact toi{ImpactState::kHit, 0};
    if ((!touching || -separation <= still) && world_.ball(ball).piece.curve) {
        HighDegreePath curved =
            high_degree_path(world_.ball(ball).piece, from, world_.ball(ball).phase_end - from);
        curved.flies = world_.ball(ball).phase() == Phase::kFlight;
        toi = impact_with_surface(curved, radius, shape, touching);
    } else if (!touching || -separation <= still) {
        toi = impact_with_surface(path, radius, shape, touching, until - from);
    }
    const bool held = world_.ball(ball).surface >= 0 || stepped;
    if (held && (toi.state == ImpactState::kHit || toi.state == ImpactState::kPressed))
        toi = beside_held(ball, surface, toi, from);
    keep_if_earlier(out, toi, {partner, touching, separation, from}, now);
}

/// What is left of meeting a surface where another one holds the ball in the same place: nothing
/// where that one keeps the ball out of it, or goes on to hold.
TimeOfImpact Predictor::beside_held(int ball, int surface, const TimeOfImpact& toi,
                                    double from) const {
    const double at = from + toi.s;
    const Vec3 x = world_.position(ball, at);
    const Contact met = world_.surface_contact(ball, surface, x);
    TimeOfImpact left = toi;
    const auto look = [&](int holder) {
        const Contact held = world_.surface_contact(ball, holder, x);
        if (holder == surface || !same_place(world_, held, met)) return;
        const double until = std::min(world_.ball(ball).phase_end, end_);
        if (keeps_out(world_, ball, surface, at, until)) {
            left = {};
        } else if (toi.state == ImpactState::kPressed) {
            const auto next = goes_on_with(world_, held, x, world_.velocities(ball, at));
            left = next && next->contact.other.index == surface ? TimeOfImpact{ImpactState::kHit, 0}
                                                                : TimeOfImpact{};
        }
    };
    if (world_.ball(ball).surface >= 0) look(world_.ball(ball).surface);
    for (const Link& link : links_.of(ball))
        if (link.partner.is_surface) look(link.partner.index);
    return left;
}

/// Whether a surface meets a ball of an island where a link to another one does.
bool Predictor::is_beside_link(int ball, int surface, double now) const {
    const Contact met = world_.contact_at(ball, {true, surface}, now);
    if (!rules_.in_reach(met)) return false;
    const auto& links = links_.of(ball);
    return std::any_of(links.begin(), links.end(), [&](const Link& link) {
        return link.partner.is_surface &&
               same_place(world_, world_.contact_at(ball, link.partner, now), met);
    });
}

/// The common case: two balls that fall freely, and do not meet before something else happens. Then
/// their distance changes as on a straight line.
bool Predictor::falls_past(const Outlook& out, int other) const {
    const Glance& a = world_.glance(out.next.ball);
    const Glance& b = world_.glance(other);
    if (!a.falls() || !b.falls()) return false;
    const double from = std::max(a.start, b.start);
    const double of_a = from - a.start, of_b = from - b.start;
    const Vec3& g = world_.scene.simulation.gravity;
    Path path;
    path.position = (a.position - b.position) + (of_a * a.velocity - of_b * b.velocity) +
                    (0.5 * (of_a * of_a - of_b * of_b)) * g;
    path.velocity = (a.velocity - b.velocity) + (of_a - of_b) * g;
    const double sum = a.radius + b.radius;
    const double distance2 = path.position.squaredNorm();
    const double touch = sum * (1 + kSureMargin) + 2 * world_.place_rounding +
                         1e-12 * (a.position.cwiseAbs().sum() + b.position.cwiseAbs().sum());
    if (!(distance2 > touch * touch)) return false;
    const double closing = path.position.dot(path.velocity);
    return closing >= 0 ||
           surely_apart(path, distance2, closing, touch, std::min(out.next.time, end_) - from);
}

void Predictor::look_closer(Outlook& out, int other, double now) const {
    const int ball = out.next.ball;
    const Partner partner{false, other};
    const ExactBall& a = world_.ball(ball);
    const ExactBall& b = world_.ball(other);
    double until = std::min(out.next.time, end_);
    // The steps of a pile see what is near. What is sent its way between two of them is caught at
    // once, and so is what meets a sleeper.
    const bool pile = in_pile(a.phase()) || in_pile(b.phase());
    if (in_pile(a.phase()) && in_pile(b.phase())) return;
    if (a.phase() == Phase::kPile || b.phase() == Phase::kPile)
        until = std::min(until, piles_.next_step());
    if (until <= now) return;
    // What ODE steps is known to the gap that makes a link.
    const bool stepped = !pile && (has_island(a.phase()) || has_island(b.phase()));
    if (stepped && (links_.linked(ball, partner) || joins_island(out, partner, now))) return;
    const double from = stepped ? now : std::max(a.piece.start, b.piece.start);
    const Path path_a = world_.path(ball, from), path_b = world_.path(other, from);
    const Path path = path_a.relative_to(path_b);
    const double sum = world_.ball(ball).radius + world_.ball(other).radius;
    const double reach =
        sum + world_.touch_tolerance(ball, partner, from, path_a.position, path_b.position, sum);
    const double distance2 = path.position.squaredNorm();
    const double closing = path.position.dot(path.velocity);
    const bool touching = stepped ? rules_.in_reach(world_.contact_at(ball, partner, now))
                                  : distance2 <= reach * reach;
    // The common case: both in flight, and apart.
    const bool curved = a.piece.curve || b.piece.curve;
    if (!touching && path.acceleration.isZero(0) && !curved &&
        (closing >= 0 || surely_apart(path, distance2, closing, sum, until - from)))
        return;
    double separation = 0;
    TimeOfImpact toi{ImpactState::kHit, 0};
    if (touching) separation = closing / std::sqrt(distance2);
    const auto still = [&] {
        return kStillFraction * (path_a.velocity.norm() + path_b.velocity.norm()) +
               a.rounding_speed + b.rounding_speed;
    };
    if (!touching || (!pile && -separation <= still()))
        toi = curved ? impact_at_high_degree(a, b, sum, touching, from)
                     : impact_with_sphere(path, sum, touching, until - from);
    keep_if_earlier(out, toi, {partner, touching && !pile, separation, from}, now);
}

// ---- What touches
// --------------------------------------------------------------------------------

/// Whether something that ODE steps is near and slow enough for a lasting contact.
bool Predictor::joins_island(Outlook& out, const Partner& partner, double now) const {
    const int ball = out.next.ball;
    if (!partner.is_surface) {  // most are far apart
        const double reach =
            (1 + kLinkGap) * (world_.ball(ball).radius + world_.ball(partner.index).radius) +
            world_.place_rounding;
        const Vec3 apart = world_.position(ball, now) - world_.position(partner.index, now);
        if (apart.squaredNorm() > reach * reach) return false;
    }
    const Contact contact = world_.contact_at(ball, partner, now);
    const ContactRules::Together together = rules_.stays_together(contact, now);
    if (together.presses_again) out.pressed_again.push_back(contact);
    if (!together.lasts) return false;
    out.next.time = now;
    out.next.kind = PredictionKind::kPresses;
    return true;
}

/// Two that have just parted, but go on to touch: rounding alone says that they press.
bool Predictor::rests_against(int ball, const Partner& partner, double now) const {
    const Contact c = world_.contact_at(ball, partner, now);
    if (notes_.separation_of(c, now) == nullptr) return false;
    Vec3 a = world_.ball(c.ball).piece.acceleration_at(now);
    if (!c.other.is_surface) a -= world_.ball(c.other.index).piece.acceleration_at(now);
    return a.dot(c.normal) >= -kLeavingBalance * world_.scene.simulation.gravity.norm();
}

/// A ball in flight along a surface onto which nothing presses it: only rounding says so.
bool Predictor::flies_along(int ball, const Partner& partner, double now) const {
    const ExactBall& b = world_.ball(ball);
    return partner.is_surface && b.phase() != Phase::kIsland && b.surface < 0 && !b.piece.curve &&
           rules_.pressing(world_.contact_at(ball, partner, now), now,
                           world_.velocities(ball, now).linear) == 0;
}

/// What touches will go on to do so.
void Predictor::press(Outlook& out, const Partner& partner, double now, double event_due) const {
    const Contact contact = world_.contact_at(out.next.ball, partner, now);
    out.pressed_again.push_back(contact);
    out.pressing = {contact, event_due};
    out.next.time = now;
    out.next.kind = PredictionKind::kPresses;
}

/// Takes an impact over into the ball's prediction if it comes first.
void Predictor::keep_if_earlier(Outlook& out, const TimeOfImpact& toi, const Look& look,
                                double now) const {
    if (toi.state == ImpactState::kMiss) return;
    const int ball = out.next.ball;
    const Partner& partner = look.partner;
    const double from = look.from;
    if (toi.state == ImpactState::kPressed) {
        if (!rests_against(ball, partner, now) && !flies_along(ball, partner, now))
            press(out, partner, now, now);
        return;
    }
    if (toi.state == ImpactState::kCapped)
        refuse(world_, "time of impact not found", ball, partner, now);
    if (look.touching && toi.s > 0) {
        // On a flat surface; what a curved one falls away by, the middle of the way tells.
        const double hop = 0.25 * toi.s * look.separation;
        const double limit =
            rules_.hop_limit(ball, world_.position(ball, from), world_.laws_between(ball, partner));
        const double rise =
            gap_at(ball, partner, from + 0.5 * toi.s) - std::max(gap_at(ball, partner, from), 0.0);
        if (hop < limit && rise < limit) {
            const double e = world_.contact_at(ball, partner, from).restitution;
            return press(out, partner, now, from + series_seconds(toi.s, e));
        }
    }
    Prediction& next = out.next;
    const double time = std::max(from + toi.s, now);
    if (time > next.time) return;
    if (time == next.time && next.kind == PredictionKind::kImpact &&
        comes_first(next.partner, partner))
        return;
    next.time = time;
    next.stamp = world_.ball(ball).stamp;
    next.kind = PredictionKind::kImpact;
    next.partner = partner;
    next.partner_stamp = partner.is_surface ? 0 : world_.ball(partner.index).stamp;
    next.seconds = (from - world_.ball(ball).piece.start) + toi.s;
}

}  // namespace carom
