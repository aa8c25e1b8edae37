// What a ball does next: it flies, or stays on a flat surface.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/failure.h"
#include "geometry/convexity.h"
#include "geometry/feature.h"
#include "geometry/feature_side.h"
#include "sim/exact/run.h"
#include "sim/law/flat_contact.h"
#include "sim/math/polynomial.h"

namespace carom {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A bouncing series ends when its next hop is lower than this fraction of the ball's radius, or of
/// its distance from the origin if that is larger: below it the hop drowns in the place's rounding.
constexpr double kLastHop = 1e-12;

/// Seconds until the contact point leaves the face that the ball is on. A ball that goes along a
/// border has left when it is beyond the border's width.
double seconds_on(const PlaneShape&, const Piece&, double, const Vec3&, double) {
    return kInfinity;
}
double seconds_on(const SphereShape&, const Piece&, double, const Vec3&, double) {
    return kInfinity;
}
double seconds_on(const CapsuleShape&, const Piece&, double, const Vec3&, double) {
    return kInfinity;
}
double seconds_on(const RingShape&, const Piece&, double, const Vec3&, double) { return kInfinity; }
double seconds_on(const BowlShape&, const Piece&, double, const Vec3&, double) { return kInfinity; }
double seconds_on(const PipeShape&, const Piece&, double, const Vec3&, double) { return kInfinity; }
double seconds_on(const CylinderShape& cylinder, const Piece& piece, double radius, const Vec3&,
                  double horizon) {
    const Vec3 axis = (cylinder.to - cylinder.from).normalized();
    const auto across = [&axis](const Vec3& v) -> Vec3 { return v - axis.dot(v) * axis; };
    const double border = kBorder * (piece.position.cwiseAbs().maxCoeff() + radius);
    const Vec3 p = across(piece.position - cylinder.from), v = across(piece.velocity),
               half = 0.5 * across(piece.acceleration);
    double room = cylinder.radius - p.norm();
    if (room <= border) room += 2 * border;
    // R^2 - |p + v s + a s^2 / 2|^2
    const Polynomial inside{{room * (cylinder.radius + p.norm()), -2 * p.dot(v),
                             -v.squaredNorm() - 2 * p.dot(half), -2 * v.dot(half),
                             -half.squaredNorm()}};
    const Roots out = downward_crossings(inside, horizon);
    return out.count > 0 ? out.at[0] : kInfinity;
}
double seconds_on(const BoxShape& box, const Piece& piece, double radius, const Vec3& normal,
                  double horizon) {
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    const double border = kBorder * (piece.position.cwiseAbs().maxCoeff() + radius);
    double earliest = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 along = world_from_box.col(axis);
        if (std::abs(along.dot(normal)) > 0.5) continue;  // the face's own normal
        for (const double side : {-1.0, 1.0}) {
            double room = 0.5 * box.size[axis] - side * along.dot(piece.position - box.center);
            if (room <= border) room += 2 * border;
            const Polynomial inside{{room, -side * along.dot(piece.velocity),
                                     -0.5 * side * along.dot(piece.acceleration), 0, 0}};
            const Roots out = downward_crossings(inside, horizon);
            if (out.count > 0) earliest = std::min(earliest, out.at[0]);
        }
    }
    return earliest;
}

double seconds_on_face(const Piece& piece, double radius, const SurfaceShape& shape,
                       const Vec3& normal, double horizon) {
    return std::visit([&](const auto& s) { return seconds_on(s, piece, radius, normal, horizon); },
                      shape);
}

FlatContact flat_contact(const ExactWorld& world, int ball, const Contact& contact) {
    const ExactBall& body = world.ball(ball);
    return {contact.normal, body.radius, body.inertia_factor, contact.friction,
            world.scene.simulation.gravity};
}

}  // namespace

// ---- What a ball does next
// -----------------------------------------------------------------------

/// A slip is none if it is rounding of the velocities, or ends within the rounding of the time.
double ExactRun::slip_tolerance(int ball, double now, const Velocities& velocities) const {
    const double time_rounding = 8 * std::numeric_limits<double>::epsilon() * now;
    return kStillFraction *
               (velocities.linear.norm() + world_.ball(ball).radius * velocities.spin.norm()) +
           time_rounding * world_.scene.simulation.gravity.norm();
}

