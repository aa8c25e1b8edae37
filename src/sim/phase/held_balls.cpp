#include "sim/phase/held_balls.h"

#include <algorithm>
#include <cmath>

#include "core/infinity.h"
#include "sim/group/island_step.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// Gravity along the surface counts as none below this fraction: a few roundings.
constexpr double kHeldBalance = 1e-14;

/// A ball in a hole that is too small for it sits there once it is slower than this part of
/// sqrt(g r): the bounces between the hole's sides that are left have no end.
constexpr double kSeated = 1e-6;

/// When so many phases have ended at once at an instant, the next one has to go on.
constexpr int kMostAtOnce = 4;

/// When so many have, it is given up on.
constexpr int kMostInVain = 40;

/// A contact that is given up on is stepped for so long at first [s]: far longer than a stiff end
/// of a slip takes.
constexpr double kFirstStepped = 1e-3;

/// Nor does it get on where so many pieces are shorter than a step of ODE and none of the times
/// between is longer than this [s]: a slip that friction ends takes some 30 of them, a
/// ball that rattles to rest in a ring some 400, and where
/// others start it again and again, as between balls that chatter under large friction, its
/// directions mean nothing.
constexpr int kMostShortPieces = 800;
constexpr double kPause = 4 * kIslandStep;

bool is_plane(const SingleContact& contact) { return contact.across.trace() < 1.5; }

/// Ends what is left of a ball's motion in a hole that holds it all around. Friction leaves of its
/// spin the part about the hole's axis.
void sit(IntegratedPhase& phase, const Vec3& axis) {
    phase.state.v.setZero();
    if (phase.contact.friction > 0) phase.state.w = phase.state.w.dot(axis) * axis;
}

/// Spin about the normal of this fraction of a ball's speeds is none.
constexpr double kNoPivot = 1e-12;

/// Takes a speed that is no more than `still` [m/s] from a ball that rolls. Whether gravity sets it
/// going from there against rolling resistance.
bool begins_to_roll(IntegratedPhase& phase, const SingleContactForces& forces, double still) {
    ContactState& s = phase.state;
    if (s.v.norm() > still) return false;
    s.v.setZero();
    s.w = s.w.dot(forces.normal) * forces.normal;
    return !holds_still(phase.contact, forces);
}

/// Which way the spin about the normal goes on; of none, nothing is left.
void set_pivot(IntegratedPhase& phase) {
    const double radius = phase.contact.radius;
    const double speed = phase.state.v.norm() + radius * phase.state.w.norm() +
                         std::sqrt(phase.contact.gravity.norm() * radius);
    phase.contact.pivots =
        pivot_of(phase.contact, phase.mode, phase.state, kNoPivot * speed / radius);
}

/// A roll that had begun, but that resistance holds before it is one of its own.
bool fails_to_roll(const IntegratedPhase& phase) {
    return phase.contact.roll_begins && !phase.state.v.isZero(0) &&
           holds_still(phase.contact,
                       single_contact_forces(phase.contact, phase.mode, phase.state));
}

}  // namespace

bool HeldBalls::is_given_up(int ball, double now) const {
    const auto phase = integrated_.find(ball);
    return phase != integrated_.end() && now < phase->second.stepped_until;
}

Velocities HeldBalls::give_up(int ball, double now) {
    const Velocities velocities = world_.velocities(ball, now);
    integrated_[ball].state = {world_.position(ball, now), velocities.linear, velocities.spin};
    return step_instead(ball, now);
}

HeldBalls::Handover HeldBalls::end_phase(int ball, double now) {
    ExactBall& b = world_.ball(ball);
    if (b.event_due <= now) {
        b.event_due = kInfinity;
        log_.add_of_held(b.kind, ball, now);
    }
    if (b.phase_end > now) {
        world_.renew(ball);
        return {};
    }
    if (b.phase() == Phase::kFlight) {
        forms_.fly_on(ball, now);
        return {};
    }
    const Velocities velocities = world_.velocities(ball, now);
    if (b.phase() == Phase::kIntegrated) return end_integrated(ball, now);
    const Contact c = world_.contact_at(ball, {true, b.surface}, now);
    if (!b.leaves_at_end) return begin(ball, now, c, velocities, {});
    if (const auto over = go_over_seam(ball, now, velocities)) return *over;
    return begin_integrated(ball, now, c, velocities, {});
}

