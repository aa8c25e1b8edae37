#include "sim/contact/restitution.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

PairTable::PairTable(const Scene& scene)
    : constant_(scene.simulation.restitution_constant), materials_(scene.materials) {
    const auto names_laws = [](const auto& named) {
        return named.restitution_law || named.rolling || named.pivoting ||
               named.tangential_restitution;
    };
    for (const Material& material : materials_) any_laws_ |= names_laws(material);
    // Of two rules for one pair the later one holds, key by key; the reader refuses such scenes.
    for (const PairRule& rule : scene.pairs) {
        any_laws_ |= names_laws(rule);
        PairRule& entry = overrides_[ordered(rule.between[0], rule.between[1])];
        if (rule.restitution || rule.restitution_law) {
            entry.restitution = rule.restitution;
            entry.restitution_law = rule.restitution_law;
        }
        if (rule.friction) entry.friction = rule.friction;
        if (rule.rolling) entry.rolling = rule.rolling;
        if (rule.pivoting) entry.pivoting = rule.pivoting;
        if (rule.tangential_restitution) entry.tangential_restitution = rule.tangential_restitution;
    }
    for (const Ball& ball : scene.balls) ++balls_of_[ball.material];
    for (const Surface& surface : scene.surfaces) of_surfaces_.insert(surface.material);
    any_friction_ = find_friction();
}

PairProperties PairTable::at(int material_a, int material_b) const {
    return at(material_a, materials_.at(static_cast<std::size_t>(material_a)).virtual_body,
              material_b, materials_.at(static_cast<std::size_t>(material_b)).virtual_body);
}

PairProperties PairTable::at(int material_a, const VirtualBody& a, int material_b,
                             const VirtualBody& b) const {
    const auto found =
        overrides_.empty() ? overrides_.end() : overrides_.find(ordered(material_a, material_b));
    const PairRule* rule = found == overrides_.end() ? nullptr : &found->second;
    PairProperties pair;
    const bool ruled = rule != nullptr && (rule->restitution || rule->restitution_law);
    if (ruled) {
        pair.restitution = rule->restitution.value_or(1);
    } else {
        const double time = contact_time(a, b);                   // Eq. 6
        pair.restitution = restitution_of_time(time, constant_);  // Eq. 7
    }
    pair.friction = rule != nullptr && rule->friction
                        ? *rule->friction
                        : product(&Material::friction, material_a, material_b);
    if (any_laws_) {
        pair.laws = laws_of(material_a, material_b, pair, rule);
        if (pair.laws != nullptr && pair.laws->by_speed())
            pair.restitution = pair.laws->restitution_at(0);
    }
    return pair;
}

/// Of a number against a reference of 1.
double PairTable::product(std::optional<double> Material::*factor, int a, int b) const {
    return (materials_[static_cast<std::size_t>(a)].*factor).value_or(0) *
           (materials_[static_cast<std::size_t>(b)].*factor).value_or(0);
}

/// Made when they are first asked for; null where the pair has none. `pair` has what is constant.
const ContactLaws* PairTable::laws_of(int a, int b, const PairProperties& pair,
                                      const PairRule* rule) const {
    const auto known = laws_.find(ordered(a, b));
    if (known != laws_.end()) return &known->second;
    const Material& of_a = materials_[static_cast<std::size_t>(a)];
    const Material& of_b = materials_[static_cast<std::size_t>(b)];
    const auto address = [](const std::optional<RestitutionLaw>& law) {
        return law ? &*law : nullptr;
    };
    ContactLaws laws;
    laws.constant = pair.restitution;
    if (rule != nullptr && (rule->restitution || rule->restitution_law)) {
        laws.first = address(rule->restitution_law);
    } else {
        laws.first = address(of_a.restitution_law);
        laws.second = address(of_b.restitution_law);
        if (laws.first == nullptr) std::swap(laws.first, laws.second);
    }
    const auto ruled = [rule](std::optional<double> PairRule::*key) {
        return rule == nullptr ? std::optional<double>() : rule->*key;
    };
    laws.tangential_restitution =
        ruled(&PairRule::tangential_restitution)
            .value_or(of_a.tangential_restitution || of_b.tangential_restitution
                          ? of_a.tangential_restitution.value_or(1) *
                                of_b.tangential_restitution.value_or(1)
                          : 0);
    laws.rolling = ruled(&PairRule::rolling).value_or(product(&Material::rolling, a, b));
    laws.pivoting =
        ruled(&PairRule::pivoting).value_or(of_a.pivoting.value_or(0) + of_b.pivoting.value_or(0));
    if (pair.friction == 0) laws.rolling = laws.tangential_restitution = 0;  // nothing grips
    return laws.is_plain() ? nullptr : &laws_.emplace(ordered(a, b), laws).first->second;
}

bool PairTable::may_meet(int a, int b) const {
    const auto balls = [this](int material) {
        const auto found = balls_of_.find(material);
        return found == balls_of_.end() ? 0 : found->second;
    };
    if (a == b) return balls(a) > 1 || (balls(a) > 0 && of_surfaces_.contains(a));
    return (balls(a) > 0 && (balls(b) > 0 || of_surfaces_.contains(b))) ||
           (balls(b) > 0 && of_surfaces_.contains(a));
}

bool PairTable::find_friction() const {
    for (const auto& [pair, rule] : overrides_)
        if (rule.friction.value_or(0) > 0 && may_meet(pair[0], pair[1])) return true;
    // Without a rule both must have it. Each pair that fails has a rule: that bounds the work.
    std::vector<int> rough;
    for (int material = 0; material < static_cast<int>(materials_.size()); ++material)
        if (materials_[static_cast<std::size_t>(material)].friction.value_or(0) > 0 &&
            (balls_of_.contains(material) || of_surfaces_.contains(material)))
            rough.push_back(material);
    for (int a : rough)
        for (int b : rough)
            if (balls_of_.contains(a) && may_meet(a, b) && at(a, b).friction > 0) return true;
    return false;
}

bool PairTable::any_loss() const {
    for (const auto& [a, balls] : balls_of_)
        for (int b = 0; b < static_cast<int>(materials_.size()); ++b) {
            if (!may_meet(a, b)) continue;
            const PairProperties pair = at(a, b);
            if (pair.restitution < 1 || pair.laws != nullptr) return true;
        }
    return false;
}

bool PairTable::any(bool (*has)(const ContactLaws&)) const {
    if (!any_laws_) return false;
    std::set<int> in_use = of_surfaces_;
    for (const auto& [material, balls] : balls_of_) in_use.insert(material);
    for (const auto& [a, balls] : balls_of_)
        for (const int b : in_use) {
            if (!may_meet(a, b)) continue;
            const ContactLaws* laws = at(a, b).laws;
            if (laws != nullptr && has(*laws)) return true;
        }
    return false;
}

}  // namespace carom