double ExactRun::hop_limit(int ball, const Vec3& position) const {
    return kLastHop * std::max(world_.ball(ball).radius, position.cwiseAbs().maxCoeff());
}

/// What gravity presses with along a normal, m/s^2; 0 where that is none, but for rounding.
double ExactRun::pressing_gravity(const Vec3& normal) const {
    const Vec3& g = world_.scene.simulation.gravity;
    const double g_n = -g.dot(normal);
    return g_n > 1e-14 * g.norm() ? g_n : 0;
}

/// What presses a ball of the velocity `velocity` [m/s] onto a surface, m/s^2: gravity, and on a
/// surface that bends towards the ball, such as the inside of a ring, its own motion along it.
double ExactRun::pressing(const Contact& c, double now, const Vec3& velocity) const {
    if (!c.other.is_surface || is_convex(world_.surface(c.other.index).shape))
        return pressing_gravity(c.normal);
    const Vec3 x = world_.position(c.ball, now), v = tangential_part(velocity, c.normal);
    const Vec3& g = world_.scene.simulation.gravity;
    const FeatureMotion motion =
        feature_at(world_.surface(c.other.index).shape, {x, v, g}, world_.ball(c.ball).radius)
            .motion_at(x, v);
    const double bend = -motion.turning_speed.dot(motion.normal_rate);
    const double sum = bend - g.dot(c.normal);
    return sum > 1e-14 * (g.norm() + std::abs(bend)) ? sum : 0;
}

/// The velocities with which a ball goes on in a contact whose last bounces are summed.
Velocities ExactRun::landed(int ball, double now, const Contact& contact,
                            const Velocities& velocities, double separation) const {
    return without_bounces(flat_contact(world_, ball, contact), velocities, separation,
                           slip_tolerance(ball, now, velocities));
}

/// Whether a contact that does not approach is a lasting one; `bounce_time_left` [s] is how long
/// its remaining bounces take: 2 v / (g_n (1 - e)), v the separation speed and g_n what presses.
bool ExactRun::lasts(const Contact& c, int ball, double now, const Vec3& velocity,
                     double speed_scale, double& bounce_time_left) const {
    if (!c.other.is_surface) return false;
    const double g_n = pressing(c, now, velocity);
    if (g_n == 0) return false;
    const double v = std::max(c.separation_speed, 0.0);
    bounce_time_left = 0;
    if (v <= kStillFraction * speed_scale) return true;
    const Vec3 x = world_.position(ball, now);
    if (v * v / (2 * g_n) >= hop_limit(ball, x)) return false;
    // Hops that drown in rounding are a contact for any coefficient; only for 1 they have no end.
    if (c.restitution < 1) bounce_time_left = 2 * v / (g_n * (1 - c.restitution));
    return true;
}

/// The separation speed whose friction a contact gives back (without_bounces()): that of its own
/// impact, as far as that one had friction. What another impact has lifted has none.
double ExactRun::bounce_of(const Contact& c) const {
    const auto hit = std::find_if(impacts_.begin(), impacts_.end(), [&c](const Contact& impact) {
        return impact.ball == c.ball && impact.other == c.other;
    });
    if (hit == impacts_.end() || c.friction == 0) return 0;
    return std::min(c.separation_speed,
                    hit->tangential_impulse / (c.friction * world_.ball(c.ball).mass));
}

/// Whether one of the contacts that a ball has at the start is an impact: it approaches, and faster
/// than in the bounces that would be summed.
bool ExactRun::approaches_at_start(int ball, const std::vector<Contact>& contacts) const {
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        const double v = -c.separation_speed;
        const double g_n = -world_.scene.simulation.gravity.dot(c.normal);
        return v > kStillFraction * world_.body(ball).velocity.norm() &&
               !(v * v / 2 < g_n * hop_limit(ball, world_.body(ball).position));
    });
}

