#include "sim/group/impact_cascade.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/solve/contact_sweeps.h"

namespace carom {

namespace {

/// Approach speeds that differ by less, relative to the largest, are equal: they went through some
/// dozen roundings.
constexpr double kEqual = 1e-12;

/// What is left of the approach when a cluster counts as resolved, relative to the first.
constexpr double kResolved = 1e-13;

/// Approach speeds below this are rounding of the velocities that they are differences of, relative
/// to the largest of those.
constexpr double kCascadeRounding = 4 * std::numeric_limits<double>::epsilon();

/// Rounds of any cluster, and for each contact as a multiple of the root of the mass ratio.
constexpr double kRounds = 2000;
constexpr double kRoundsPerContact = 32;

/// No cluster gets more: some seconds. It is enough for mass ratios up to 1e13.
constexpr double kMostRounds = 2e7;

}  // namespace

/// A contact under the numbers that its balls have in the cluster.
SolverContact ImpactCascade::under_own_numbers(const Contact& c) const {
    return {c, static_cast<int>(cluster_.index_of(c.ball)),
            c.other.is_surface ? -1 : static_cast<int>(cluster_.index_of(c.other.index))};
}

/// The contacts that approach at least so fast, for the solver: only the bodies at hand, under
/// numbers of its own.
void ImpactCascade::choose(double slowest) {
    chosen_.clear();
    here_.clear();
    solver_bodies_.clear();
    solver_contacts_.clear();
    number_.assign(cluster_.balls().size(), -1);
    const auto number = [this](int ball) {
        const std::size_t i = cluster_.index_of(ball);
        if (number_[i] < 0) {
            number_[i] = static_cast<int>(here_.size());
            here_.push_back(i);
            solver_bodies_.push_back(cluster_.bodies()[i]);
        }
        return number_[i];
    };
    for (std::size_t i = 0; i < cluster_.contacts().size(); ++i) {
        if (!(speeds_[i] >= slowest)) continue;
        chosen_.push_back(i);
        const Contact& c = cluster_.contacts()[i];
        const int body = number(c.ball);
        solver_contacts_.emplace_back(c, body, c.other.is_surface ? -1 : number(c.other.index));
    }
}

void ImpactCascade::solve(bool inelastic, double enough, std::vector<Contact>& impacts) {
    if (inelastic)
        for (SolverContact& c : solver_contacts_) {
            c.restitution = 0;
            c.laws = nullptr;
        }
    solver_.solve(solver_bodies_, solver_contacts_, cluster_.time());
    for (std::size_t k = 0; k < here_.size(); ++k)
        cluster_.bodies()[here_[k]].velocities = solver_bodies_[k].velocities;
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
        const SolverContact& solved = solver_contacts_[k];
        if (impact_of_[chosen_[k]] >= 0 || solved.approach_speed > enough ||
            (inelastic && solved.impulse > 0))
            note_impulse(chosen_[k], solved, impacts);
    }
}

/// Adds what a contact took to its impact, which begins with the first.
void ImpactCascade::note_impulse(std::size_t contact, const SolverContact& solved,
                                 std::vector<Contact>& impacts) {
    int& entry = impact_of_[contact];
    if (entry >= 0) {
        Contact& impact = impacts[static_cast<std::size_t>(entry)];
        impact.impulse += solved.impulse;
        impact.tangential_impulse += solved.tangential_impulse;
        return;
    }
    entry = static_cast<int>(impacts.size());
    impacts.push_back(
        {solved, cluster_.contacts()[contact].ball, cluster_.contacts()[contact].other});
    impacts.back().impact = true;
}

void ImpactCascade::end_impacts(std::vector<Contact>& impacts) {
    for (std::size_t i = 0; i < cluster_.contacts().size(); ++i) {
        cluster_.contacts()[i].separation_speed = -cluster_.approach(cluster_.contacts()[i]);
        if (const int entry = impact_of_[i]; entry >= 0)
            impacts[static_cast<std::size_t>(entry)].separation_speed =
                std::max(cluster_.contacts()[i].separation_speed, 0.0);
    }
}

