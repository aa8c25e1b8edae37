#include "sim/group/impact_cluster.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "geometry/nearest.h"
#include "sim/solve/contact_sweeps.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// Approach speeds that differ by less, relative to the largest, are equal: they went through some
/// dozen roundings.
constexpr double kEqual = 1e-12;

/// What is left of the approach when a cluster counts as resolved, relative to the first.
constexpr double kResolved = 1e-13;

/// Approach speeds below this are rounding of the velocities that they are differences of, relative
/// to the largest of those.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

/// Rounds of any cluster, and for each contact as a multiple of the root of the mass ratio.
constexpr double kRounds = 2000;
constexpr double kRoundsPerContact = 32;

/// No cluster gets more: some seconds. It is enough for mass ratios up to 1e13.
constexpr double kMostRounds = 2e7;

/// A gap above this part of the places is none of a contact, well above all roundings.
constexpr double kFar = 1e-6;

}  // namespace

// ---- Seeds
// --------------------------------------------------------------------------------------

void Seeds::clear() {
    for (const Contact& c : all_) {
        first_[static_cast<std::size_t>(c.ball)] = -1;
        if (!c.other.is_surface) first_[static_cast<std::size_t>(c.other.index)] = -1;
    }
    all_.clear();
    next_.clear();
}

int Seeds::next_of(int seed, int ball) const {
    const auto i = static_cast<std::size_t>(seed);
    return next_[i][all_[i].ball == ball ? 0 : 1];
}

void Seeds::add(const Contact& contact) {
    bool known = false;
    for_each_of(contact.ball, [&](const Contact& c) {
        known |= c.ball == contact.ball && c.other == contact.other;
    });
    if (known) return;
    const int index = static_cast<int>(all_.size());
    all_.push_back(contact);
    int& first = first_[static_cast<std::size_t>(contact.ball)];
    next_.push_back({first, -1});
    first = index;
    if (contact.other.is_surface) return;
    int& first_of_other = first_[static_cast<std::size_t>(contact.other.index)];
    next_.back()[1] = first_of_other;
    first_of_other = index;
}

// ---- Who touches whom
// ---------------------------------------------------------------------------

ImpactCluster::ImpactCluster(ExactWorld& world) : world_(world), place_(world.balls.size(), -1) {}

std::size_t ImpactCluster::index_of(int ball) const {
    CAROM_CHECK(has(ball), ==, true);
    return static_cast<std::size_t>(place_[static_cast<std::size_t>(ball)]);
}

void ImpactCluster::add_ball(int ball) {
    if (has(ball)) return;
    place_[static_cast<std::size_t>(ball)] = static_cast<int>(balls_.size());
    balls_.push_back(ball);
    const ExactBall& b = world_.ball(ball);
    const Velocities now = world_.velocities(ball, time_);
    bodies_.push_back({world_.position(ball, time_), now, b.mass,
                       b.inertia_factor * b.mass * b.radius * b.radius});
    largest_speed_ = std::max(largest_speed_, now.linear.norm() + b.radius * now.spin.norm());
}

void ImpactCluster::add(const Contact& contact) {
    contacts_.push_back(contact);
    add_ball(contact.ball);
    if (!contact.other.is_surface) add_ball(contact.other.index);
}

/// Whether a contact is among those of the ball at hand already.
bool ImpactCluster::is_known(int ball, const Partner& other) const {
    for (std::size_t i = first_of_ball_; i < contacts_.size(); ++i)
        if (contacts_[i].ball == ball && contacts_[i].other == other) return true;
    return false;
}

void ImpactCluster::add_new(const Contact& contact) {
    if (!is_known(contact.ball, contact.other)) add(contact);
}

void ImpactCluster::gather(const Contact& seed, const Seeds& seeds, double time) {
    near_ = 0;
    grow(seed, seeds, time);
}

void ImpactCluster::gather_heap(const Contact& seed, const Seeds& seeds, double near, double time) {
    near_ = near;
    grow(seed, seeds, time);
}

void ImpactCluster::grow(const Contact& seed, const Seeds& seeds, double time) {
    for (const int ball : balls_) place_[static_cast<std::size_t>(ball)] = -1;
    balls_.clear();
    bodies_.clear();
    contacts_.clear();
    time_ = time;
    first_approach_ = largest_speed_ = 0;
    add_ball(seed.ball);
    // The order of the balls follows the contacts, so that the same scene gives the same cluster.
    for (std::size_t k = 0; k < balls_.size(); ++k) {
        const int ball = balls_[k];
        first_of_ball_ = contacts_.size();
        seeds.for_each_of(ball, [&](const Contact& c) {
            // A ball-ball seed comes up twice: it is taken when the first of the two is looked at.
            const int partner = c.ball == ball ? c.other.index : c.ball;
            if (c.other.is_surface || !has(partner) || index_of(partner) > k) add(c);
        });
        touch_surfaces(ball);
        touch_balls(ball);
        merge_places(world_, bodies_[k].position, bodies_[k].velocities, contacts_, first_of_ball_,
                     [this](const Contact& gone, const Contact& kept) {
                         int& surface = world_.ball(gone.ball).surface;
                         if (surface == gone.other.index) surface = kept.other.index;
                     });
    }
}

