// What a ball does next: it flies, or stays on a flat surface.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/failure.h"
#include "geometry/feature.h"
#include "geometry/feature_side.h"
#include "sim/exact/run.h"
#include "sim/law/flat_contact.h"
#include "sim/math/polynomial.h"

namespace carom {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

/// The velocities with which a ball goes on in a contact whose last bounces are summed.
Velocities ExactRun::landed(int ball, double now, const Contact& contact,
                            const Velocities& velocities, double separation) const {
    return without_bounces(flat_contact(world_, ball, contact), velocities, separation,
                           rules_.slip_tolerance(ball, now, velocities));
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

void ExactRun::settle(int ball, double now, const Velocities& velocities,
                      const std::vector<Contact>& contacts, double speed_scale, bool at_start) {
    const Contact* lasting = nullptr;
    double bounce_time_left = 0;
    bool many = false;
    for (const Contact& c : contacts) {
        double bounce_time = 0;
        if (!rules_.lasts(c, ball, now, speed_scale, bounce_time)) continue;
        if (lasting != nullptr) many = true;
        if (many) notes_.note_landing(*lasting, now, now + bounce_time_left);
        lasting = &c;
        bounce_time_left = bounce_time;
    }
    if (many) {
        notes_.note_landing(*lasting, now, now + bounce_time_left);
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
                       rules_.slip_tolerance(ball, now, velocities))
               .has_value();
}

/// Only where can_hold().
void ExactRun::begin_flat_contact(int ball, double now, const Contact& contact,
                                  const Velocities& velocities, double bounce_time_left,
                                  bool at_start) {
    const std::optional<FlatMotion> motion =
        flat_motion(flat_contact(world_, ball, contact), velocities,
                    rules_.slip_tolerance(ball, now, velocities));
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
