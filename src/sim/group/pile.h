// Many balls close together, whose impacts are too many to be told apart: stepped together.
#pragma once

#include <vector>

#include "sim/group/pile_step.h"

namespace carom {

/// Its members, and its steps. A step ends when the next pair meets that was no neighbour at its
/// start, and after 1/1000 s at the latest (PileStep).
class Pile {
  public:
    explicit Pile(ExactWorld& world)
        : world_(world), balls_(world), pairs_(world, balls_), step_(world, balls_, pairs_) {}

    bool empty() const { return balls_.awake().empty() && wanted_.empty(); }
    PileBalls& balls() { return balls_; }
    const PileBalls& balls() const { return balls_; }
    std::vector<PilePair>& pairs() { return pairs_.all(); }
    const PileStep& rules() const { return step_; }
    double seconds() const { return seconds_; }  ///< of the step

    /// The ball shall be taken in at the next step.
    void want(int ball);
    /// Gathers who takes part in a step that begins now: members, and what comes into their reach.
    /// `taken` gets the balls that are new, or that woke: they are in the phase kPile from now on.
    void gather(double now, const Links& links, std::vector<int>& taken);
    /// Solves the step of what was gathered.
    void solve(double now) { seconds_ = step_.solve(now, seconds_); }
    /// After some have left or fallen asleep: drops what is no pair any more.
    void tidy();

  private:
    void take(int ball, double now, double wake_speed, const Links& links);
    bool draws_in(const PilePair& pair, double now, const Links& links, std::vector<int>& taken);
    bool draw_in(double now, const Links& links, std::vector<int>& taken);
    void find_pairs(double now, const Links& links);
    void look_at_pairs(std::size_t first, double now);

    ExactWorld& world_;
    PileBalls balls_;
    PilePairs pairs_;
    PileStep step_;
    std::vector<int> wanted_;
    double seconds_ = 0;
    double fastest_ = 0;  ///< m/s: no ball is faster at the step's start
};

}  // namespace carom
