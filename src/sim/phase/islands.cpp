#include "sim/phase/islands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/group/island_step.h"

namespace carom {

namespace {

/// An island of so many balls is a pile, and so is a smaller one that does not come to rest in this
/// time: in a pile one ball that rolls on does not keep the others awake.
constexpr std::size_t kPile = 24;
constexpr std::size_t kSmallPile = 4;
constexpr double kIslandRestlessSeconds = 1000 * kIslandStep;

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

bool Islands::has_part_in(const ImpactCluster& cluster) const {
    return std::any_of(cluster.balls().begin(), cluster.balls().end(),
                       [this](int ball) { return has_island(world_.ball(ball).phase()); });
}

/// In an island that ODE steps, what is slower than a step can tell is left to the step, and a pile
/// that goes on passing an impact to and fro is given up on as one inelastic contact. In others
/// nothing is too slow that is no rounding.
ImpactCascade::Limits Islands::limits_of(const ImpactCluster& cluster) const {
    ImpactCascade::Limits limits;
    for (const int ball : cluster.balls()) {
        const ExactBall& b = world_.ball(ball);
        if (!has_island(b.phase())) continue;
        limits.enough = std::max(limits.enough, b.rounding_speed);
        if (b.coarse) return {slow_speed(world_), kCoupledRounds * cluster.contact_count()};
    }
    return limits;
}

// ---- A step
// ---------------------------------------------------------------------------------------

Islands::Stepped Islands::step(const std::vector<int>& balls, double now) {
    std::vector<int> due;
    for (const int ball : balls)
        if (world_.ball(ball).phase() == Phase::kIsland &&
            world_.ball(ball).phase_end <= now * (1 + kSameInstant))
            due.push_back(ball);  // the others have taken their step with an island already
    Stepped result;
    result.balls = island_links_.link_neighbours(due, now);
    for (const std::vector<int>& island : islands_of(result.balls, links_)) {
        if (is_pile(island)) {
            result.into_pile.insert(result.into_pile.end(), island.begin(), island.end());
        } else if (island.size() > 1 || !leave(island.front(), now)) {
            step_island(island, now);
        }
    }
    return result;
}

/// Integrated if it can be.
void Islands::step_island(const std::vector<int>& island, double now) {
    switch (coupled_.integrate(island, now)) {
        case CoupledIslands::Outcome::kGoesOn:
            return;
        case CoupledIslands::Outcome::kRests:
            fall_asleep(island, now, 0);
            return;
        case CoupledIslands::Outcome::kImpossible:
            break;
    }
    if (const std::optional<double> calm_speed = stepped_.step(island, now))
        fall_asleep(island, now, *calm_speed);
}

bool Islands::is_pile(const std::vector<int>& island) const {
    if (island.size() < kSmallPile) return false;
    return island.size() >= kPile || std::any_of(island.begin(), island.end(), [this](int ball) {
               return links_.member(ball).stepped_seconds >= kIslandRestlessSeconds;
           });
}

/// A ball that is alone, or has just one contact, with a surface, needs no steps.
bool Islands::leave(int ball, double now) {
    std::vector<Link>& links = links_.of(ball);
    const BallState at = world_.state(ball, now);
    const Velocities velocities{at.velocity, at.spin};
    if (links.empty()) {
        forms_.begin_flight(ball, now, velocities);
        return true;
    }
    if (links.size() > 1 || !links.front().partner.is_surface) return false;
    if (held_.is_given_up(ball, now)) return false;
    const Link link = links.front();
    const Contact contact = world_.contact_at(ball, link.partner, now);
    // It joined because it met something: where nothing else tells whether the contact presses, a
    // step does.
    const double pressed_by = rules_.pressing(contact, now, velocities.linear);
    const bool presses = !world_.ball(ball).coarse && pressed_by > 0 &&
                         notes_.separation_of(contact, now) == nullptr;
    const double v = velocities.linear.dot(contact.normal);
    // Nothing brings it back.
    const bool parts =
        !world_.ball(ball).coarse && pressed_by == 0 &&
        notes_.landing_of(contact, now) == nullptr &&
        v > kStillFraction * velocities.linear.norm() + world_.ball(ball).rounding_speed;
    if (links_.member(ball).steps == 0 && !presses && !parts) return false;
    if (parts || (!presses && !link.pressed && v > 0)) {  // lifted off
        if (link.kind.is_stated() || link.kind.from_start())
            log_.add(EventKind::kLeave, contact, now);
        links.clear();
        forms_.begin_flight(ball, now, velocities);
        return true;
    }
    if (link.kind.is_stated()) {
        world_.ball(ball).surface = link.partner.index;
        world_.ball(ball).kind = link.kind.stated();
    }
    links.clear();
    // What another impact has lifted has no friction of its own to give back.
    const bool lands = notes_.landing_of(contact, now) != nullptr &&
                       (v <= 0 || now == 0 || log_.slid_in_impact(contact, now));
    const Velocities along = lands ? forms_.landed(ball, now, contact, velocities, v) : velocities;
    const Onset onset{std::max(link.event_due - now, 0.0), link.kind.from_start()};
    if (const auto stepped = held_.begin(ball, now, contact, along, onset))
        island_links_.enter(ball, now, *stepped);
    return true;
}

/// What is left of a spin where nothing slips: that about the normal which all contacts with
/// friction share.
Vec3 Islands::resting_spin(int ball, const Vec3& spin) const {
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
void Islands::fall_asleep(const std::vector<int>& balls, double now, double calm_speed) {
    for (const int ball : balls) {
        BallState at = world_.state(ball, now);
        at.velocity.setZero();
        at.spin = resting_spin(ball, at.spin);
        if (world_.ball(ball).radius * at.spin.norm() < calm_speed) at.spin.setZero();
        world_.set_phase(ball, Phase::kIslandAsleep);
        world_.begin_piece(ball, now, at, Vec3::Zero(), Vec3::Zero());
        for (Link& link : links_.of(ball)) {
            if (link.pressed && link.kind.state_rest()) log_.add(EventKind::kRest, link.last, now);
        }
    }
}

}  // namespace carom
