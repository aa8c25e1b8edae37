#include "sim/law/slip_onset.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Newton's method for one direction, and rounds over all of them: how many, and when it has come
/// to its end [rad].
constexpr int kMostSteps = 20;
constexpr int kMostRounds = 200;
constexpr double kSameDirection = 1e-14;

}  // namespace

SlipOnset::SlipOnset(const CoupledContacts& system, const ContactMotions& at) {
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& c = system.contacts[i];
        if (!c.presses || c.mode != ContactMode::kIncipient) continue;
        Start& s = starts_[count_++];
        s.contact = i;
        s.mu = c.friction;
        s.unit = system.weight_at(c);
        s.n = at[i].n;
        s.t = s.n.unitOrthogonal();
        s.u = s.n.cross(s.t);
    }
}

void SlipOnset::set_turning(const ContactMotions& at, std::span<const Vec3> turning) {
    for (std::size_t k = 0; k < count_; ++k) {
        Start& s = starts_[k];
        const Vec3 lag = at[s.contact].slip.norm() * turning[s.contact];
        s.lag = {s.t.dot(lag), s.u.dot(lag)};
    }
}

std::span<const ForceRow> SlipOnset::probe(std::size_t i) {
    if (i == 0) return {};
    const Start& s = starts_[(i - 1) / 2];
    const Vec3& along = i % 2 == 1 ? s.t : s.u;
    rows_[0] = {s.contact, s.n, along, s.unit * along, false};
    return {rows_.data(), 1};
}

SlipOnset::Vec2 SlipOnset::seen(const Start& start, const CoupledForces& forces) const {
    const Vec3& rate = forces.contacts[start.contact].slip_rate;
    return {start.t.dot(rate), start.u.dot(rate)};
}

void SlipOnset::take(std::size_t i, const CoupledForces& forces) {
    for (std::size_t k = 0; k < count_; ++k) {
        Start& s = starts_[k];
        const double push = forces.contacts[s.contact].push;
        if (i == 0) {
            s.s0 = seen(s, forces);
            s.n0 = push;
            continue;
        }
        const std::size_t by = (i - 1) / 2;
        const auto part = static_cast<Eigen::Index>((i - 1) % 2);
        s.a[by].col(part) = (seen(s, forces) - s.s0) / starts_[by].unit;
        s.b[by][part] = (push - s.n0) / starts_[by].unit;
    }
}

/// One direction, with the friction at the others as it is; returns how far it has turned.
double SlipOnset::settle(Start& start) const {
    const auto own = static_cast<std::size_t>(&start - starts_.data());
    Vec2 s0 = start.s0 - start.lag;
    double n0 = start.n0;
    for (std::size_t k = 0; k < count_; ++k) {
        if (k == own) continue;
        s0 += start.a[k] * starts_[k].f;
        n0 += start.b[k].dot(starts_[k].f);
    }
    const Eigen::Matrix2d& a = start.a[own];
    const Vec2& b = start.b[own];
    const Vec2 before = start.d;
    for (int step = 0; step < kMostSteps; ++step) {
        // s x d = 0, and its derivative by the angle of d.
        const Vec2 d = start.d, across(-d.y(), d.x());
        const double n = n0 / (1 + start.mu * b.dot(d));
        const double n_turn = -n * start.mu * b.dot(across) / (1 + start.mu * b.dot(d));
        const Vec2 s = s0 - start.mu * n * (a * d);
        const Vec2 s_turn = -start.mu * (a * (n_turn * d + n * across));
        const double turn = -across.dot(s) / (across.dot(s_turn) - d.dot(s));
        if (!std::isfinite(turn)) break;
        start.d = (d + std::clamp(turn, -0.5, 0.5) * across).normalized();
        if (std::abs(turn) < kSameDirection) break;
    }
    start.f = -start.mu * n0 / (1 + start.mu * b.dot(start.d)) * start.d;
    return (start.d - before).norm();
}

std::span<const ForceRow> SlipOnset::friction() {
    for (std::size_t k = 0; k < count_; ++k) {
        Start& s = starts_[k];
        s.d = (s.s0 - s.lag).stableNormalized();
        s.f = -s.mu * s.n0 * s.d;
    }
    for (int round = 0; round < kMostRounds; ++round) {
        double turned = 0;
        for (std::size_t k = 0; k < count_; ++k) turned = std::max(turned, settle(starts_[k]));
        if (turned < kSameDirection || count_ == 1) break;
    }
    for (std::size_t k = 0; k < count_; ++k) {
        const Start& s = starts_[k];
        rows_[k] = {s.contact, s.n, s.t, s.f.x() * s.t + s.f.y() * s.u, false};
    }
    return {rows_.data(), count_};
}

void SlipOnset::fill_directions(CoupledForces& forces) const {
    for (std::size_t k = 0; k < count_; ++k) {
        const Start& s = starts_[k];
        forces.contacts[s.contact].direction = s.d.x() * s.t + s.d.y() * s.u;
    }
}

}  // namespace carom
