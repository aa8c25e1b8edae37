// When a ball will meet something next.
#include <algorithm>

#include "sim/exact_run.h"
#include "sim/time_of_impact.h"

namespace carom {

// ---- Predictions
// ---------------------------------------------------------------------------------

void ExactRun::predict(int ball, double now) {
    const ExactBall& b = world_.ball(ball);
    Prediction earliest{std::min(b.phase_end, b.row_due), ball, b.stamp, false, {}, 0};
    for (int s = 0; s < static_cast<int>(world_.scene.surfaces.size()); ++s)
        if (s != b.surface) consider(ball, {true, s}, now, earliest);
    for (int other = 0; other < static_cast<int>(world_.balls.size()); ++other)
        if (other != ball) consider(ball, {false, other}, now, earliest);
    if (earliest.time <= end_) queue_.push(earliest);
}

void ExactRun::consider(int ball, const Partner& partner, double now, Prediction& earliest) {
    const double horizon = std::min(earliest.time, end_) - now;
    Path path = world_.path(ball, now);
    const double radius = world_.body(ball).radius;
    // Two balls far apart are the common case: geometry only where the gap is near 0.
    const bool surface = partner.is_surface;
    Path other;
    if (!surface) other = world_.path(partner.index, now);
    const Contact contact = world_.contact_at(ball, partner, now);
    const bool touching = world_.touches(contact, now);
    TimeOfImpact toi;
    double separation = 0;
    if (touching) {
        Vec3 v = path.velocity - other.velocity;
        if (contact.ball != ball) v = -v;
        separation = v.dot(contact.normal);
        if (-separation > kStillFraction * (path.velocity.norm() + other.velocity.norm()))
            toi = {ImpactState::kHit, 0};
    }
    if (toi.state != ImpactState::kHit)
        toi = surface ? impact_with_surface(path, radius, world_.surface(partner.index).shape,
                                            touching, horizon)
                      : impact_with_sphere(path.relative_to(other),
                                           radius + world_.body(partner.index).radius, touching,
                                           horizon);
    if (toi.state == ImpactState::kMiss) return;
    if (toi.state == ImpactState::kPressed)
        refuse("pressed together in a contact that has no closed form yet", ball, partner, now);
    if (toi.state == ImpactState::kCapped) refuse("time of impact not found", ball, partner, now);
    if (touching && toi.s > 0 && contact.restitution < 1) {
        const double hop = 0.25 * toi.s * separation;
        if (hop < hop_limit(ball, path.position))
            refuse("a bouncing series ends in a contact that has no closed form yet", ball, partner,
                   now);
    }
    earliest = {now + toi.s, ball,    world_.ball(ball).stamp,
                true,        partner, surface ? 0 : world_.ball(partner.index).stamp};
}

}  // namespace carom