/// `size`: of the smaller radius, m.
bool ImpactCluster::meets(const Contact& contact, double size) const {
    return -contact.depth <= near_ * size || world_.touches(contact, time_);
}

void ImpactCluster::touch_surfaces(int ball) {
    const Vec3 x = bodies_[index_of(ball)].position;
    const double radius = world_.ball(ball).radius;
    const double far =
        kFar * (radius + x.cwiseAbs().maxCoeff()) + world_.place_rounding + near_ * radius;
    world_.for_each_surface_near(ball, x, radius + far, [&](int s) {
        if (is_known(ball, {true, s})) return;
        // Far surfaces are the common case, as far balls are below.
        if (nearest_on(world_.surface(s).shape, x, radius).gap > far) return;
        const Contact contact = world_.contact_at(ball, {true, s}, time_);
        if (meets(contact, radius)) add(contact);
    });
}

void ImpactCluster::touch_balls(int ball) {
    const std::size_t place = index_of(ball);
    const Vec3 x = bodies_[place].position;
    const double radius = world_.ball(ball).radius;
    world_.for_each_near(ball, [&](int other) {
        if (has(other) && index_of(other) < place) return;  // looked at from the other side
        if (in_pile(world_.ball(other).phase())) return;    // met by steps of its own
        // Far pairs are the common case: a little more than the sum of the radii excludes them.
        const double reach = 1.001 * (radius + world_.ball(other).radius);
        const Vec3 y = world_.position(other, time_);
        if ((x - y).squaredNorm() > reach * reach + 1e-9 * x.squaredNorm()) return;
        const Contact contact = world_.contact_at(ball, {false, other}, time_);
        if (meets(contact, std::min(radius, world_.ball(other).radius))) add_new(contact);
    });
}

// ---- Resolving
// ----------------------------------------------------------------------------------

double ImpactCluster::approach(const Contact& c) const {
    const Velocities other =
        c.other.is_surface ? Velocities{} : bodies_[index_of(c.other.index)].velocities;
    return -relative_velocity(c, bodies_[index_of(c.ball)].velocities, other).dot(c.normal);
}

/// A contact under the numbers that its balls have in the cluster.
SolverContact ImpactCluster::under_own_numbers(const Contact& c) const {
    return {c, static_cast<int>(index_of(c.ball)),
            c.other.is_surface ? -1 : static_cast<int>(index_of(c.other.index))};
}

/// The contacts that approach at least so fast, for the solver: only the bodies at hand, under
/// numbers of its own.
void ImpactCluster::choose(double slowest) {
    chosen_.clear();
    here_.clear();
    solver_bodies_.clear();
    solver_contacts_.clear();
    number_.assign(balls_.size(), -1);
    const auto number = [this](int ball) {
        const std::size_t i = index_of(ball);
        if (number_[i] < 0) {
            number_[i] = static_cast<int>(here_.size());
            here_.push_back(i);
            solver_bodies_.push_back(bodies_[i]);
        }
        return number_[i];
    };
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        if (!(speeds_[i] >= slowest)) continue;
        chosen_.push_back(i);
        const Contact& c = contacts_[i];
        const int body = number(c.ball);
        solver_contacts_.emplace_back(c, body, c.other.is_surface ? -1 : number(c.other.index));
    }
}

void ImpactCluster::solve(ImpactSolver& solver, bool inelastic, double enough,
                          std::vector<Contact>& impacts) {
    if (inelastic)
        for (SolverContact& c : solver_contacts_) c.restitution = 0;
    solver.solve(solver_bodies_, solver_contacts_, time_);
    for (std::size_t k = 0; k < here_.size(); ++k)
        bodies_[here_[k]].velocities = solver_bodies_[k].velocities;
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
        const SolverContact& solved = solver_contacts_[k];
        if (impact_of_[chosen_[k]] >= 0 || solved.approach_speed > enough ||
            (inelastic && solved.impulse > 0))
            note_impulse(chosen_[k], solved, impacts);
    }
}

/// Adds what a contact took to its impact, which begins with the first.
void ImpactCluster::note_impulse(std::size_t contact, const SolverContact& solved,
                                 std::vector<Contact>& impacts) {
    int& entry = impact_of_[contact];
    if (entry >= 0) {
        Contact& impact = impacts[static_cast<std::size_t>(entry)];
        impact.impulse += solved.impulse;
        impact.tangential_impulse += solved.tangential_impulse;
        return;
    }
    entry = static_cast<int>(impacts.size());
    impacts.push_back({solved, contacts_[contact].ball, contacts_[contact].other});
    impacts.back().impact = true;
}

