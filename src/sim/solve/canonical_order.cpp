#include "sim/solve/canonical_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace carom {

namespace {

/// Slanted, so that rounding does not decide between balls in a column or a row.
const Vec3 kLine(1.0, 1.7, 2.3);

/// The same contact, seen from the other body.
SolverContact turned(SolverContact c) {
    std::swap(c.body, c.other_body);
    std::swap(c.arm, c.arm_other);
    c.normal = -c.normal;
    c.slip = -c.slip;
    c.slip_after = -c.slip_after;
    return c;
}

}  // namespace

CanonicalOrder::CanonicalOrder(const std::vector<ImpactBody>& bodies,
                               const std::vector<SolverContact>& contacts)
    : bodies_(bodies.size()),
      rank_(bodies.size()),
      contacts_(contacts.size()),
      turned_(contacts.size()) {
    std::vector<double> place;
    for (const ImpactBody& b : bodies) place.push_back(kLine.dot(b.position));
    std::iota(bodies_.begin(), bodies_.end(), 0);
    std::stable_sort(bodies_.begin(), bodies_.end(),
                     [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
    for (std::size_t k = 0; k < bodies_.size(); ++k) rank_[bodies_[k]] = k;
    using Key = std::tuple<std::size_t, std::size_t, double>;
    std::vector<Key> keys;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const SolverContact& c = contacts[i];
        turned_[i] = turns(c);
        const std::size_t a = rank_[static_cast<std::size_t>(c.body)];
        const std::size_t b =
            c.on_surface() ? bodies.size() : rank_[static_cast<std::size_t>(c.other_body)];
        keys.emplace_back(std::min(a, b), std::max(a, b), kLine.dot(c.normal));
    }
    std::iota(contacts_.begin(), contacts_.end(), 0);
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
    given_ = std::is_sorted(bodies_.begin(), bodies_.end()) &&
             std::is_sorted(contacts_.begin(), contacts_.end()) &&
             std::find(turned_.begin(), turned_.end(), true) == turned_.end();
}

bool CanonicalOrder::turns(const SolverContact& c) const {
    return !c.on_surface() && rank_[static_cast<std::size_t>(c.other_body)] <
                                  rank_[static_cast<std::size_t>(c.body)];
}

std::vector<ImpactBody> CanonicalOrder::sorted(const std::vector<ImpactBody>& bodies) const {
    std::vector<ImpactBody> result;
    for (const std::size_t i : bodies_) result.push_back(bodies[i]);
    return result;
}

std::vector<SolverContact> CanonicalOrder::sorted(
    const std::vector<SolverContact>& contacts) const {
    std::vector<SolverContact> result;
    for (const std::size_t i : contacts_) {
        SolverContact& c =
            result.emplace_back(turned_[i] ? turned(contacts[i]) : contacts[i]);
        c.body = static_cast<int>(rank_[static_cast<std::size_t>(c.body)]);
        if (!c.on_surface())
            c.other_body = static_cast<int>(rank_[static_cast<std::size_t>(c.other_body)]);
    }
    return result;
}

std::vector<Vec3> CanonicalOrder::sorted(const std::vector<Vec3>& impulses) const {
    std::vector<Vec3> result;
    for (const std::size_t i : contacts_)
        result.push_back(turned_[i] ? Vec3(-impulses[i]) : impulses[i]);
    return result;
}

void CanonicalOrder::put_back(const std::vector<ImpactBody>& sorted,
                              std::vector<ImpactBody>& bodies) const {
    for (std::size_t k = 0; k < bodies_.size(); ++k) bodies[bodies_[k]] = sorted[k];
}

void CanonicalOrder::put_back(const std::vector<SolverContact>& sorted,
                              std::vector<SolverContact>& contacts) const {
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        SolverContact& to = contacts[contacts_[k]];
        const int body = to.body, other = to.other_body;
        to = turned_[contacts_[k]] ? turned(sorted[k]) : sorted[k];
        to.body = body;
        to.other_body = other;
    }
}

void CanonicalOrder::put_back(const std::vector<Vec3>& sorted,
                              std::vector<Vec3>& impulses) const {
    for (std::size_t k = 0; k < contacts_.size(); ++k)
        impulses[contacts_[k]] = turned_[contacts_[k]] ? Vec3(-sorted[k]) : sorted[k];
}

}  // namespace carom
