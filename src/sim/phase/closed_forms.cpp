#include "sim/phase/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/check.h"
#include "core/infinity.h"
#include "geometry/feature.h"
#include "geometry/feature_side.h"
#include "sim/integrate/flight_piece.h"
#include "sim/law/flat_contact.h"
#include "sim/math/polynomial.h"

namespace carom {

namespace {

/// s, of a piece of a flight through air: what is tried first, and the longest.
constexpr double kFirstFlight = 0.1, kLongestFlight = 10;

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
double seconds_on(const BowlShape&, const Piece&, double, const Vec3&, double) { return kInfinity; }
double seconds_on(const PipeShape&, const Piece&, double, const Vec3&, double) { return kInfinity; }
double seconds_on(const RingShape&, const Piece&, double, const Vec3&, double) { return kInfinity; }
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
    FlatContact flat{contact.normal, body.radius, body.inertia_factor, contact.friction,
                     world.pull(ball)};
    if (contact.laws != nullptr) {
        flat.rolling = contact.laws->rolling;
        flat.pivoting = contact.laws->pivoting;
    }
    return flat;
}

}  // namespace

Velocities ClosedForms::landed(int ball, double now, const Contact& contact,
                               const Velocities& velocities, double separation) const {
    return without_bounces(flat_contact(world_, ball, contact), velocities, separation,
                           rules_.slip_tolerance(ball, now, velocities));
}

void ClosedForms::begin_flight(int ball, double now, const Velocities& velocities) {
    BallState at = world_.state(ball, now);
    at.velocity = velocities.linear;
    at.spin = velocities.spin;
    world_.set_phase(ball, Phase::kFlight);
    if (world_.feels_air(ball) || world_.spin_decays(ball)) {
        if (in_air_.empty()) in_air_.resize(world_.balls.size());
        InAir& flight = in_air_[static_cast<std::size_t>(ball)];
        flight.speed = at.velocity.norm();
        flight.way = world_.ball(ball).radius;
        if (const double g = world_.pull(ball).norm(); g > 0)
            flight.way += std::min(flight.speed * flight.speed / (2 * g), flight.speed);
        fly_on(ball, now, at);
        return;
    }
    world_.begin_piece(ball, now, at, world_.pull(ball), Vec3::Zero());
}

void ClosedForms::fly_on(int ball, double now) { fly_on(ball, now, world_.state(ball, now)); }

void ClosedForms::fly_on(int ball, double now, const BallState& at) {
    InAir& flight = in_air_[static_cast<std::size_t>(ball)];
    const FlightPiece piece = flight_piece(
        world_.air(ball), {at.velocity, at.spin, world_.pull(ball), flight.way, flight.speed}, now,
        flight.next_seconds > 0 ? flight.next_seconds : kFirstFlight, kLongestFlight);
    flight.next_seconds = piece.next_seconds;
    world_.ball(ball).phase_end = now + piece.seconds;
    world_.begin_piece(ball, now, at, piece.acceleration, piece.spin_rate,
                       OptionalCurve(piece.curve));
}

bool ClosedForms::can_hold(int ball, double now, const Contact& contact,
                           const Velocities& velocities) const {
    return contact.other.is_surface && !world_.feels_air(ball) &&
           is_flat(world_.surface(contact.other.index).shape, contact.normal) &&
           flat_motion(flat_contact(world_, ball, contact), velocities,
                       rules_.slip_tolerance(ball, now, velocities))
               .has_value();
}

void ClosedForms::begin_flat_contact(int ball, double now, const Contact& contact,
                                     const Velocities& velocities, const Onset& onset) {
    const std::optional<FlatMotion> motion =
        flat_motion(flat_contact(world_, ball, contact), velocities,
                    rules_.slip_tolerance(ball, now, velocities));
    CAROM_CHECK(motion.has_value(), ==, true);

    ExactBall& b = world_.ball(ball);
    BallState at = world_.state(ball, now);
    at.position += contact.depth * contact.normal;  // what rounding left of the gap
    at.velocity = motion->velocities.linear;
    at.spin = motion->velocities.spin;
    hold(ball, now, Phase::kFlat, contact.other.index, contact.normal, motion->kind, onset);
    world_.begin_piece(ball, now, at, motion->acceleration, motion->spin_rate);

    const double on_face = seconds_on_face(
        b.piece, b.radius, world_.surface(contact.other.index).shape, contact.normal, end_ - now);
    b.leaves_at_end = on_face < motion->seconds;
    b.phase_end = now + std::min(on_face, motion->seconds);
}

void ClosedForms::hold(int ball, double now, Phase phase, int surface, const Vec3& normal,
                       EventKind kind, const Onset& onset) {
    ExactBall& b = world_.ball(ball);
    const bool same = b.surface == surface && b.kind == kind;
    b.surface = surface;
    b.kind = kind;
    b.normal = normal;
    world_.set_phase(ball, phase);
    if (b.event_due < kInfinity || onset.at_start || same) return;
    if (onset.bounce_time_left > 0)
        b.event_due = now + onset.bounce_time_left;
    else
        log_.add_of_held(kind, ball, now);
}

}  // namespace carom