void ImpactCluster::end_impacts(std::vector<Contact>& impacts) {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        contacts_[i].separation_speed = -approach(contacts_[i]);
        if (const int entry = impact_of_[i]; entry >= 0)
            impacts[static_cast<std::size_t>(entry)].separation_speed =
                std::max(contacts_[i].separation_speed, 0.0);
    }
}

/// The common case, without rounds: nothing else hangs on the contact.
void ImpactCluster::resolve_single(ImpactSolver& solver, std::vector<Contact>& impacts,
                                   const Limits& limits) {
    Contact& contact = contacts_.front();
    first_approach_ = approach(contact);
    contact.separation_speed = -first_approach_;
    if (!(first_approach_ > std::max(kRounding * largest_speed_, limits.enough))) return;
    solver_contacts_.assign(1, under_own_numbers(contact));
    solver.solve(bodies_, solver_contacts_, time_);
    const SolverContact& solved = solver_contacts_.front();
    contact.separation_speed = solved.separation_speed;
    impacts.push_back({solved, contact.ball, contact.other});
    impacts.back().impact = true;
    impacts.back().separation_speed = std::max(solved.separation_speed, 0.0);
}

/// Of all contacts; and which are each ball's.
void ImpactCluster::find_speeds() {
    speeds_.clear();
    of_ball_.resize(balls_.size());
    for (std::vector<std::size_t>& list : of_ball_) list.clear();
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const Contact& c = contacts_[i];
        speeds_.push_back(approach(c));
        of_ball_[index_of(c.ball)].push_back(i);
        if (!c.other.is_surface) of_ball_[index_of(c.other.index)].push_back(i);
    }
}

/// After a round: of the balls that took part in it.
void ImpactCluster::update_speeds() {
    for (const std::size_t ball : here_)
        for (const std::size_t i : of_ball_[ball]) speeds_[i] = approach(contacts_[i]);
}

/// Rounds that suffice for whatever ends: a chain of n balls needs about n, and a ball between a
/// wall and another of mass ratio r about pi sqrt(r) (G. Galperin, "Playing pool with the number
/// pi", 2003), or, where each loses a part of the speed, some ten times as many until what is left
/// is rounding.
std::size_t ImpactCluster::rounds_to_end() const {
    double lightest = bodies_.front().mass, heaviest = lightest;
    for (const ImpactBody& b : bodies_) {
        lightest = std::min(lightest, b.mass);
        heaviest = std::max(heaviest, b.mass);
    }
    const double contacts = static_cast<double>(contacts_.size());
    const double rounds = kRounds + kRoundsPerContact * contacts * std::sqrt(heaviest / lightest);
    return static_cast<std::size_t>(std::min(rounds, kMostRounds));
}

void ImpactCluster::resolve(ImpactSolver& solver, std::vector<Contact>& impacts,
                            const Limits& limits) {
    if (contacts_.size() == 1) {
        resolve_single(solver, impacts, limits);
        return;
    }
    impact_of_.assign(contacts_.size(), -1);
    find_speeds();
    const std::size_t rounds = limits.rounds > 0 ? limits.rounds : rounds_to_end();
    for (std::size_t round = 0;; ++round) {
        const double largest = *std::max_element(speeds_.begin(), speeds_.end());
        if (round == 0) first_approach_ = largest;
        const double enough = std::max({std::max(kResolved, limits.slow) * first_approach_,
                                        kRounding * largest_speed_, limits.enough});
        if (!(largest > enough)) break;
        const bool last = round > rounds + contacts_.size();
        if (last && limits.enough > 0) {
            press_together();
            break;
        }
        choose(last ? -std::numeric_limits<double>::infinity() : largest * (1 - kEqual));
        solve(solver, last, enough, impacts);
        if (last) break;
        update_speeds();
    }
    if (limits.slow > 0) press_rest(solver, impacts);
    end_impacts(impacts);
}

/// All contacts at once, none of which rebounds.
void ImpactCluster::press_rest(ImpactSolver& solver, std::vector<Contact>& impacts) {
    choose(-std::numeric_limits<double>::infinity());
    solve(solver, true, std::numeric_limits<double>::infinity(), impacts);
}

void ImpactCluster::contacts_of(int ball, std::vector<Contact>& result) const {
    result.clear();
    for (const Contact& c : contacts_) {
        if (c.ball != ball && (c.other.is_surface || c.other.index != ball)) continue;
        result.push_back(c);
    }
}

/// Ends an impact that a pile passes to and fro: nothing rebounds any more.
void ImpactCluster::press_together() {
    std::vector<SolverContact> contacts;
    for (const Contact& c : contacts_) contacts.push_back(under_own_numbers(c));
    std::vector<Vec3> pushes(contacts.size(), Vec3::Zero());
    solve_island_by_gauss_seidel(bodies_, contacts, std::vector<double>(contacts.size(), 0.0),
                                 pushes);
}

std::vector<Contact> ImpactCluster::contacts_of(int ball) const {
    std::vector<Contact> result;
    contacts_of(ball, result);
    return result;
}

}  // namespace carom
