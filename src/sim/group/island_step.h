// One step of one island: from the balls as they are to how they move until the step's end.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/nearest.h"
#include "sim/solve/island_solver.h"
#include "sim/world/energy_account.h"
#include "sim/world/exact_world.h"
#include "sim/world/links.h"

namespace carom {

/// Length of a step of balls that hang together [s]. Their speeds are exact to second order in it,
/// and uniform sliding and rolling exactly; a contact that ends or begins to slip within a step
/// does so at its end.
inline constexpr double kIslandStep = 1.0 / 4000;

/// Length of a step of one ball on one contact [s]: on a sphere, a capsule, an edge, or with a slip
/// that turns. The contact is kept, and the slip followed, to second order: a quarter of a second
/// of slip across a slope is right to 1e-10 m (tests/sim/curved_contact_test.cpp).
inline constexpr double kLoneStep = 1.0 / 32000;

/// Two bodies of an island are in contact up to this gap, as a fraction of the smaller radius: the
/// finest hop that a step can tell from contact, g h^2 = 6e-7 m, is larger for balls as we have.
inline constexpr double kLinkGap = 1e-6;

/// What gravity does to a speed in one step: the finest that a step can tell from 0 [m/s].
inline double slow_speed(const ExactWorld& world) {
    return world.scene.simulation.gravity.norm() * kIslandStep;
}

class IslandStep {
  public:
    /// How one ball moves from now on.
    struct Result {
        BallState start;
        Vec3 acceleration = Vec3::Zero();
        Vec3 spin_rate = Vec3::Zero();
    };

    /// `balls` are sorted, and closed under `links`.
    IslandStep(const ExactWorld& world, const Links& links, const std::vector<int>& balls,
               double now);

    /// Shorter after solve() where the energy would have risen on the way.
    double seconds() const { return seconds_; }

    /// Moves overlapping balls apart, the lighter ones more, as far as their speeds can pay for the
    /// lift: what rests stays as it is. Speeds are not touched yet.
    void correct_positions();
    void solve(IslandSolver& solver);
    /// Nothing moves, slips or changes its spin faster than this [m/s].
    bool is_calm(double speed) const;

    const Result& result(std::size_t i) const { return results_[i]; }
    /// Solved, under the scene's numbers of the balls.
    const std::vector<Contact>& contacts() const { return contacts_; }
    /// The impulse of the step on the ball of each contact, N s.
    const Vec3& push(std::size_t contact) const { return pushes_[contact]; }

  private:
    Nearest gap(const Contact& contact, double ahead) const;
    std::vector<ImpactBody> bodies(double ahead) const;
    std::vector<SolverContact> local_contacts(double ahead) const;
    void stop_approaches(IslandSolver& solver);
    void set_start(const std::vector<Velocities>& velocities);
    void resist_rolling(std::vector<ImpactBody>& moving,
                        const std::vector<SolverContact>& local) const;
    void set_rates();
    bool part_overlaps();
    std::vector<Vec3> start_places() const;
    std::vector<Velocities> start_velocities() const;
    std::vector<Vec3> end_places() const;
    std::size_t index_of(int ball) const;
    // Contacts and friction give no energy: what a step's error would add is taken from the speeds.
    void keep_energy_at_start();
    void keep_energy_at_end();
    double rise_within() const;

    const ExactWorld& world_;
    const std::vector<int>& balls_;
    double seconds_ = kIslandStep;
    EnergyAccount account_;  ///< with a potential of 0 at the start, before places are corrected
    double energy_ = 0;      ///< at the start, J
    std::vector<Result> results_;
    std::vector<Velocities> after_;
    std::vector<Contact> contacts_;
    std::vector<Vec3> pushes_;  ///< per contact; before solve(), of the step before
};

}  // namespace carom