/// The common case, without rounds: nothing else hangs on the contact.
void ImpactCascade::resolve_single(std::vector<Contact>& impacts, const Limits& limits) {
    Contact& contact = cluster_.contacts().front();
    first_approach_ = cluster_.approach(contact);
    contact.separation_speed = -first_approach_;
    if (!(first_approach_ > std::max(kCascadeRounding * cluster_.largest_speed(), limits.enough)))
        return;
    solver_contacts_.assign(1, under_own_numbers(contact));
    solver_.solve(cluster_.bodies(), solver_contacts_, cluster_.time());
    const SolverContact& solved = solver_contacts_.front();
    contact.separation_speed = solved.separation_speed;
    impacts.push_back({solved, contact.ball, contact.other});
    impacts.back().impact = true;
    impacts.back().separation_speed = std::max(solved.separation_speed, 0.0);
}

/// Of all contacts; and which are each ball's.
void ImpactCascade::find_speeds() {
    speeds_.clear();
    of_ball_.resize(cluster_.balls().size());
    for (std::vector<std::size_t>& list : of_ball_) list.clear();
    for (std::size_t i = 0; i < cluster_.contacts().size(); ++i) {
        const Contact& c = cluster_.contacts()[i];
        speeds_.push_back(cluster_.approach(c));
        of_ball_[cluster_.index_of(c.ball)].push_back(i);
        if (!c.other.is_surface) of_ball_[cluster_.index_of(c.other.index)].push_back(i);
    }
}

/// After a round: of the balls that took part in it.
void ImpactCascade::update_speeds() {
    for (const std::size_t ball : here_)
        for (const std::size_t i : of_ball_[ball])
            speeds_[i] = cluster_.approach(cluster_.contacts()[i]);
}

/// Rounds that suffice for whatever ends: a chain of n balls needs about n, and a ball between a
/// wall and another of mass ratio r about pi sqrt(r) (G. Galperin, "Playing pool with the number
/// pi", 2003), or, where each loses a part of the speed, some ten times as many until what is left
/// is rounding.
std::size_t ImpactCascade::rounds_to_end() const {
    double lightest = cluster_.bodies().front().mass, heaviest = lightest;
    for (const ImpactBody& b : cluster_.bodies()) {
        lightest = std::min(lightest, b.mass);
        heaviest = std::max(heaviest, b.mass);
    }
    const auto contacts = static_cast<double>(cluster_.contacts().size());
    const double rounds = kRounds + kRoundsPerContact * contacts * std::sqrt(heaviest / lightest);
    return static_cast<std::size_t>(std::min(rounds, kMostRounds));
}

void ImpactCascade::resolve(std::vector<Contact>& impacts, const Limits& limits) {
    if (cluster_.contacts().size() == 1) {
        resolve_single(impacts, limits);
        return;
    }
    impact_of_.assign(cluster_.contacts().size(), -1);
    find_speeds();
    const std::size_t rounds = limits.rounds > 0 ? limits.rounds : rounds_to_end();
    for (std::size_t round = 0;; ++round) {
        const double largest = *std::max_element(speeds_.begin(), speeds_.end());
        if (round == 0) first_approach_ = largest;
        const double enough =
            std::max({std::max(kResolved, limits.slow) * first_approach_,
                      kCascadeRounding * cluster_.largest_speed(), limits.enough});
        if (!(largest > enough)) break;
        const bool last = round > rounds + cluster_.contacts().size();
        if (last && limits.enough > 0) {
            press_together();
            break;
        }
        choose(last ? -std::numeric_limits<double>::infinity() : largest * (1 - kEqual));
        solve(last, enough, impacts);
        if (last) break;
        update_speeds();
    }
    if (limits.slow > 0) press_rest(impacts);
    end_impacts(impacts);
}

/// All contacts at once, none of which rebounds.
void ImpactCascade::press_rest(std::vector<Contact>& impacts) {
    choose(-std::numeric_limits<double>::infinity());
    solve(true, std::numeric_limits<double>::infinity(), impacts);
}

/// Ends an impact that a pile passes to and fro: nothing rebounds any more.
void ImpactCascade::press_together() {
    solver_contacts_.clear();
    for (const Contact& c : cluster_.contacts()) solver_contacts_.push_back(under_own_numbers(c));
    std::vector<Vec3> pushes(solver_contacts_.size(), Vec3::Zero());
    solve_island_by_gauss_seidel(cluster_.bodies(), solver_contacts_,
                                 std::vector<double>(solver_contacts_.size(), 0.0), pushes);
}

}  // namespace carom
