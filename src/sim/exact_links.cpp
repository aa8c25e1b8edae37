// Which contacts of an island last, and what the events say about them.
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/exact_run.h"
#include "sim/island_step.h"
#include "sim/seams.h"

namespace carom {

namespace {

/// A kind of contact is stated when it has been the same for so many steps.
constexpr int kKindSteps = 3;

}  // namespace

/// Whether a contact of an island lasts: hardly a gap, and hardly a speed along the normal. What
/// gravity does in one step is the finest that a step can tell.
bool ExactRun::stays_together(const Contact& contact, double now) {
    if (!in_reach(contact)) return false;
    Vec3 v = world_.velocities(contact.ball, now).linear;
    double still = kStillFraction * v.norm() + world_.ball(contact.ball).rounding_speed;
    if (!contact.other.is_surface) {
        const Vec3 other = world_.velocities(contact.other.index, now).linear;
        v -= other;
        still += kStillFraction * other.norm() + world_.ball(contact.other.index).rounding_speed;
    }
    const double speed = v.dot(contact.normal);
    if (Parting* parting = parting_of(contact, now); parting != nullptr) {
        if (speed < -still) parting->pressed = true;
        if (!parting->pressed) return false;
    }
    return std::abs(speed) <= slow_speed(world_);
}

bool ExactRun::in_reach(const Contact& contact) const {
    double radius = world_.ball(contact.ball).radius;
    if (!contact.other.is_surface)
        radius = std::min(radius, world_.ball(contact.other.index).radius);
    return -contact.depth < kLinkGap * radius;
}

/// Forms the links of these balls anew. Returns them with all that hangs on them, sorted.
std::vector<int> ExactRun::link_neighbours(std::vector<int> balls, double now) {
    std::set<int> seen(balls.begin(), balls.end());
    const auto reach = [&](int ball) {
        if (seen.insert(ball).second) balls.push_back(ball);
    };
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const int ball = balls[k];
        const BallState at = world_.state(ball, now);
        // What rested, flew or had a closed form is stepped from now on.
        if (!world_.ball(ball).stepped) join(ball, now, {at.velocity, at.spin});
        std::vector<Link> before = std::move(links_.of(ball));
        links_.of(ball).clear();
        for (const Link& link : before)
            if (!link.partner.is_surface) reach(link.partner.index);
        link_near(ball, now, before);
        for (const Link& link : links_.of(ball))
            if (!link.partner.is_surface) reach(link.partner.index);
        note_departures(ball, before, now);
    }
    std::sort(balls.begin(), balls.end());
    return balls;
}

/// A link of `before` that goes on with another surface in the same place keeps what it has stated.
void ExactRun::link_near(int ball, double now, std::vector<Link>& before) {
    const auto add = [&](const Partner& partner) {
        const auto old = std::find_if(before.begin(), before.end(), [&partner](const Link& link) {
            return link.partner == partner;
        });
        Link link;
        if (old != before.end()) link = *old;
        link.partner = partner;
        if (now == 0) link.from_start = true;
        links_.of(ball).push_back(link);
    };
    const Vec3 x = world_.position(ball, now);
    std::vector<Contact> met;
    for (int s = 0; s < static_cast<int>(world_.scene.surfaces.size()); ++s) {
        const Contact c = world_.contact_at(ball, {true, s}, now);
        if (stays_together(c, now)) met.push_back(c);
    }
    merge_places(world_, x, world_.velocities(ball, now), met, 0,
                 [&](const Contact& gone, const Contact& kept) {
                     const auto is = [](const Partner& partner) {
                         return [&partner](const Link& link) { return link.partner == partner; };
                     };
                     const auto old = std::find_if(before.begin(), before.end(), is(gone.other));
                     if (old == before.end()) return;
                     if (std::any_of(before.begin(), before.end(), is(kept.other)))
                         before.erase(old);
                     else
                         old->partner = kept.other;
                 });
    for (const Contact& c : met) add(c.other);
    world_.for_each_near(ball, [&](int other) {
        if (world_.ball(other).crowded) return;
        const double reach =
            (1 + kLinkGap) * (world_.ball(ball).radius + world_.ball(other).radius);
        if ((world_.position(other, now) - x).squaredNorm() >= reach * reach) return;
        if (stays_together(world_.contact_at(ball, {false, other}, now), now)) add({false, other});
    });
}

// ---- Rows
// -----------------------------------------------------------------------------------------

void ExactRun::note_link(Link& link, const Contact& contact, bool calm, double calm_speed,
                         double now) {
    link.pressed = contact.impulse > 0;
    if (!link.pressed) return;
    link.last = contact;
    if (calm) return;  // rest is stated when the island falls asleep
    const EventKind kind =
        contact.slip_after.norm() > calm_speed ? EventKind::kSlide : EventKind::kRoll;
    if (kind != link.candidate) {
        link.candidate = kind;
        link.candidate_since = now;
        link.candidate_steps = 0;
    }
    if (++link.candidate_steps < kKindSteps || kind == link.stated) return;
    if (!link.from_start) row_of(contact, kind, now);
    link.from_start = false;
    link.stated = kind;
}

/// Links of a ball that are no more. Of two balls, the scene's first one writes the row.
void ExactRun::note_departures(int ball, const std::vector<Link>& before, double now) {
    for (const Link& link : before) {
        if (links_.linked(ball, link.partner)) continue;
        if (!link.partner.is_surface && link.partner.index < ball) continue;
        if (link.stated != EventKind::kLeave || (link.from_start && link.pressed))
            row_of(world_.contact_at(ball, link.partner, now), EventKind::kLeave, now);
    }
}

void ExactRun::row_of(const Contact& contact, EventKind kind, double now) {
    Event e;
    e.time = now;
    e.ball = contact.ball;
    e.other = contact.other;
    e.kind = kind;
    e.point = contact.point;
    e.normal = contact.normal;
    motion_.events.push_back(e);
}

}  // namespace carom
