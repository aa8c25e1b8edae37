// When a ball will meet something next, or leave its cell of the grid.
#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"
#include "sim/collide/time_of_impact.h"
#include "sim/collide/time_of_impact_high_degree.h"
#include "sim/exact/run.h"
#include "sim/group/island_step.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// The grid is looked at again after so many events a ball.
constexpr std::int64_t kEventsPerGrid = 16;

/// An acceleration of this fraction of gravity is rounding.
constexpr double kBalanced = 1e-11;

/// It is built anew when its cells should be larger or smaller by this factor.
constexpr double kMisfit = 1.5;

/// Seconds until x + v s + a s^2 / 2 leaves (low, high), where it is now; at most `horizon`.
double seconds_inside(double x, double v, double a, double low, double high, double horizon) {
    if (a == 0) {
        if (v == 0) return horizon;
        return std::min(((v > 0 ? high : low) - x) / v, horizon);
    }
    for (const auto& gap :
         {Polynomial{{x - low, v, 0.5 * a, 0, 0}}, Polynomial{{high - x, -v, -0.5 * a, 0, 0}}}) {
        const Roots out = downward_crossings(gap, horizon);
        if (out.count > 0) horizon = std::min(horizon, out.at[0]);
    }
    return horizon;
}

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

// ---- Predictions
// ---------------------------------------------------------------------------------

void ExactRun::predict(int ball, double now) {
    const ExactBall& b = world_.ball(ball);
    if (b.in_pile && !b.asleep) return;
    Prediction& next = next_[static_cast<std::size_t>(ball)];
    next = {};
    next.time = std::min(b.phase_end, b.event_due);
    next.ball = ball;
    next.stamp = b.stamp;
    if (!b.in_pile) find_impacts_with_surfaces(ball, now);
    if (world_.grid && world_.grid->in_cell(ball)) {
        const NeighbourGrid::Cell cell = world_.grid->cell_at(world_.position(ball, now));
        if (cell != world_.grid->cell_of(ball)) world_.grid->move(ball, cell);
    }
    world_.for_each_near(ball, [&](int other) { find_impact_with_ball(ball, other, now); });
    enqueue(ball, now);
}

/// The prediction at hand, or the end of the ball's stay in its cell if that comes before.
void ExactRun::enqueue(int ball, double now) {
    Prediction& next = next_[static_cast<std::size_t>(ball)];
    next.leaves_cell = std::numeric_limits<double>::infinity();
    if (world_.grid && world_.grid->in_cell(ball)) {
        const Path path = world_.path(ball, now);
        const double size = world_.grid->cell_size(), margin = world_.grid->margin();
        const NeighbourGrid::Cell& cell = world_.grid->cell_of(ball);
        double seconds = std::min(next.time, end_) - now;
        const double until = seconds;
        const Piece& piece = world_.ball(ball).piece;
        for (int i = 0; i < 3; ++i) {
            const auto low = static_cast<double>(cell[static_cast<std::size_t>(i)]) * size;
            if (piece.curve) {
                const HighDegreePath curved = high_degree_path(piece, now, std::max(seconds, 0.0));
                seconds = seconds_above(curved, Vec3::Unit(i), low - margin);
                seconds = std::min(seconds,
                                   seconds_above(curved, -Vec3::Unit(i), -(low + size + margin)));
                continue;
            }
            seconds = seconds_inside(path.position[i], path.velocity[i], path.acceleration[i],
                                     low - margin, low + size + margin, seconds);
        }
        if (seconds < until) next.leaves_cell = now + seconds;
    }
    const double time = std::min(next.time, next.leaves_cell);
    if (time <= end_)
        queue_.put(ball, time);
    else
        queue_.drop(ball);
}

/// A ball has left its cell: only the cells that come into reach have to be looked at.
void ExactRun::change_cell(int ball, double now) {
    NeighbourGrid& grid = *world_.grid;
    const NeighbourGrid::Cell from = grid.cell_of(ball);
    const NeighbourGrid::Cell to = grid.cell_at(world_.position(ball, now));
    int moved = 0, axis = 0;
    std::int64_t side = 0;
    for (int i = 0; i < 3; ++i) {
        const std::int64_t step =
            to[static_cast<std::size_t>(i)] - from[static_cast<std::size_t>(i)];
        if (step == 0) continue;
        ++moved;
        axis = i;
        side = step;
    }
    if (moved > 0) grid.move(ball, to);
    const auto look = [&](int other) { find_impact_with_ball(ball, other, now); };
    if (moved == 1 && std::abs(side) == 1)
        world_.for_each_in_layer(ball, axis, side, look);
    else if (moved > 0)
        world_.for_each_near(ball, look);
    enqueue(ball, now);
}

