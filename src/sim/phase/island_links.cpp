#include "sim/phase/island_links.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/infinity.h"
#include "sim/group/island_step.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// Links that one impact can pass through at once, by Newton's law. What is left beyond them is
/// solved by the next step, without rebound.
constexpr std::size_t kMostCoupled = 40;

auto with(const Partner& partner) {
    return [&partner](const Link& link) { return link.partner == partner; };
}

}  // namespace

void IslandLinks::enter(int ball, double now, const Velocities& velocities) {
    ExactBall& b = world_.ball(ball);
    if (b.surface >= 0) {
        Link link;
        link.partner = {true, b.surface};
        link.last = world_.contact_at(ball, link.partner, now);
        link.kind.take_over(std::isinf(b.event_due) ? b.kind : EventKind::kLeave);
        if (!std::isinf(b.event_due)) link.event_due = b.event_due;
        links_.of(ball) = {link};
    }
    BallState at = world_.state(ball, now);
    at.velocity = velocities.linear;
    at.spin = velocities.spin;
    // Where balls are many, what they join is most likely stepped.
    if (!has_island(b.phase())) b.coarse = has_many_balls(world_);
    world_.set_phase(ball, Phase::kIsland);
    links_.member(ball) = {};
    b.phase_end = now;
    world_.begin_piece(ball, now, at, Vec3::Zero(), Vec3::Zero());
}

std::vector<Contact> IslandLinks::linked_contacts(const std::vector<Contact>& seeds,
                                                  double now) const {
    std::vector<Contact> all = seeds;
    std::vector<int> balls;
    const auto reach = [&balls](int ball) {
        if (std::find(balls.begin(), balls.end(), ball) == balls.end()) balls.push_back(ball);
    };
    for (const Contact& seed : seeds) {
        reach(seed.ball);
        if (!seed.other.is_surface) reach(seed.other.index);
    }
    for (std::size_t k = 0; k < balls.size(); ++k)
        for (const Link& link : links_.of(balls[k])) {
            if (all.size() >= seeds.size() + kMostCoupled) return all;
            const Contact c = world_.contact_at(balls[k], link.partner, now);
            const bool known = std::any_of(all.begin(), all.end(), [&c](const Contact& other) {
                return other.ball == c.ball && other.other == c.other;
            });
            if (!known) all.push_back(c);
            if (!link.partner.is_surface) reach(link.partner.index);
        }
    return all;
}

double IslandLinks::next_contact_event(const std::vector<int>& island, double now) const {
    double next = kInfinity;
    for (const int ball : island)
        for (const Link& link : links_.of(ball))
            if (row_waits(link, now)) next = std::min(next, link.event_due);
    return next;
}

bool IslandLinks::stays_together(const Contact& contact, double now, const Link* link) {
    const ContactRules::Together together = rules_.stays_together(contact, now, link);
    if (together.presses_again) notes_.note_press(contact, now);
    return together.lasts;
}

void IslandLinks::note_push(const Contact& contact, const Vec3& push) {
    const auto note = [&](int ball, const Partner& partner) {
        for (Link& link : links_.of(ball))
            if (link.partner == partner) link.push = push;
    };
    note(contact.ball, contact.other);
    if (!contact.other.is_surface) note(contact.other.index, {false, contact.ball});
}

void IslandLinks::unlink(const Contact& c, double now) {
    notes_.note_separation(c, now);
    const Link* link = links_.find(c.ball, c.other);
    if (link->kind.is_stated() || (link->kind.from_start() && link->pressed))
        log_.add(EventKind::kLeave, c, now);
    const auto forget = [this](int ball, const Partner& partner) {
        links_.unlink(ball, partner);
        links_.member(ball).steps = std::max(links_.member(ball).steps, 1);
    };
    forget(c.ball, c.other);
    if (!c.other.is_surface) forget(c.other.index, {false, c.ball});
}

std::vector<int> IslandLinks::link_neighbours(std::vector<int> balls, double now) {
    std::set<int> seen(balls.begin(), balls.end());
    const auto reach = [&](int ball) {
        if (seen.insert(ball).second) balls.push_back(ball);
    };
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const int ball = balls[k];
        const BallState at = world_.state(ball, now);
        // What rested, flew or had a closed form is stepped from now on.
        if (world_.ball(ball).phase() != Phase::kIsland) enter(ball, now, {at.velocity, at.spin});
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
void IslandLinks::add_link(const Contact& contact, int ball, const Partner& partner,
                           const Link* before, double now) {
    Link link;
    if (before != nullptr) link = *before;
    link.partner = partner;
    if (const Landing* landing = notes_.landing_of(contact, now);
        landing != nullptr && before == nullptr)
        link.event_due = landing->event_due;
    if (now == 0) link.kind.begins_at_start();
    links_.of(ball).push_back(link);
}

/// A link of `before` that goes on with another surface in the same place keeps what it has stated.
void IslandLinks::link_near(int ball, double now, std::vector<Link>& before) {
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
        if (in_pile(world_.ball(other).phase())) return;
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

void IslandLinks::note_step(const Contact& contact, bool calm, double calm_speed, double now) {
    for (Link& link : links_.of(contact.ball))
        if (link.partner == contact.other) note_link(link, contact, calm, calm_speed, now);
}

void IslandLinks::note_link(Link& link, const Contact& contact, bool calm, double calm_speed,
                            double now) {
    link.pressed = contact.impulse > 0;
    if (!link.pressed) return;
    link.last = contact;
    if (calm) return;  // rest is stated when the island falls asleep
    const EventKind kind = kind_of_slip(contact.slip_after.norm(), calm_speed);
    if (!link.kind.persists(kind, now, kind_steps::kStep) || row_waits(link, now)) return;
    if (link.kind.state(kind)) log_.add(kind, contact, now);
}

/// Links of a ball that are no more. Of two balls, the scene's first one writes the row.
void IslandLinks::note_departures(int ball, const std::vector<Link>& before, double now) {
    for (const Link& link : before) {
        if (links_.linked(ball, link.partner)) continue;
        if (!link.partner.is_surface && link.partner.index < ball) continue;
        if (link.kind.is_stated() || (link.kind.from_start() && link.pressed))
            log_.add(EventKind::kLeave, world_.contact_at(ball, link.partner, now), now);
    }
}

}  // namespace carom
