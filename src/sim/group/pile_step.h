// One step of a pile: impacts at its start, then forces, then what they leave of overlaps.
#pragma once

#include <vector>

#include "sim/group/pile_pairs.h"

namespace carom {

/// Members move at constant accelerations from one step to the next; each step has two parts:
///   impacts: contacts that close faster than gravity makes them, and before the step ends, rebound
///     at its start by Newton's law, all others passing it on: they end the part at -gap/h or more;
///   forces: the midpoint rule of IslandSolver, (v + v')_n h / 2 >= -gap.
/// Neither gains energy, and what the unfinished iterations would leave of a gain is taken out of
/// the speeds.
class PileStep {
  public:
    PileStep(const ExactWorld& world, PileBalls& balls, PilePairs& pairs);

    /// The step of at most so many seconds from `now` on: those it takes, as no pair whose gap is
    /// wider than near_gap() may close in it. Pairs have been looked at at `now`.
    double solve(double now, double seconds);

    /// m: pairs up to here rebound at a step's start, early by no more than that.
    double near_gap() const;
    /// m: pairs up to here take part in a step.
    double slack(double seconds) const;
    /// s: until the first pair, closing like this, that is farther apart than near_gap() meets;
    /// `seconds` if that is less.
    double until_meeting(const PilePair& pair, double closing, double seconds) const;

    double longest() const { return longest_; }  ///< s: the step where nothing is fast
    /// What closes slower does not bounce: gravity makes half of it in the longest step [m/s].
    double slow_speed() const;
    /// m: of a pair that has parted again, and slept or slides no more.
    double separation_gap() const;

  private:
    void build_rows();
    void aim_at_mid_step(PileRow& row, const PilePair& pair) const;
    void solve_impacts();
    void shorten(double now);
    void solve_forces();
    void resist_rolling(const PilePair& pair, const PileRow& row);
    void note_contacts();
    double kinetic_energy() const;
    double kinetic_energy(int ball, const Velocities& velocities) const;
    double fall_energy() const;
    void slow_down(double too_much);
    void part_overlaps(double by_impacts, double by_forces);
    double part_pair(const PilePair& pair);

    const ExactWorld& world_;
    PileBalls& balls_;
    PilePairs& pairs_;
    std::vector<std::size_t> active_;  ///< the pairs in reach, one row each
    std::vector<PileRow> rows_;
    std::vector<Vec3> shift_;  ///< m, per ball of the scene
    double seconds_ = 0;
    double longest_ = 0;
};

}  // namespace carom