/// Where balls have spread or gathered, the cells follow.
void ExactRun::fit_grid(double now) {
    if (!world_.grid ||
        ++events_of_grid_ < kEventsPerGrid * static_cast<std::int64_t>(world_.balls.size()))
        return;
    events_of_grid_ = 0;
    Vec3 low = world_.position(0, now), high = low;
    for (int i = 1; i < static_cast<int>(world_.balls.size()); ++i) {
        const Vec3 x = world_.position(i, now);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double ratio = world_.grid->cell_size_for(low, high) / world_.grid->cell_size();
    if (ratio < kMisfit && ratio > 1 / kMisfit) return;
    world_.build_grid(now);
    for (ExactBall& b : world_.balls) b.stamp = next_stamp_++;
    for (int i = 0; i < static_cast<int>(world_.balls.size()); ++i) predict(i, now);
}

// ---- One partner
// ---------------------------------------------------------------------------------
//
// A pair is looked at from the instant on since which both have been on their pieces, not from now:
// so the answer does not depend on when, and how often, it is asked for.

/// Planes first: they are quick to look at, and what the ball meets there shortens the look ahead.
void ExactRun::find_impacts_with_surfaces(int ball, double now) {
    const ExactBall& b = world_.ball(ball);
    const double& found = next_[static_cast<std::size_t>(ball)].time;
    for (const int plane : world_.planes)
        if (plane != b.surface) find_impact_with_surface(ball, plane, now);
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
        if (surface != b.surface && is_ahead(surface)) find_impact_with_surface(ball, surface, now);
    });
}

void ExactRun::find_impact_with_surface(int ball, int surface, double now) {
    const Partner partner{true, surface};
    const double until = std::min(next_[static_cast<std::size_t>(ball)].time, end_);
    if (until <= now) return;
    const bool stepped = has_island(world_.ball(ball));
    if (stepped && (links_.linked(ball, partner) || is_beside_link(ball, surface, now) ||
                    joins_island(partner, ball, now)))
        return;
    const double from = stepped ? now : world_.ball(ball).piece.start;
    const Path path = world_.path(ball, from);
    const double radius = world_.ball(ball).radius;
    const SurfaceShape& shape = world_.surface(surface).shape;
    const Nearest nearest = nearest_on(shape, path.position, radius);
    const bool touching =
        stepped ? in_reach(world_.contact_at(ball, partner, now))
                : nearest.gap <= world_.touch_tolerance(path.position, nearest.point, radius);
    const double separation = touching ? path.velocity.dot(nearest.normal) : 0;
    const double still = kStillFraction * path.velocity.norm() + world_.ball(ball).rounding_speed;
    TimeOfImpact toi{ImpactState::kHit, 0};
    if (!touching || -separation <= still)
        toi = world_.ball(ball).piece.curve
                  ? impact_with_surface(high_degree_path(world_.ball(ball).piece, from,
                                                         world_.ball(ball).phase_end - from),
                                        radius, shape, touching)
                  : impact_with_surface(path, radius, shape, touching, until - from);
    if (toi.state == ImpactState::kHit || toi.state == ImpactState::kPressed)
        toi = beside_held(ball, surface, toi, from);
    keep_if_earlier(partner, ball, toi, touching, separation, from, now);
}

