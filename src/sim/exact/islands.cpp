// Islands: balls that lasting contacts hold together, stepped by ODE until they fall apart into
// balls whose motion has a closed form, or come to rest.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/exact/run.h"
#include "sim/group/island_step.h"

namespace carom {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An island rests when none of its balls has moved faster than this fraction of g h for
/// kCalmSeconds: gravity sets nothing in motion there at more than 5e-5 g. What ODE's constraint
/// force mixing leaves of a resting pile's speeds is a hundred times less.
constexpr double kCalmFraction = 1e-3;
constexpr double kCalmSeconds = 20 * kIslandStep;

/// Of balls so small that gravity gives them no more than a step's speed over their own size, a
/// part of sqrt(g r), the speed that belongs to the smallest radius, stands in the place of g h.
constexpr double kSizeFraction = 8e-3;

/// It rests as well when none has been faster than this for so long: gravity does less than 1e-4 g.
constexpr double kSlowFraction = 2e-2;
constexpr double kSlowSeconds = 200 * kIslandStep;

/// Links that one impact can pass through at once, by Newton's law. What is left beyond them is
/// solved by the next step, without rebound.
constexpr std::size_t kMostCoupled = 40;

/// An island of so many balls is a pile, and so is a smaller one that does not come to rest in this
/// time: in a pile one ball that rolls on does not keep the others awake.
constexpr std::size_t kPile = 24;
constexpr std::size_t kSmallPile = 4;
constexpr double kRestlessSeconds = 1000 * kIslandStep;

/// Normals closer than this [rad] are one, along which a resting ball may spin.
constexpr double kSameNormal = 1e-9;

/// Rounds per contact of a cluster in an island.
constexpr std::size_t kCoupledRounds = 2;

/// The balls of `set`, sorted, as islands: in order of their first balls.
std::vector<std::vector<int>> islands_of(const std::vector<int>& set, const Links& links) {
    std::vector<std::vector<int>> islands;
    std::map<int, bool> taken;
    for (const int first : set) {
        if (taken[first]) continue;
        taken[first] = true;
        std::vector<int> island = {first};
        for (std::size_t k = 0; k < island.size(); ++k)
            for (const Link& link : links.of(island[k]))
                if (!link.partner.is_surface && !std::exchange(taken[link.partner.index], true))
                    island.push_back(link.partner.index);
        std::sort(island.begin(), island.end());
        islands.push_back(std::move(island));
    }
    return islands;
}

}  // namespace

// ---- Into an island
// ------------------------------------------------------------------------------

/// The ball gets these velocities, and its island takes a step at once.
void ExactRun::enter_island(int ball, double now, const Velocities& velocities) {
    ExactBall& b = world_.ball(ball);
    if (b.surface >= 0) {
        Link link;
        link.partner = {true, b.surface};
        link.last = world_.contact_at(ball, link.partner, now);
        link.stated = std::isinf(b.event_due) ? b.kind : EventKind::kLeave;
        if (!std::isinf(b.event_due)) link.event_due = b.event_due;
        links_.of(ball) = {link};
    }
    BallState at = world_.state(ball, now);
    at.velocity = velocities.linear;
    at.spin = velocities.spin;
    // Where balls are many, what they join is most likely stepped.
    if (!has_island(b)) b.coarse = has_many_balls();
    b.surface = -1;
    b.stepped = true;
    b.asleep = false;
    b.steps = b.calm_steps = b.slow_steps = 0;
    b.stepped_seconds = 0;
    b.event_due = kInfinity;
    b.phase_end = now;
    begin_piece(ball, now, at, Vec3::Zero(), Vec3::Zero());
}

