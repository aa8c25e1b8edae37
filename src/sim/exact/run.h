// One run of the method `exact`: balls on their own clocks, and a queue of what happens next.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "sim/collide/can_collide.h"
#include "sim/exact/aftermath.h"
#include "sim/exact/exact.h"
#include "sim/exact/impacts.h"
#include "sim/exact/predictor.h"
#include "sim/exact/rest_watch.h"
#include "sim/phase/held_balls.h"
#include "sim/phase/islands.h"
#include "sim/phase/piles.h"
#include "sim/record/simulation_result.h"
#include "sim/world/event_queue.h"

namespace carom {

/// Takes the next event off the queue, has it resolved by those whose balls it concerns, asks the
/// predictor what comes next to these, and acts on the answer.
class ExactRun {
  public:
    ExactRun(const Scene& scene, double end, const ExactOptions& options);

    void run(const std::stop_token& stop, const SimulationProgress& progress, bool until_rest);
    SimulationResult finish();

  private:
    // The queue.
    bool is_current(const Prediction& p) const { return world_.ball(p.ball).stamp == p.stamp; }
    Prediction due(int ball) const;
    void fetch(int ball) const;
    void fetch_upcoming() const;
    void take_together(const Prediction& next);
    void predict(int ball, double now);
    void act_on(const Outlook& outlook, double now);
    void change_cell(int ball, double now);
    void fit_places(double now);
    bool is_dense() const;

    // The loop.
    void process_instant(double now);
    void collect(const Prediction& p, double now);
    void step_islands(double now);
    void step_pile(double now);
    void give_up_on(const Prediction& p);
    void report_progress(const std::stop_token& stop, const SimulationProgress& progress,
                         double now) const;

    ExactWorld world_;
    double end_;
    PieceTap tap_;
    Links links_;
    InstantNotes notes_;
    ContactRules rules_{world_, notes_};
    RunLog log_{world_};
    ClosedForms forms_{world_, rules_, log_, end_};
    HeldBalls held_{world_, rules_, notes_, log_, forms_};
    Islands islands_{world_, links_, rules_, notes_, log_, forms_, held_, end_};
    Piles piles_{world_, links_, log_, forms_};
    Predictor predictor_{world_, links_, notes_, rules_, piles_, end_};
    Aftermath aftermath_{world_, rules_, notes_, log_, forms_, held_, islands_};
    Impacts impacts_{world_, links_, log_, islands_, aftermath_};
    RestWatch rest_{world_, links_};
    EventQueue queue_;
    std::vector<Prediction> next_;  ///< per ball
    std::int64_t events_since_fit_ = 0, changes_since_fit_ = 0, impacts_at_fit_ = 0;
    bool fitted_ = false;
    CanCollide can_collide_;

    // Of one instant; members, so that an event allocates nothing once they have grown.
    std::vector<Prediction> together_;
    std::vector<int> stepped_;  ///< balls whose island is due
};

}  // namespace carom
