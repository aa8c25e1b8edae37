#include "sim/cluster.h"

#include <algorithm>

#include "core/check.h"

namespace carom {

namespace {

/// Approach speeds that differ by less, relative to the largest, are equal: they went through some
/// dozen roundings.
constexpr double kEqual = 1e-12;

/// What is left of the approach when a cluster counts as resolved, relative to the first.
constexpr double kResolved = 1e-13;

/// Rounds before what is left is solved as one inelastic contact. A chain of n balls needs about n
/// rounds; inelastic collapse would need infinitely many.
constexpr std::size_t kRounds = 2000;

}  // namespace

Cluster::Cluster(ExactWorld& world, const Contact& seed, const std::vector<Contact>& seeds,
                 double time)
    : world_(world), time_(time) {
    add(seed);
    grow(seeds);
}

std::size_t Cluster::index_of(int ball) const {
    const auto found = std::find(balls_.begin(), balls_.end(), ball);
    CAROM_CHECK(found != balls_.end(), ==, true);
    return static_cast<std::size_t>(found - balls_.begin());
}

void Cluster::add_ball(int ball) {
    if (std::find(balls_.begin(), balls_.end(), ball) != balls_.end()) return;
    balls_.push_back(ball);
    const BallState now = world_.state(ball, time_);
    const Ball& b = world_.body(ball);
    bodies_.push_back({now.position,
                       {now.velocity, now.spin},
                       b.mass,
                       b.inertia_factor * b.mass * b.radius * b.radius});
}

void Cluster::add_contact(const Contact& contact) {
    const auto same = [&contact](const Contact& c) {
        return c.ball == contact.ball && c.other == contact.other;
    };
    if (std::none_of(contacts_.begin(), contacts_.end(), same)) contacts_.push_back(contact);
}

void Cluster::add(const Contact& contact) {
    add_contact(contact);
    add_ball(contact.ball);
    if (!contact.other.is_surface) add_ball(contact.other.index);
}

void Cluster::grow(const std::vector<Contact>& seeds) {
    const auto consider = [this](int ball, const Partner& partner) {
        const Contact contact = world_.contact_at(ball, partner, time_);
        if (world_.touches(contact, time_)) add(contact);
    };
    for (std::size_t k = 0; k < balls_.size(); ++k) {
        const int ball = balls_[k];
        for (const Contact& seed : seeds)
            if (seed.ball == ball || (!seed.other.is_surface && seed.other.index == ball))
                add(seed);
        for (int s = 0; s < static_cast<int>(world_.scene.surfaces.size()); ++s)
            consider(ball, {true, s});
        for (int other = 0; other < static_cast<int>(world_.balls.size()); ++other)
            if (other != ball) consider(ball, {false, other});
    }
}

double Cluster::approach(const Contact& c) const {
    const Velocities other =
        c.other.is_surface ? Velocities{} : bodies_[index_of(c.other.index)].velocities;
    return -relative_velocity(c, bodies_[index_of(c.ball)].velocities, other).dot(c.normal);
}

void Cluster::solve(ImpactSolver& solver, const std::vector<std::size_t>& chosen, bool inelastic,
                    std::vector<Contact>& impacts) {
    // The solver gets only the bodies at hand, under numbers of its own.
    std::vector<int> here;
    const auto number = [&here](int ball) {
        const auto found = std::find(here.begin(), here.end(), ball);
        if (found != here.end()) return static_cast<int>(found - here.begin());
        here.push_back(ball);
        return static_cast<int>(here.size()) - 1;
    };
    std::vector<Contact> contacts;
    for (const std::size_t i : chosen) {
        Contact c = contacts_[i];
        c.ball = number(c.ball);
        if (!c.other.is_surface) c.other.index = number(c.other.index);
        if (inelastic) c.restitution = 0;
        contacts.push_back(c);
    }
    std::vector<ImpactBody> bodies;
    for (const int ball : here) bodies.push_back(bodies_[index_of(ball)]);
    solver.solve(bodies, contacts, time_);
    for (std::size_t k = 0; k < here.size(); ++k)
        bodies_[index_of(here[k])].velocities = bodies[k].velocities;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        Contact solved = contacts[k];
        solved.ball = contacts_[chosen[k]].ball;
        solved.other = contacts_[chosen[k]].other;
        solved.impact = solved.approach_speed > 0;
        if (solved.impact) impacts.push_back(solved);
    }
}

void Cluster::resolve(ImpactSolver& solver, std::vector<Contact>& impacts) {
    for (std::size_t round = 0;; ++round) {
        std::vector<double> speeds;
        for (const Contact& c : contacts_) speeds.push_back(approach(c));
        const double largest = *std::max_element(speeds.begin(), speeds.end());
        if (round == 0) first_approach_ = largest;
        if (!(largest > kResolved * first_approach_)) return;
        const bool last = round > kRounds + contacts_.size();
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < contacts_.size(); ++i)
            if (last || speeds[i] >= largest * (1 - kEqual)) chosen.push_back(i);
        solve(solver, chosen, last, impacts);
        if (last) return;
    }
}

std::vector<Contact> Cluster::contacts_of(int ball) const {
    std::vector<Contact> result;
    for (const Contact& c : contacts_) {
        if (c.ball != ball && (c.other.is_surface || c.other.index != ball)) continue;
        result.push_back(c);
        result.back().separation_speed = -approach(c);
    }
    return result;
}

}  // namespace carom