/// The contacts that are met now, and those links through which they may act.
std::vector<Contact> ExactRun::linked_contacts(const std::vector<Contact>& seeds,
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

bool ExactRun::in_island(const ImpactCluster& cluster) const {
    return std::any_of(cluster.balls().begin(), cluster.balls().end(), [this](int ball) {
        return world_.ball(ball).stepped || world_.ball(ball).asleep;
    });
}

/// In an island that ODE steps, what is slower than a step can tell is left to the step, and a pile
/// that goes on passing an impact to and fro is given up on as one inelastic contact. In others
/// nothing is too slow that is no rounding.
ImpactCluster::Limits ExactRun::limits_of(const ImpactCluster& cluster) const {
    ImpactCluster::Limits limits;
    for (const int ball : cluster.balls()) {
        const ExactBall& b = world_.ball(ball);
        if (!has_island(b)) continue;
        limits.enough = std::max(limits.enough, b.rounding_speed);
        if (b.coarse) return {slow_speed(world_), kCoupledRounds * cluster.contact_count()};
    }
    return limits;
}

void ExactRun::settle_cluster(const ImpactCluster& cluster, double now) {
    const bool stepped = in_island(cluster);
    // What was left to a step has to be linked for it.
    const bool coarse = std::any_of(cluster.balls().begin(), cluster.balls().end(),
                                    [this](int ball) { return world_.ball(ball).coarse; });
    for (const int ball : cluster.balls()) {
        const Velocities& velocities = cluster.body(ball).velocities;
        if (stepped) {
            enter_island(ball, now, velocities);
            world_.ball(ball).coarse = coarse;
            continue;
        }
        // What touches at the start, and goes on to do so, is no news; nor is it if it bounced
        // first.
        const bool at_start = now == 0 && world_.ball(ball).surface < 0;
        cluster.contacts_of(ball, contacts_);
        settle(ball, now, velocities, contacts_, cluster.first_approach(), at_start);
    }
}

// ---- A step
// ---------------------------------------------------------------------------------------

void ExactRun::step_islands(const std::vector<int>& balls, double now) {
    std::vector<int> due;
    for (const int ball : balls)
        if (world_.ball(ball).stepped && world_.ball(ball).phase_end <= now * (1 + kSameInstant))
            due.push_back(ball);  // the others have taken their step with an island already
    const std::vector<int> set = link_neighbours(due, now);
    for (const std::vector<int>& island : islands_of(set, links_)) {
        if (is_pile(island)) {
            for (const int ball : island) want_in_pile(ball, now);
            next_step_ = now;
            continue;
        }
        if (island.size() == 1 && leave_island(island.front(), now)) continue;
        if (!integrate(island, now)) step_island(island, now);
    }
    for (const int ball : set) predict(ball, now);
}

bool ExactRun::is_pile(const std::vector<int>& island) const {
    if (island.size() < kSmallPile) return false;
    return island.size() >= kPile || std::any_of(island.begin(), island.end(), [this](int ball) {
               return world_.ball(ball).stepped_seconds >= kRestlessSeconds;
           });
}

/// A ball that is alone, or has just one contact, with a surface, needs no steps.
bool ExactRun::leave_island(int ball, double now) {
    std::vector<Link>& links = links_.of(ball);
    const BallState at = world_.state(ball, now);
    const Velocities velocities{at.velocity, at.spin};
    if (links.empty()) {
        begin_flight(ball, now, velocities);
        return true;
    }
    if (links.size() > 1 || !links.front().partner.is_surface) return false;
    const auto phase = integrated_.find(ball);
    if (phase != integrated_.end() && now < phase->second.stepped_until) return false;
    const Link link = links.front();
    const Contact contact = world_.contact_at(ball, link.partner, now);
    // It joined because it met something: where nothing else tells whether the contact presses, a
    // step does.
    const double pressed_by = pressing(contact, now, velocities.linear);
    const bool presses =
        !world_.ball(ball).coarse && pressed_by > 0 && separation_of(contact, now) == nullptr;
    const double v = velocities.linear.dot(contact.normal);
    // Nothing brings it back.
    const bool parts =
        !world_.ball(ball).coarse && pressed_by == 0 && landing_of(contact, now) == nullptr &&
        v > kStillFraction * velocities.linear.norm() + world_.ball(ball).rounding_speed;
    if (world_.ball(ball).steps == 0 && !presses && !parts) return false;
    if (parts || (!presses && !link.pressed && v > 0)) {  // lifted off
        if (link.stated != EventKind::kLeave || link.from_start)
            add_contact_event(contact, EventKind::kLeave, now);
        links.clear();
        begin_flight(ball, now, velocities);
        return true;
    }
    if (link.stated != EventKind::kLeave) {
        world_.ball(ball).surface = link.partner.index;
        world_.ball(ball).kind = link.stated;
    }
    links.clear();
    // What another impact has lifted has no friction of its own to give back.
    const bool lands =
        landing_of(contact, now) != nullptr && (v <= 0 || now == 0 || slid_in_impact(contact, now));
    begin_contact(ball, now, contact,
                  lands ? landed(ball, now, contact, velocities, v) : velocities,
                  std::max(link.event_due - now, 0.0), link.from_start);
    return true;
}

/// What gravity does to speeds in a step, or what is little for balls of this size, m/s.
double ExactRun::step_speed(const std::vector<int>& balls) const {
    double radius = kInfinity;
    for (const int ball : balls) radius = std::min(radius, world_.ball(ball).radius);
    return std::min(slow_speed(world_),
                    kSizeFraction * std::sqrt(world_.scene.simulation.gravity.norm() * radius));
}

void ExactRun::step_island(const std::vector<int>& balls, double now) {
    IslandStep step(world_, links_, balls, now);
    step.correct_positions();
    step.solve(island_solver_);
    ++report_.steps;

    const double calm_speed = kCalmFraction * step_speed(balls);
    const bool calm = step.is_calm(calm_speed);
    const bool slow = calm || step.is_calm(kSlowFraction / kCalmFraction * calm_speed);
    bool asleep = slow;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        ExactBall& b = world_.ball(balls[i]);
        const IslandStep::Result& r = step.result(i);
        b.calm_steps = calm ? b.calm_steps + 1 : 0;
        b.slow_steps = slow ? b.slow_steps + 1 : 0;
        asleep = asleep && (b.calm_steps * step.seconds() >= kCalmSeconds ||
                            b.slow_steps * step.seconds() >= kSlowSeconds);
        ++b.steps;
        b.stepped_seconds += step.seconds();
        b.phase_end = now + step.seconds();
        b.stepped = b.coarse = true;
        begin_piece(balls[i], now, r.start, r.acceleration, r.spin_rate);
    }
    for (std::size_t i = 0; i < step.contacts().size(); ++i) {
        const Contact& c = step.contacts()[i];
        note_push(c, kIslandStep / step.seconds() * step.push(i));
        for (Link& link : links_.of(c.ball)) {
            if (link.partner != c.other) continue;
            note_link(link, c, calm, calm_speed, now);
        }
    }
    if (asleep)
        fall_asleep(balls, now, calm ? calm_speed : kSlowFraction / kCalmFraction * calm_speed);
}