namespace {

/// Overlaps of more than this fraction of the radius are a step's, not rounding's.
constexpr double kSteppedOverlap = 1e-9;

/// A contact puts its ball on the surface: where gravity counts that as a rise, out of what a step
/// has left of an overlap, the speeds pay for it.
Velocities paid_for_lift(const ExactWorld& world, int ball, const Contact& contact,
                         const Velocities& velocities) {
    const ExactBall& b = world.ball(ball);
    if (!(contact.depth > kSteppedOverlap * b.radius)) return velocities;
    const double lift = -contact.depth * contact.normal.dot(world.scene.simulation.gravity);
    const double kinetic =
        0.5 * (velocities.linear.squaredNorm() +
               b.inertia_factor * b.radius * b.radius * velocities.spin.squaredNorm());
    if (!(lift > 0) || lift >= kinetic) return velocities;
    const double part = std::sqrt(1 - lift / kinetic);
    return {part * velocities.linear, part * velocities.spin};
}

}  // namespace

HeldBalls::Handover HeldBalls::begin(int ball, double now, const Contact& contact,
                                     const Velocities& brought, const Onset& onset) {
    const Velocities velocities = paid_for_lift(world_, ball, contact, brought);
    const Vec3 v = tangential_part(velocities.linear, contact.normal);
    const SingleContact feature =
        single_contact(world_.surface(contact.other.index).shape, world_.position(ball, now), v,
                       world_.ball(ball).radius, world_.pull_on(ball, {v, velocities.spin}));
    // At the border of a face the motion says whether it is still on it.
    if (is_plane(feature) && forms_.can_hold(ball, now, contact, velocities))
        forms_.begin_flat_contact(ball, now, contact, velocities, onset);
    else
        return begin_integrated(ball, now, contact, velocities, onset);
    return {};
}

/// Where the feature that holds the ball ends, another surface that touches it may go on: then
/// nothing happens to the ball. Empty where none does.
std::optional<HeldBalls::Handover> HeldBalls::go_over_seam(int ball, double now,
                                                           const Velocities& velocities) {
    const Contact held = world_.contact_at(ball, {true, world_.ball(ball).surface}, now);
    const std::optional<SurfaceContact> next =
        goes_on_with(world_, held, world_.position(ball, now), velocities);
    if (!next) return {};
    world_.ball(ball).surface = next->contact.other.index;
    if (is_plane(next->feature) && forms_.can_hold(ball, now, next->contact, velocities))
        forms_.begin_flat_contact(ball, now, next->contact, velocities, {});
    else
        return begin_integrated_on(ball, now, next->contact, next->feature, velocities, {});
    return Handover{};
}

HeldBalls::Handover HeldBalls::begin_integrated(int ball, double now, const Contact& contact,
                                                const Velocities& velocities, const Onset& onset) {
    const SingleContact feature =
        single_contact(world_.surface(contact.other.index).shape, world_.position(ball, now),
                       tangential_part(velocities.linear, contact.normal), world_.ball(ball).radius,
                       world_.pull_on(ball, velocities));
    return begin_integrated_on(ball, now, contact, feature, velocities, onset);
}

HeldBalls::Handover HeldBalls::begin_integrated_on(int ball, double now, const Contact& contact,
                                                   const SingleContact& feature,
                                                   const Velocities& velocities,
                                                   const Onset& onset) {
    const ExactBall& body = world_.ball(ball);
    IntegratedPhase& phase = integrated_[ball];
    phase.state = {world_.position(ball, now), velocities.linear, velocities.spin};
    phase.contact = feature;
    phase.contact.gravity = world_.pull(ball);
    phase.contact.air = world_.feels_air(ball) ? &world_.air(ball) : nullptr;
    add_borders_of_others(world_, contact, phase.state, phase.contact);
    phase.contact.inertia_factor = body.inertia_factor;
    phase.contact.friction = contact.friction;
    if (contact.laws != nullptr) {
        phase.contact.rolling = contact.laws->rolling;
        phase.contact.pivoting = contact.laws->pivoting;
    }
    phase.next_seconds = 0;
    project(phase.contact, ContactMode::kSmooth, phase.state);
    const SingleContactForces forces =
        choose_mode(phase, rules_.slip_tolerance(ball, now, velocities));
    if (!(forces.push > lift_off_threshold(phase.contact, phase.state.x)))
        return lift_off(ball, now, contact.other, forces.normal);
    const Vec3 gravity = phase.contact.pull(phase.state);
    const Vec3 pull = gravity + gravity.dot(-forces.normal) * forces.normal;
    const bool seated = pull.norm() < phase.contact.hold * forces.push &&
                        phase.state.v.norm() < kSeated * std::sqrt(gravity.norm() * body.radius);
    if (seated) sit(phase, forces.normal);
    if (phase.contact.rolling > 0 && phase.mode == ContactMode::kRolling)
        phase.contact.roll_begins =
            begins_to_roll(phase, forces, rules_.slip_tolerance(ball, now, velocities));
    const bool still = phase.state.v.isZero(0) && phase.mode != ContactMode::kSliding;
    const bool held = still && phase.mode == ContactMode::kRolling && !phase.contact.roll_begins &&
                      holds_still(phase.contact, forces);
    const bool rests = seated || held || (still && pull.norm() <= kHeldBalance * gravity.norm());
    set_pivot(phase);
    forms_.hold(ball, now, Phase::kIntegrated, contact.other.index, forces.normal,
                rests ? EventKind::kRest : kind_of(phase.mode), onset);
    if (!rests) return advance(ball, now);
    begin_rest(ball, now, forces);
    return {};
}