void ExactRun::settle(int ball, double now, const Velocities& velocities,
                      const std::vector<Contact>& contacts, double speed_scale, bool at_start) {
    const Contact* lasting = nullptr;
    double bounce_time_left = 0;
    bool many = false;
    for (const Contact& c : contacts) {
        double bounce_time = 0;
        if (!lasts(c, ball, now, velocities.linear, speed_scale, bounce_time)) continue;
        if (lasting != nullptr) many = true;
        if (many) note_landing(*lasting, now, now + bounce_time_left);
        lasting = &c;
        bounce_time_left = bounce_time;
    }
    if (many) {
        note_landing(*lasting, now, now + bounce_time_left);
        enter_island(ball, now, velocities);
        return;
    }
    if (lasting != nullptr) {
        const double v = at_start ? lasting->separation_speed : bounce_of(*lasting);
        const bool bounces = std::abs(v) > kStillFraction * speed_scale;
        begin_contact(ball, now, *lasting,
                      bounces ? landed(ball, now, *lasting, velocities, v) : velocities,
                      bounce_time_left, at_start);
        return;
    }
    if (world_.ball(ball).surface >= 0) add_event(now, EventKind::kLeave, ball);
    begin_flight(ball, now, velocities);
}

void ExactRun::begin_piece(int ball, double now, const BallState& at, const Vec3& a,
                           const Vec3& spin_rate, OptionalCurve curve) {
    ExactBall& b = world_.ball(ball);
    b.piece = {now,     at.position, at.velocity, a, std::move(curve), at.orientation,
               at.spin, spin_rate};
    b.stamp = next_stamp_++;
    if (!at.position.allFinite() || !at.velocity.allFinite() || !at.spin.allFinite())
        throw Failure(FailureKind::kRun, fmt::format("the state of ball {} is not finite at {} s",
                                                     world_.body(ball).name, now));
    log_.append(ball, b.piece);
}

void ExactRun::begin_flight(int ball, double now, const Velocities& velocities) {
    ExactBall& b = world_.ball(ball);
    BallState at = world_.state(ball, now);
    at.velocity = velocities.linear;
    at.spin = velocities.spin;
    b.surface = -1;
    b.stepped = b.asleep = b.coarse = false;
    b.phase_end = b.event_due = kInfinity;
    begin_piece(ball, now, at, world_.scene.simulation.gravity, Vec3::Zero());
}

/// Whether a lasting contact has a closed form: on a flat surface, slip that does not turn.
bool ExactRun::can_hold(int ball, double now, const Contact& contact,
                        const Velocities& velocities) const {
    return contact.other.is_surface &&
           is_flat(world_.surface(contact.other.index).shape, contact.normal) &&
           flat_motion(flat_contact(world_, ball, contact), velocities,
                       slip_tolerance(ball, now, velocities))
               .has_value();
}

/// Only where can_hold().
void ExactRun::begin_flat_contact(int ball, double now, const Contact& contact,
                                  const Velocities& velocities, double bounce_time_left,
                                  bool at_start) {
    const std::optional<FlatMotion> motion = flat_motion(
        flat_contact(world_, ball, contact), velocities, slip_tolerance(ball, now, velocities));
    CAROM_CHECK(motion.has_value(), ==, true);

    ExactBall& b = world_.ball(ball);
    BallState at = world_.state(ball, now);
    at.position += contact.depth * contact.normal;  // what rounding left of the gap
    at.velocity = motion->velocities.linear;
    at.spin = motion->velocities.spin;
    begin_flat_piece(ball, now, contact.other, contact.normal, motion->kind, bounce_time_left,
                     at_start);
    begin_piece(ball, now, at, motion->acceleration, motion->spin_rate);

    const double on_face = seconds_on_face(
        b.piece, b.radius, world_.surface(contact.other.index).shape, contact.normal, end_ - now);
    b.leaves_at_end = on_face < motion->seconds;
    b.phase_end = now + std::min(on_face, motion->seconds);
}

/// A change of kind is a row; that of a contact that begins waits for the end of its bounces.
void ExactRun::begin_flat_piece(int ball, double now, const Partner& surface, const Vec3& normal,
                                EventKind kind, double bounce_time_left, bool at_start) {
    ExactBall& b = world_.ball(ball);
    const bool same = b.surface == surface.index && b.kind == kind;
    b.surface = surface.index;
    b.kind = kind;
    b.normal = normal;
    b.stepped = b.asleep = b.coarse = false;
    if (b.event_due < kInfinity || at_start || same) return;
    if (bounce_time_left > 0)
        b.event_due = now + bounce_time_left;
    else
        add_event(now, kind, ball);
}

}  // namespace carom
