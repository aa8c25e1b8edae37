#include "sim/phase/piles.h"

#include <algorithm>
#include <cmath>

#include "core/infinity.h"

namespace carom {

namespace {

/// A ball that has so many impacts within so many seconds, among so many others, joins a pile:
/// from there on a step costs less than the impacts that it stands for.
constexpr int kManyImpacts = 8;
constexpr double kImpactSeconds = 8e-3;
constexpr std::size_t kManyBalls = 24;

/// Balls stand together when their gap is below this part of the smaller radius.
constexpr double kTogether = 0.2;

/// A ball of a pile rests when it has been slower than this fraction of the speed that gravity
/// gives in the longest step, for so many seconds: what sets it in motion is below 4e-4 g.
constexpr double kPileCalmFraction = 1e-2;
constexpr double kPileCalmSeconds = 0.05;

/// A ball leaves when for so many steps nothing has been near, or nothing but one flat surface.
constexpr int kStepsAlone = 4, kStepsOnSurface = 16;

/// It leaves onto a surface from at most this depth, as a part of its radius: it is put at depth 0.
constexpr double kDepthOfRadius = 2e-5;

}  // namespace

// ---- Into the pile
// ------------------------------------------------------------------------------

void Piles::note_impact(int ball, double now) {
    if (world_.scene.simulation.gravity.isZero(0) || world_.balls.size() < kManyBalls) return;
    RecentImpacts& recent = recent_[static_cast<std::size_t>(ball)];
    if (now - recent.since > kImpactSeconds) recent = {now, 0};
    if (++recent.count < kManyImpacts) return;
    recent.count = 0;
    if (stand_together(ball, now)) want(ball, now);
}

bool Piles::stand_together(int ball, double now) const {
    std::vector<int> group = {ball};
    for (std::size_t k = 0; k < group.size() && group.size() < kManyBalls; ++k) {
        const Vec3 x = world_.position(group[k], now);
        const double radius = world_.ball(group[k]).radius;
        world_.for_each_touching(group[k], x, (1 + kTogether) * radius, [&](int other) {
            const double reach = radius + world_.ball(other).radius +
                                 kTogether * std::min(radius, world_.ball(other).radius);
            if ((world_.position(other, now) - x).squaredNorm() > reach * reach) return;
            if (std::find(group.begin(), group.end(), other) == group.end()) group.push_back(other);
        });
    }
    return group.size() >= kManyBalls;
}

void Piles::join(int ball, double now) {
    pile_.want(ball);
    next_step_ = now;
}

void Piles::want(int ball, double now) {
    pile_.want(ball);
    if (next_step_ == kInfinity) next_step_ = now;
}

/// The ball's island, lasting contact and predictions end: the pile has it.
void Piles::enter(int ball, double now) {
    links_.drop(ball);
    const BallState at = world_.state(ball, now);
    world_.begin_piece(ball, now, at, Vec3::Zero(), Vec3::Zero());
}

// ---- A step
// ---------------------------------------------------------------------------------------

void Piles::step(double now) {
    for (const int ball : pile_.balls().awake()) world_.follow(ball, now);
    taken_.clear();
    pile_.gather(now, links_, taken_);
    for (const int ball : taken_) enter(ball, now);
    pile_.solve(now);
    ++log_.report.steps;
    for (const int ball : pile_.balls().awake()) move(ball, now);
    for (PilePair& pair : pile_.pairs()) state_pair(pair, now);
    next_step_ = now + pile_.seconds();
}

void Piles::end_step() {
    pile_.tidy();
    if (pile_.empty()) next_step_ = kInfinity;
}

void Piles::move(int ball, double now) {
    const PileBall& c = pile_.balls().of(ball);
    const Piece& piece = world_.ball(ball).piece;
    const Vec3 gravity = world_.pull_on(ball, {c.started.linear, c.started.spin});
    // A flight goes on.
    if (!c.pushed && piece.acceleration == gravity && piece.spin_rate.isZero(0)) return;
    BallState at = c.at;
    at.velocity = c.started.linear;
    at.spin = c.started.spin;
    const double h = pile_.seconds();
    const Vec3 a = c.pushed ? Vec3((c.after.linear - at.velocity) / h) : gravity;
    const Vec3 turn = c.pushed ? Vec3((c.after.spin - at.spin) / h) : Vec3(Vec3::Zero());
    world_.begin_piece(ball, now, at, a, turn);
}

bool Piles::leave(int ball, double now) {
    PileBall& c = pile_.balls().of(ball);
    const Velocities velocities = c.started;
    if (c.near <= 1 && leaves_alone(ball, now, velocities)) return true;
    const double calm = kPileCalmFraction * 0.5 * pile_.rules().slow_speed(),
                 r = world_.ball(ball).radius;
    const bool is_calm =
        c.started.linear.norm() < calm && c.after.linear.norm() < calm &&
        (r * c.after.spin.norm() < calm || r * (c.after.spin - c.started.spin).norm() < 0.1 * calm);
    c.calm_seconds = is_calm && c.pushed ? c.calm_seconds + pile_.seconds() : 0;
    if (c.calm_seconds < kPileCalmSeconds) return false;
    lay_to_sleep(ball, now, calm);
    return true;
}

void Piles::lay_to_sleep(int ball, double now, double calm_speed) {
    PileBall& c = pile_.balls().of(ball);
    ExactBall& b = world_.ball(ball);
    BallState at = world_.state(ball, now);
    at.velocity.setZero();
    if (b.radius * at.spin.norm() < calm_speed) at.spin.setZero();
    world_.set_phase(ball, Phase::kPileAsleep);
    world_.begin_piece(ball, now, at, Vec3::Zero(), Vec3::Zero());
    c.load = 0;
    pile_.balls().lay_to_sleep(ball);
    for (PilePair& pair : pile_.pairs()) {
        if (pair.ball != ball && (pair.other.is_surface || pair.other.index != ball)) continue;
        c.load = std::max(c.load, pair.force);
        const int other = pair.ball == ball ? pair.other.index : pair.ball;
        if (!(pair.force > 0) || pair.kind.stated() == EventKind::kRest) continue;
        if (!pair.other.is_surface && !pile_.balls().asleep(other)) continue;
        if (pair.kind.state_rest()) log_.add(event_of(pair, EventKind::kRest, now));
    }
}

bool Piles::leaves_alone(int ball, double now, const Velocities& velocities) {
    PileBall& c = pile_.balls().of(ball);
    const PilePair* floor = nullptr;
    if (c.near == 1)
        for (const PilePair& pair : pile_.pairs())
            if (pair.ball == ball && pair.other.is_surface && pair.force > 0) floor = &pair;
    if (c.near == 1 && floor == nullptr) {
        c.lone_steps = 0;
        return false;
    }
    if (++c.lone_steps < (floor == nullptr ? kStepsAlone : kStepsOnSurface)) return false;
    Contact contact;
    if (floor != nullptr) {
        contact = world_.contact_at(ball, floor->other, now);
        if (contact.depth > kDepthOfRadius * world_.ball(ball).radius) return false;
        if (!forms_.can_hold(ball, now, contact, velocities)) return false;
        if (std::abs(velocities.linear.dot(contact.normal)) > 0.1 * pile_.rules().slow_speed())
            return false;
    }
    ExactBall& b = world_.ball(ball);
    if (floor == nullptr) {
        forms_.begin_flight(ball, now, velocities);
    } else {
        if (floor->kind.is_stated()) {
            b.surface = floor->other.index;
            b.kind = floor->kind.stated();
        }
        forms_.begin_flat_contact(ball, now, contact, velocities, {0, floor->kind.from_start()});
    }
    return true;
}

// ---- Rows
// -----------------------------------------------------------------------------------------

void Piles::state_pair(PilePair& pair, double now) {
    if (pair.bounces && pair.impact_push > 0) {
        Event e = event_of(pair, EventKind::kImpact, now);
        e.approach_speed = pair.closing;
        e.separation_speed = std::max(pair.separation, 0.0);
        e.restitution = pair.restitution;
        e.impulse = pair.impact_push;
        e.tangential_impulse = pair.impact_tangential;
        log_.add(e);
        ++log_.report.impacts;
        if (pair.laws != nullptr && pair.laws->tangential_restitution != 0)
            ++log_.report.without_spring;
    }
    if (pair.kind.is_stated() && pair.gap > pile_.rules().separation_gap()) {
        pair.kind.state_leave();
        log_.add(event_of(pair, EventKind::kLeave, now));
    }
    if (!(pair.force > 0)) return;
    const EventKind kind = kind_of_slip(pair.slip, 0.1 * pile_.rules().slow_speed());
    if (pair.kind.stated() == EventKind::kRest && kind == EventKind::kRoll &&
        pair.slip < kPileCalmFraction * pile_.rules().slow_speed())
        return;
    if (!pair.kind.persists(kind, now, kind_steps::kPile)) return;
    if (pair.kind.state(kind)) log_.add(event_of(pair, kind, now));
}

Event Piles::event_of(const PilePair& pair, EventKind kind, double now) const {
    Event e;
    e.time = now;
    e.ball = pair.ball;
    e.other = pair.other;
    e.kind = kind;
    e.normal = pair.normal;
    e.point = world_.position(pair.ball, now) -
              (world_.ball(pair.ball).radius + 0.5 * pair.gap) * pair.normal;
    return e;
}

}  // namespace carom
