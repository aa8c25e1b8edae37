#include "sim/group/pile_pairs.h"

#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"

namespace carom {

namespace {

/// Pairs up to this gap, as a part of the smallest radius, are kept from step to step; where balls
/// are so fast that it would not last for a step, up to the widest one.
constexpr double kSkinOfRadius = 0.4, kWidestSkin = 2;

}  // namespace

void PilePairs::age(double now, double fastest) {
    moved_ += 2 * std::max(fastest, fastest_) * (now - aged_);
    fastest_ = fastest;
    aged_ = now;
}

PilePair PilePairs::pair_of(int ball, const Partner& partner, double now, const Links& links,
                            bool slept) const {
    PilePair pair;
    pair.ball = ball;
    pair.other = partner;
    const ExactBall& held = world_.ball(ball);
    const int material = partner.is_surface ? world_.surface(partner.index).material
                                            : world_.ball(partner.index).material;
    const PairProperties both = world_.pair(held.material, material);
    pair.restitution = both.restitution;
    pair.friction = both.friction;
    pair.laws = both.laws;
    if (const Link* link = links.find(ball, partner)) {
        pair.kind.take_over(link->kind.stated());
        if (link->kind.from_start()) pair.kind.begins_at_start();
    } else if (partner.is_surface && held.surface == partner.index) {
        pair.kind.take_over(std::isinf(held.event_due) ? held.kind : EventKind::kLeave);
    } else if (slept) {
        pair.kind.take_over(EventKind::kRest);
    }
    if (now == 0) pair.kind.begins_at_start();
    return pair;
}

template <class F>
void PilePairs::for_each_new(int ball, double now, F&& f) const {
    const Vec3 x = balls_.of(ball).at.position;
    const double radius = world_.ball(ball).radius;
    world_.for_each_surface_near(ball, x, radius + skin_, [&](int s) {
        if (nearest_on(world_.surface(s).shape, x, radius).gap < skin_) f(ball, Partner{true, s});
    });
    const auto near = [&](int other) {
        if (balls_.is_awake(other) && !balls_.of(other).waits) return;
        const double reach = skin_ + radius + world_.ball(other).radius;
        if ((x - balls_.position(other, now)).squaredNorm() >= reach * reach) return;
        f(std::min(ball, other), Partner{false, std::max(ball, other)});
    };
    world_.for_each_touching(ball, x, radius + skin_, near);
}

void PilePairs::add_of(int ball, double now, const Links& links, bool slept) {
    const auto first = static_cast<std::ptrdiff_t>(pairs_.size());
    for_each_new(ball, now, [&](int a, const Partner& other) {
        pairs_.push_back(pair_of(a, other, now, links, slept));
    });
    std::sort(pairs_.begin() + first, pairs_.end(),
              [](const PilePair& a, const PilePair& b) { return a.key() < b.key(); });
}

void PilePairs::find(double now, double travel, const Links& links) {
    const double radius = balls_.smallest_radius();
    skin_ = std::clamp(2 * travel, kSkinOfRadius * radius, kWidestSkin * radius);
    // Only members that still wait for their turn are looked at: so each pair comes up once.
    found_.clear();
    for (const int ball : balls_.awake()) balls_.of(ball).waits = true;
    for (const int ball : balls_.awake()) {
        for_each_new(ball, now, [&](int a, const Partner& other) {
            found_.push_back({PilePair::key_of(a, other), a, other});
        });
        balls_.of(ball).waits = false;
    }
    std::sort(found_.begin(), found_.end(),
              [](const Found& a, const Found& b) { return a.key < b.key; });
    std::swap(pairs_, old_pairs_);
    const auto by_key = [](const PilePair& a, const PilePair& b) { return a.key() < b.key(); };
    if (!std::is_sorted(old_pairs_.begin(), old_pairs_.end(), by_key))
        std::sort(old_pairs_.begin(), old_pairs_.end(), by_key);
    pairs_.clear();
    auto old = old_pairs_.begin();
    for (const Found& found : found_) {
        while (old != old_pairs_.end() && old->key() < found.key) ++old;
        const bool known = old != old_pairs_.end() && old->key() == found.key;
        pairs_.push_back(known ? *old : pair_of(found.ball, found.other, now, links, false));
    }
    moved_ = 0;
}

void PilePairs::look_at(PilePair& pair, double now) const {
    const Vec3 x = balls_.position(pair.ball, now), v = balls_.velocity(pair.ball, now);
    const double radius = world_.ball(pair.ball).radius;
    if (pair.other.is_surface) {
        const Nearest nearest = nearest_on(world_.surface(pair.other.index).shape, x, radius);
        pair.normal = nearest.normal;
        pair.gap = nearest.gap;
        pair.closing = -v.dot(nearest.normal);
        return;
    }
    const Vec3 apart = x - balls_.position(pair.other.index, now);
    const double distance = apart.norm();
    pair.normal = distance > 0 ? Vec3(apart / distance) : Vec3::UnitZ();
    pair.gap = distance - radius - world_.ball(pair.other.index).radius;
    pair.closing = -(v - balls_.velocity(pair.other.index, now)).dot(pair.normal);
}

void PilePairs::tidy() {
    std::erase_if(pairs_, [this](const PilePair& p) {
        return !balls_.is_awake(p.ball) && (p.other.is_surface || !balls_.is_awake(p.other.index));
    });
}

}  // namespace carom