/// The ball stays where it is. What is left of its spin about the normal slows, if something
/// resists that.
void HeldBalls::begin_rest(int ball, double now, const SingleContactForces& forces) {
    IntegratedPhase& phase = integrated_[ball];
    BallState at = world_.state(ball, now);
    at.position = phase.state.x;
    at.velocity.setZero();
    at.spin = phase.state.w;
    Vec3 spin_rate = Vec3::Zero();
    world_.ball(ball).phase_end = kInfinity;
    if (phase.contact.pivots != 0) {
        const double rate =
            phase.contact.pivoting * forces.push /
            (phase.contact.inertia_factor * phase.contact.radius * phase.contact.radius);
        const double spin = at.spin.dot(forces.normal);
        spin_rate = -std::copysign(rate, spin) * forces.normal;
        world_.ball(ball).phase_end = now + std::abs(spin) / rate;
        phase.state.w -= spin * forces.normal;
        phase.end = SingleEnd::kRollEnds;  // it is at rest still
    }
    world_.begin_piece(ball, now, at, Vec3::Zero(), spin_rate);
}

/// Whether it slides or rolls, and the forces then.
SingleContactForces HeldBalls::choose_mode(IntegratedPhase& phase, double tolerance) const {
    const auto forces = [&phase](ContactMode mode) {
        phase.mode = mode;
        return single_contact_forces(phase.contact, mode, phase.state);
    };
    if (phase.contact.friction == 0) return forces(ContactMode::kSmooth);
    const SingleContactForces sliding = forces(ContactMode::kSliding);
    if (sliding.slip.norm() > tolerance) return sliding;
    end_slip(phase.contact, phase.state);
    const SingleContactForces rolling = forces(ContactMode::kRolling);
    return grip_left(phase.contact, rolling) >= 0 ? rolling : forces(ContactMode::kIncipient);
}

HeldBalls::Handover HeldBalls::lift_off(int ball, double now, const Partner& surface,
                                        const Vec3& normal) {
    ExactBall& b = world_.ball(ball);
    const ContactState& s = integrated_[ball].state;
    put_at(ball, now, s.x);
    if (b.surface >= 0) {
        b.normal = normal;
        log_.add_of_held(EventKind::kLeave, ball, now);
    }
    notes_.note_separation(world_.contact_at(ball, surface, now), now);
    forms_.begin_flight(ball, now, {s.v, s.w});
    return {};
}

/// The next piece of the ball's phase.
HeldBalls::Handover HeldBalls::advance(int ball, double now) {
    IntegratedPhase& phase = integrated_[ball];
    if (phase.last_begin != now) phase.at_once = 0;
    phase.last_begin = now;
    if (fails_to_roll(phase)) phase.contact.roll_begins = false;
    const SinglePiece piece = next_piece(phase.contact, phase.mode, phase.state, now,
                                         phase.next_seconds, phase.at_once >= kMostAtOnce);
    phase.end = piece.end;
    phase.next_seconds = piece.next_seconds;
    if (now - phase.begun >= kPause) phase.short_pieces = 0;
    phase.begun = now;
    if (piece.seconds > 0 && piece.seconds < kIslandStep && ++phase.short_pieces > kMostShortPieces)
        return step_instead(ball, now);
    ExactBall& b = world_.ball(ball);
    if (!(piece.seconds > 0)) {
        phase.state = piece.end_state;
        b.phase_end = now;
        if (piece.end == SingleEnd::kGivenUp || ++phase.at_once > kMostInVain)
            return step_instead(ball, now);
        return end_integrated(ball, now);
    }
    BallState at = world_.state(ball, now);
    at.position = phase.state.x;
    at.velocity = phase.state.v;
    at.spin = phase.state.w;
    phase.state = piece.end_state;
    b.leaves_at_end = false;
    b.phase_end = now + piece.seconds;
    world_.begin_piece(ball, now, at, piece.acceleration, piece.spin_rate,
                       OptionalCurve(piece.curve));
    return {};
}

