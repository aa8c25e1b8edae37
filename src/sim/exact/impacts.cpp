#include "sim/exact/impacts.h"

#include <algorithm>

#include "sim/group/island_step.h"

namespace carom {

namespace {

/// Impacts with a larger coefficient do not make a pile: a dense gas of balls that lose hardly
/// anything is followed impact by impact, so that its energy is kept.
constexpr double kMostOfPile = 0.9;

}  // namespace

void Impacts::begin_instant() {
    seeds_.clear();
    ++instant_;
}

std::size_t Impacts::connect(double now) {
    const std::size_t met = seeds_.all().size();
    const auto linked = [this](const Contact& c) {
        return has_links(c.ball) || (!c.other.is_surface && has_links(c.other.index));
    };
    if (std::any_of(seeds_.all().begin(), seeds_.all().end(), linked))
        for (const Contact& c : islands_.linked_contacts(seeds_.all(), now)) seeds_.add(c);
    return met;
}

/// What hangs on a contact that is met, and when that is resolved.
ImpactCascade::Limits Impacts::gather(const Contact& seed, double now) {
    const bool heap = may_collapse_ && seed.restitution < 1 &&
                      (collapse_.in_heap(seed.ball) ||
                       (!seed.other.is_surface && collapse_.in_heap(seed.other.index)));
    if (!heap) {
        cluster_.gather(seed, seeds_, now);
        return islands_.limits_of(cluster_);
    }
    cluster_.gather_heap(seed, seeds_, CollapseRule::kNear, now);
    ImpactCascade::Limits limits;
    if (cluster_.contact_count() == 1) {
        for (const int ball : cluster_.balls()) collapse_.leave_heap(ball);
    } else {
        limits.slow = CollapseRule::kSlow;
        ++log_.report.collapses;
    }
    return limits;
}

void Impacts::note_series(double now) {
    const auto note = [&](int ball, double approach) {
        collapse_.note(ball, world_.ball(ball).radius, approach, now);
    };
    for (const Contact& c : impacts_) {
        if (!(c.approach_speed > 0)) continue;
        note(c.ball, c.approach_speed);
        if (!c.other.is_surface) note(c.other.index, c.approach_speed);
    }
}

bool Impacts::resolve(std::size_t i, double now) {
    const Contact seed = seeds_.all()[i];
    if (world_.ball(seed.ball).resolved == instant_) return false;
    const ImpactCascade::Limits limits = gather(seed, now);
    impacts_.clear();
    cascade_.resolve(impacts_, limits);
    if (may_collapse_) note_series(now);
    const double rounding_speed =
        std::max(cluster_.rounding_speed(), limits.enough < slow_speed(world_) ? limits.enough : 0);
    log_.add_impacts(impacts_, now);
    for (const int ball : cluster_.balls()) {
        world_.ball(ball).resolved = instant_;
        world_.ball(ball).rounding_speed = rounding_speed;
    }
    aftermath_.settle(cluster_, cascade_.first_approach(), impacts_, now);
    return true;
}

bool Impacts::is_lossy() const {
    return std::any_of(impacts_.begin(), impacts_.end(),
                       [](const Contact& c) { return c.restitution <= kMostOfPile; });
}

}  // namespace carom
