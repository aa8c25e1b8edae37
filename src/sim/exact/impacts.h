// The impacts of one instant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/exact/aftermath.h"
#include "sim/group/collapse.h"
#include "sim/group/impact_cascade.h"

namespace carom {

/// Collects what is met, resolves it cluster by cluster, and hands the balls on to what follows.
class Impacts {
  public:
    Impacts(ExactWorld& world, const Links& links, RunLog& log, Islands& islands,
            Aftermath& aftermath)
        : world_(world),
          links_(links),
          log_(log),
          islands_(islands),
          aftermath_(aftermath),
          cluster_(world),
          cascade_(cluster_),
          collapse_(world.balls.size()),
          in_free_space_(world.scene.simulation.gravity.isZero(0) || world.scene.surfaces.empty()),
          may_collapse_(in_free_space_ && world.pairs.any_loss()),
          seeds_(world.balls.size()) {}

    void begin_instant();
    void add(const Contact& met) { seeds_.add(met); }
    /// What hangs on what is met by a link is met as well. Returns how many contacts were added
    /// before: clusters grow from these.
    std::size_t connect(double now);
    /// Resolves the cluster that the i-th of them belongs to. False if that was done with another.
    bool resolve(std::size_t i, double now);
    /// The balls of the cluster that was resolved last.
    const std::vector<int>& balls() const { return cluster_.balls(); }
    /// Whether one of its impacts was of a kind that makes a pile.
    bool is_lossy() const;
    /// Whether nothing presses anything together anywhere: only there a collapse has no other end.
    bool is_in_free_space() const { return in_free_space_; }

  private:
    ImpactCascade::Limits gather(const Contact& seed, double now);
    void note_series(double now);
    bool has_links(int ball) const {
        return has_island(world_.ball(ball).phase()) && !links_.of(ball).empty();
    }

    ExactWorld& world_;
    const Links& links_;
    RunLog& log_;
    Islands& islands_;
    Aftermath& aftermath_;
    // Members, so that an event allocates nothing once they have grown.
    ImpactCluster cluster_;
    ImpactCascade cascade_;
    CollapseRule collapse_;
    bool in_free_space_, may_collapse_;
    Seeds seeds_;
    std::vector<Contact> impacts_;
    std::uint64_t instant_ = 0;
};

}  // namespace carom