Velocities HeldBalls::step_instead(int ball, double now) {
    IntegratedPhase& phase = integrated_[ball];
    phase.stepped_seconds = std::max(2 * phase.stepped_seconds, kFirstStepped);
    phase.stepped_until = now + phase.stepped_seconds;
    phase.at_once = phase.short_pieces = 0;
    ++log_.report.given_up;
    put_at(ball, now, phase.state.x);
    return {phase.state.v, phase.state.w};
}

/// A piece, or the whole phase, ends.
HeldBalls::Handover HeldBalls::end_integrated(int ball, double now) {
    IntegratedPhase& phase = integrated_[ball];
    put_at(ball, now, phase.state.x);
    ExactBall& b = world_.ball(ball);
    b.normal = phase.contact.normal_at(phase.state.x);
    const Partner surface{true, b.surface};
    switch (phase.end) {
        case SingleEnd::kNone:
        case SingleEnd::kGivenUp:  // advance() has seen to that
            break;
        case SingleEnd::kLiftOff:
            return lift_off(ball, now, surface, b.normal);
        case SingleEnd::kRollEnds:
            phase.state.v.setZero();
            phase.state.w = phase.state.w.dot(b.normal) * b.normal;
            return begin(ball, now, world_.contact_at(ball, surface, now),
                         {phase.state.v, phase.state.w}, {});
        case SingleEnd::kSlipEnds:
            end_slip(phase.contact, phase.state);
            [[fallthrough]];
        case SingleEnd::kFeature: {
            const Velocities velocities{phase.state.v, phase.state.w};
            if (phase.end == SingleEnd::kFeature)
                if (const auto over = go_over_seam(ball, now, velocities)) return *over;
            const Contact contact = world_.contact_at(ball, surface, now);
            if (phase.end == SingleEnd::kFeature && is_plane(phase.contact))
                return begin_integrated(ball, now, contact, velocities, {});
            return begin(ball, now, contact, velocities, {});
        }
        case SingleEnd::kSlipGrows:
            phase.mode = ContactMode::kSliding;
            break;
        case SingleEnd::kRollGrows:
            phase.contact.roll_begins = false;
            break;
        case SingleEnd::kPivotEnds:
            phase.state.w -= phase.state.w.dot(b.normal) * b.normal;
            [[fallthrough]];
        case SingleEnd::kPivotSlips:
            set_pivot(phase);
            break;
        case SingleEnd::kGripEnds:
            phase.mode = ContactMode::kIncipient;
            forms_.hold(ball, now, Phase::kIntegrated, surface.index, b.normal, EventKind::kSlide,
                        {});
            break;
    }
    return advance(ball, now);
}

/// The ball is at x now; its piece follows, by the rounding that it is off.
void HeldBalls::put_at(int ball, double now, const Vec3& x) {
    world_.ball(ball).piece.position += x - world_.position(ball, now);
}

Contact HeldBalls::meet(int ball, const Partner& partner, double seconds, double now) {
    ExactBall& b = world_.ball(ball);
    put_on_surface(ball, now);
    const bool held = b.piece.curve && b.surface >= 0;
    if (!partner.is_surface || b.phase() == Phase::kIsland || held)
        return world_.contact_at(ball, partner, now);
    const double lost = seconds - (now - b.piece.start);
    b.piece.position += lost * world_.velocities(ball, now).linear;
    b.piece.velocity += lost * b.piece.acceleration_at(now);
    Contact met = world_.contact_at(ball, partner, now);
    b.piece.position += met.depth * met.normal;
    met.depth = 0;
    return met;
}

void HeldBalls::put_on_surface(int ball, double now) {
    ExactBall& b = world_.ball(ball);
    if (!b.piece.curve || b.surface < 0) return;
    const Contact c = world_.contact_at(ball, {true, b.surface}, now);
    put_at(ball, now, world_.position(ball, now) + c.depth * c.normal);
    const Vec3 v = world_.velocities(ball, now).linear;
    b.piece.velocity -= v.dot(c.normal) * c.normal;
    // What that does to the place again.
    put_at(ball, now,
           world_.position(ball, now) + v.dot(c.normal) * (now - b.piece.start) * c.normal);
}

}  // namespace carom