/// What is left of meeting a surface where another one holds the ball in the same place: nothing
/// where that one keeps the ball out of it, or goes on to hold.
TimeOfImpact ExactRun::beside_held(int ball, int surface, const TimeOfImpact& toi,
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
bool ExactRun::is_beside_link(int ball, int surface, double now) const {
    const Contact met = world_.contact_at(ball, {true, surface}, now);
    if (!in_reach(met)) return false;
    const auto& links = links_.of(ball);
    return std::any_of(links.begin(), links.end(), [&](const Link& link) {
        return link.partner.is_surface &&
               same_place(world_, world_.contact_at(ball, link.partner, now), met);
    });
}

void ExactRun::find_impact_with_ball(int ball, int other, double now) {
    const Partner partner{false, other};
    const ExactBall& a = world_.ball(ball);
    const ExactBall& b = world_.ball(other);
    double until = std::min(next_[static_cast<std::size_t>(ball)].time, end_);
    // The steps of a pile see what is near. What is sent its way between two of them is caught at
    // once, and so is what meets a sleeper.
    const bool pile = a.in_pile || b.in_pile;
    if (a.in_pile && b.in_pile) return;
    if (pile && !(a.in_pile ? a : b).asleep) until = std::min(until, next_step_);
    if (until <= now) return;
    // What ODE steps is known to the gap that makes a link.
    const bool stepped = !pile && (has_island(a) || has_island(b));
    if (stepped && (links_.linked(ball, partner) || joins_island(partner, ball, now))) return;
    const double from = stepped ? now : std::max(a.piece.start, b.piece.start);
    const Path path_a = world_.path(ball, from), path_b = world_.path(other, from);
    const Path path = path_a.relative_to(path_b);
    const double sum = world_.ball(ball).radius + world_.ball(other).radius;
    const double reach = sum + world_.touch_tolerance(path_a.position, path_b.position, sum);
    const double distance2 = path.position.squaredNorm();
    const double closing = path.position.dot(path.velocity);
    const bool touching =
        stepped ? in_reach(world_.contact_at(ball, partner, now)) : distance2 <= reach * reach;
    // The common case: both in flight, and apart.
    const bool curved = a.piece.curve || b.piece.curve;
    if (!touching && closing >= 0 && path.acceleration.isZero(0) && !curved) return;
    double separation = 0;
    TimeOfImpact toi{ImpactState::kHit, 0};
    if (touching) separation = closing / std::sqrt(distance2);
    const double still = kStillFraction * (path_a.velocity.norm() + path_b.velocity.norm()) +
                         a.rounding_speed + b.rounding_speed;
    if (!touching || (-separation <= still && !pile))
        toi = curved ? impact_at_high_degree(a, b, sum, touching, from)
                     : impact_with_sphere(path, sum, touching, until - from);
    keep_if_earlier(partner, ball, toi, touching && !pile, separation, from, now);
}

/// Whether something that ODE steps is near and slow enough for a lasting contact: then the ball's
/// island takes a step at once.
bool ExactRun::joins_island(const Partner& partner, int ball, double now) {
    if (!partner.is_surface) {  // most are far apart
        const double reach =
            (1 + kLinkGap) * (world_.ball(ball).radius + world_.ball(partner.index).radius) +
            world_.place_rounding;
        const Vec3 apart = world_.position(ball, now) - world_.position(partner.index, now);
        if (apart.squaredNorm() > reach * reach) return false;
    }
    const Contact contact = world_.contact_at(ball, partner, now);
    if (!stays_together(contact, now)) return false;
    join_at_once(ball, now);
    return true;
}

/// Two that have just parted, but go on to touch: rounding alone says that they press.
bool ExactRun::rests_against(int ball, const Partner& partner, double now) {
    const Contact c = world_.contact_at(ball, partner, now);
    if (separation_of(c, now) == nullptr) return false;
    Vec3 a = world_.ball(c.ball).piece.acceleration_at(now);
    if (!c.other.is_surface) a -= world_.ball(c.other.index).piece.acceleration_at(now);
    return a.dot(c.normal) >= -kBalanced * world_.scene.simulation.gravity.norm();
}

/// A ball in flight along a surface onto which nothing presses it: only rounding says so.
bool ExactRun::flies_along(int ball, const Partner& partner, double now) const {
    const ExactBall& b = world_.ball(ball);
    return partner.is_surface && !b.stepped && b.surface < 0 && !b.piece.curve &&
           pressing(world_.contact_at(ball, partner, now), now,
                    world_.velocities(ball, now).linear) == 0;
}

/// What touches will go on to do so.
void ExactRun::press(int ball, const Partner& partner, double now, double event_due) {
    const Contact contact = world_.contact_at(ball, partner, now);
    Separation* parting = separation_of(contact, now);
    if (parting != nullptr) parting->pressed = true;
    note_landing(contact, now, event_due);
    join_at_once(ball, now);
}

/// The ball is in a contact without a closed form: its island takes a step at once.
void ExactRun::join_at_once(int ball, double now) {
    enter_island(ball, now, world_.velocities(ball, now));
    Prediction& next = next_[static_cast<std::size_t>(ball)];
    next = {};
    next.time = now;
    next.ball = ball;
    next.stamp = world_.ball(ball).stamp;
}

double ExactRun::gap_at(int ball, const Partner& partner, double time) const {
    return -world_.contact_at(ball, partner, time).depth;
}

/// Takes an impact over into the ball's prediction if it comes first.
void ExactRun::keep_if_earlier(const Partner& partner, int ball, const TimeOfImpact& toi,
                               bool touching, double separation, double from, double now) {
    if (toi.state == ImpactState::kMiss) return;
    if (toi.state == ImpactState::kPressed) {
        if (!rests_against(ball, partner, now) && !flies_along(ball, partner, now))
            press(ball, partner, now, now);
        return;
    }
    if (toi.state == ImpactState::kCapped) refuse("time of impact not found", ball, partner, now);
    if (touching && toi.s > 0) {
        // On a flat surface; what a curved one falls away by, the middle of the way tells.
        const double hop = 0.25 * toi.s * separation;
        const double limit = hop_limit(ball, world_.position(ball, from));
        if (hop < limit && gap_at(ball, partner, from + 0.5 * toi.s) < limit) {
            const double e = world_.contact_at(ball, partner, from).restitution;
            return press(ball, partner, now, from + series_seconds(toi.s, e));
        }
    }
    Prediction& next = next_[static_cast<std::size_t>(ball)];
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
