#include "sim/contact/restitution.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace carom {

namespace {

std::array<int, 2> ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

double virtual_time(const VirtualBody& body) {
    if (body.distance_m == 0) return 0;  // also where v = 0, which would be 0 / 0
    return body.distance_m / (2 * body.velocity_m_s);
}

double contact_time(const VirtualBody& a, const VirtualBody& b) {
    return virtual_time(a) + virtual_time(b);
}

double restitution_of_time(double time, double constant) {
    if (std::isinf(time)) return 0;  // also where K = 0, which would be exp(-0 * infinity)
    return std::exp(-constant * time);
}

PairTable::PairTable(const Scene& scene) : constant_(scene.simulation.restitution_constant) {
    for (const Material& material : scene.materials) {
        bodies_.push_back(material.virtual_body);
        friction_.push_back(material.friction.value_or(0));
    }
    // Of two rules for one pair the later one holds, key by key; the reader refuses such scenes.
    for (const PairRule& rule : scene.pairs) {
        Override& entry = overrides_[ordered(rule.between[0], rule.between[1])];
        if (rule.restitution) entry.restitution = rule.restitution;
        if (rule.friction) entry.friction = rule.friction;
    }
    any_friction_ = scene_has_friction(scene);
}

PairProperties PairTable::at(int material_a, int material_b) const {
    return at(material_a, bodies_.at(static_cast<std::size_t>(material_a)), material_b,
              bodies_.at(static_cast<std::size_t>(material_b)));
}

PairProperties PairTable::at(int material_a, const VirtualBody& a, int material_b,
                             const VirtualBody& b) const {
    const auto rule =
        overrides_.empty() ? overrides_.end() : overrides_.find(ordered(material_a, material_b));
    const bool ruled = rule != overrides_.end();
    PairProperties pair;
    if (ruled && rule->second.restitution) {
        pair.restitution = *rule->second.restitution;
    } else {
        const double time = contact_time(a, b);                   // Eq. 6
        pair.restitution = restitution_of_time(time, constant_);  // Eq. 7
    }
    if (ruled && rule->second.friction) {
        pair.friction = *rule->second.friction;
    } else {
        pair.friction = friction_.at(static_cast<std::size_t>(material_a)) *
                        friction_.at(static_cast<std::size_t>(material_b));
    }
    return pair;
}

bool PairTable::scene_has_friction(const Scene& scene) const {
    std::set<int> of_balls, of_surfaces;
    std::set<int> seen_twice;  // materials that two balls share
    for (const Ball& ball : scene.balls)
        if (!of_balls.insert(ball.material).second) seen_twice.insert(ball.material);
    for (const Surface& surface : scene.surfaces) of_surfaces.insert(surface.material);
    const auto may_meet = [&](int a, int b) {
        if (a == b)
            return seen_twice.count(a) > 0 || (of_balls.count(a) > 0 && of_surfaces.count(a) > 0);
        const bool first = of_balls.count(a) > 0, second = of_balls.count(b) > 0;
        return (first && (second || of_surfaces.count(b) > 0)) ||
               (second && of_surfaces.count(a) > 0);
    };
    for (const auto& [pair, rule] : overrides_)
        if (rule.friction.value_or(0) > 0 && may_meet(pair[0], pair[1])) return true;
    // Without a rule both must have it. Each pair that fails has a rule: that bounds the work.
    std::vector<int> rough;
    for (int material = 0; material < static_cast<int>(friction_.size()); ++material)
        if (friction_[static_cast<std::size_t>(material)] > 0 &&
            (of_balls.count(material) > 0 || of_surfaces.count(material) > 0))
            rough.push_back(material);
    for (int a : rough)
        for (int b : rough)
            if (of_balls.count(a) > 0 && may_meet(a, b) && at(a, b).friction > 0) return true;
    return false;
}

}  // namespace carom
