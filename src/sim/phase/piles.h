// The pile of a run: who joins it, its steps, who leaves it or falls asleep.
#pragma once

#include <limits>
#include <vector>

#include "sim/group/pile.h"
#include "sim/phase/closed_forms.h"
#include "sim/phase/island_links.h"

namespace carom {

class Piles {
  public:
    Piles(ExactWorld& world, Links& links, RunLog& log, ClosedForms& forms)
        : world_(world),
          links_(links),
          log_(log),
          forms_(forms),
          pile_(world),
          recent_(world.balls.size()) {}

    /// s; infinite while there is no pile.
    double next_step() const { return next_step_; }
    const std::vector<int>& awake() const { return pile_.balls().awake(); }

    /// Called for each ball of an impact; one that has too many joins the pile.
    void note_impact(int ball, double now);
    /// The ball is taken in at a step now.
    void join(int ball, double now);
    /// One step. Then each ball that was awake may leave, one after the other; and the step ends.
    void step(double now);
    /// Out of the pile, into flight or onto a surface, or to sleep: whether it does.
    bool leave(int ball, double now);
    void end_step();

  private:
    bool stand_together(int ball, double now) const;
    void want(int ball, double now);
    void enter(int ball, double now);
    void move(int ball, double now);
    void lay_to_sleep(int ball, double now, double calm_speed);
    bool leaves_alone(int ball, double now, const Velocities& velocities);
    void state_pair(PilePair& pair, double now);
    Event event_of(const PilePair& pair, EventKind kind, double now) const;

    /// Impacts of a ball that come thick.
    struct RecentImpacts {
        double since = 0;  ///< s
        int count = 0;
    };

    ExactWorld& world_;
    Links& links_;
    RunLog& log_;
    ClosedForms& forms_;
    Pile pile_;
    double next_step_ = std::numeric_limits<double>::infinity();  ///< s
    std::vector<int> taken_;                                      ///< in the step at hand
    std::vector<RecentImpacts> recent_;                           ///< per ball
};

}  // namespace carom