/// What is left of a spin where nothing slips: that about the normal which all contacts with
/// friction share.
Vec3 ExactRun::resting_spin(int ball, const Vec3& spin) const {
    const Link* first = nullptr;
    for (const Link& link : links_.of(ball)) {
        if (!link.pressed || link.last.friction == 0) continue;
        if (first != nullptr && link.last.normal.cross(first->last.normal).norm() > kSameNormal)
            return Vec3::Zero();
        first = &link;
    }
    if (first == nullptr) return spin;
    return spin.dot(first->last.normal) * first->last.normal;
}

/// The balls stop exactly where they are; spins about the normals of their contacts go on.
void ExactRun::fall_asleep(const std::vector<int>& balls, double now, double calm_speed) {
    for (const int ball : balls) {
        ExactBall& b = world_.ball(ball);
        BallState at = world_.state(ball, now);
        at.velocity.setZero();
        at.spin = resting_spin(ball, at.spin);
        if (world_.ball(ball).radius * at.spin.norm() < calm_speed) at.spin.setZero();
        b.stepped = false;
        b.asleep = true;
        b.phase_end = kInfinity;
        begin_piece(ball, now, at, Vec3::Zero(), Vec3::Zero());
        for (Link& link : links_.of(ball)) {
            const bool news = !link.from_start && link.stated != EventKind::kRest;
            if (link.pressed && news) add_contact_event(link.last, EventKind::kRest, now);
            if (link.pressed) link.stated = EventKind::kRest;
        }
    }
}

}  // namespace carom
