// Which contacts of an island last, and what the events say about them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sim/exact/run.h"
#include "sim/group/island_step.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// A kind of contact is stated when it has been the same for so many steps.
constexpr int kKindSteps = 3;

auto with(const Partner& partner) {
    return [&partner](const Link& link) { return link.partner == partner; };
}

}  // namespace

/// When the next row of a bouncing series that is over is due; infinite if none is.
double ExactRun::next_contact_event(const std::vector<int>& island, double now) const {
    double next = std::numeric_limits<double>::infinity();
    for (const int ball : island)
        for (const Link& link : links_.of(ball))
            if (row_waits(link, now)) next = std::min(next, link.event_due);
    return next;
}

bool ExactRun::stays_together(const Contact& contact, double now, const Link* link) {
    const ContactRules::Together together = rules_.stays_together(contact, now, link);
    if (together.presses_again) notes_.note_press(contact, now);
    return together.lasts;
}

/// The impulse of a step on the first ball of a contact, for the links of both.
void ExactRun::note_push(const Contact& contact, const Vec3& push) {
    const auto note = [&](int ball, const Partner& partner) {
        for (Link& link : links_.of(ball))
            if (link.partner == partner) link.push = push;
    };
    note(contact.ball, contact.other);
    if (!contact.other.is_surface) note(contact.other.index, {false, contact.ball});
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
        if (!world_.ball(ball).stepped) enter_island(ball, now, {at.velocity, at.spin});
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

/// The link of a contact that lasts, as it was if it is known.
void ExactRun::add_link(const Contact& contact, int ball, const Partner& partner,
                        const Link* before, double now) {
    Link link;
    if (before != nullptr) link = *before;
    link.partner = partner;
    if (const Landing* landing = notes_.landing_of(contact, now);
        landing != nullptr && before == nullptr)
        link.event_due = landing->event_due;
    if (now == 0) link.from_start = true;
    links_.of(ball).push_back(link);
}

/// A link of `before` that goes on with another surface in the same place keeps what it has stated.
void ExactRun::link_near(int ball, double now, std::vector<Link>& before) {
    const auto known = [&before](const Partner& partner) -> const Link* {
        const auto found = std::find_if(before.begin(), before.end(), with(partner));
        return found == before.end() ? nullptr : &*found;
    };
    const Vec3 x = world_.position(ball, now);
    std::vector<Contact> met;
    world_.for_each_surface_near(ball, x, world_.reach(ball), [&](int s) {
        const Contact c = world_.contact_at(ball, {true, s}, now);
        if (stays_together(c, now, known(c.other))) met.push_back(c);
    });
    merge_places(world_, x, world_.velocities(ball, now), met, 0,
                 [&](const Contact& gone, const Contact& kept) {
                     const auto old = std::find_if(before.begin(), before.end(), with(gone.other));
                     if (old == before.end()) return;
                     if (known(kept.other) != nullptr)
                         before.erase(old);
                     else
                         old->partner = kept.other;
                 });
    for (const Contact& c : met) add_link(c, ball, c.other, known(c.other), now);
    world_.for_each_near(ball, [&](int other) {
        if (world_.ball(other).in_pile) return;
        const double reach =
            (1 + kLinkGap) * (world_.ball(ball).radius + world_.ball(other).radius) +
            world_.place_rounding;
        if ((world_.position(other, now) - x).squaredNorm() >= reach * reach) return;
        const Partner partner{false, other};
        const Contact c = world_.contact_at(ball, partner, now);
        if (stays_together(c, now, known(partner))) add_link(c, ball, partner, known(partner), now);
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
    if (++link.candidate_steps < kKindSteps || kind == link.stated || row_waits(link, now)) return;
    if (!link.from_start) add_contact_event(contact, kind, now);
    link.from_start = false;
    link.stated = kind;
}

/// Links of a ball that are no more. Of two balls, the scene's first one writes the row.
void ExactRun::note_departures(int ball, const std::vector<Link>& before, double now) {
    for (const Link& link : before) {
        if (links_.linked(ball, link.partner)) continue;
        if (!link.partner.is_surface && link.partner.index < ball) continue;
        if (link.stated != EventKind::kLeave || (link.from_start && link.pressed))
            add_contact_event(world_.contact_at(ball, link.partner, now), EventKind::kLeave, now);
    }
}

void ExactRun::add_contact_event(const Contact& contact, EventKind kind, double now) {
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
