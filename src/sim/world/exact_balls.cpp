#include "sim/world/exact_balls.h"

#include <fmt/core.h>

#include <utility>

#include "core/failure.h"

namespace carom {

ExactBalls::ExactBalls(const Scene& s)
    : scene(s), balls(s.balls.size()), log(s.balls.size()), glances_(s.balls.size()) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Ball& body = s.balls[i];
        balls[i].radius = body.radius;
        balls[i].mass = body.mass;
        balls[i].inertia_factor = body.inertia_factor;
        balls[i].material = body.material;
        Piece& piece = balls[i].piece;
        piece.position = body.position;
        piece.velocity = body.velocity;
        piece.acceleration = s.simulation.gravity;
        piece.spin = body.spin;
        if (s.air) air_.emplace_back(*s.air, body);
    }
}

void ExactBalls::set_phase(int i, Phase phase) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    ExactBall& b = ball(i);
    b.phase_ = phase;
    glances_[static_cast<std::size_t>(i)].radius = -1;  // until it begins to fall
    switch (phase) {
        case Phase::kFlight:
            b.surface = -1;
            b.coarse = false;
            b.phase_end = b.event_due = kNever;
            break;
        case Phase::kFlat:
        case Phase::kIntegrated:
            b.coarse = false;
            break;
        case Phase::kIsland:
            b.surface = -1;
            b.event_due = kNever;
            break;
        case Phase::kPile:
            b.surface = -1;
            b.phase_end = b.event_due = kNever;
            break;
        case Phase::kIslandAsleep:
        case Phase::kPileAsleep:
            b.phase_end = kNever;
            break;
    }
}

void ExactBalls::begin_piece(int i, double now, const BallState& at, const Vec3& acceleration,
                             const Vec3& spin_rate, OptionalCurve curve) {
    ExactBall& b = ball(i);
    b.piece = {now,     at.position, at.velocity, acceleration, std::move(curve), at.orientation,
               at.spin, spin_rate};
    renew(i);
    if (!at.position.allFinite() || !at.velocity.allFinite() || !at.spin.allFinite())
        throw Failure(FailureKind::kRun,
                      fmt::format("the state of ball {} is not finite at {} s", body(i).name, now));
    const bool falls =
        b.phase_ == Phase::kFlight && !b.piece.curve && acceleration == scene.simulation.gravity;
    glances_[static_cast<std::size_t>(i)] = {at.position, at.velocity, now, falls ? b.radius : -1};
    log.append(i, b.piece);
}

}  // namespace carom
