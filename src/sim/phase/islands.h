// Islands: balls that lasting contacts hold together, integrated or stepped by ODE until they fall
// apart into balls that go on by themselves, become a pile, or come to rest.
#pragma once

#include <vector>

#include "sim/group/impact_cascade.h"
#include "sim/phase/coupled_islands.h"
#include "sim/phase/held_balls.h"
#include "sim/phase/island_links.h"
#include "sim/phase/stepped_islands.h"

namespace carom {

class Islands {
  public:
    /// `end` [s] of the motion.
    Islands(ExactWorld& world, Links& links, const ContactRules& rules, InstantNotes& notes,
            RunLog& log, ClosedForms& forms, HeldBalls& held, double end)
        : world_(world),
          links_(links),
          rules_(rules),
          notes_(notes),
          log_(log),
          forms_(forms),
          held_(held),
          island_links_(world, links, rules, notes, log),
          coupled_(world, links, notes, log, island_links_, end),
          stepped_(world, links, log, island_links_) {}

    /// The ball gets these velocities, and its island takes a step at once.
    void enter(int ball, double now, const Velocities& velocities) {
        island_links_.enter(ball, now, velocities);
    }
    bool has_part_in(const ImpactCluster& cluster) const;
    ImpactCascade::Limits limits_of(const ImpactCluster& cluster) const;
    /// The contacts that are met now, and those links through which they may act.
    std::vector<Contact> linked_contacts(const std::vector<Contact>& seeds, double now) const {
        return island_links_.linked_contacts(seeds, now);
    }

    struct Stepped {
        std::vector<int> balls;      ///< all that have something new before them
        std::vector<int> into_pile;  ///< of these: their island is a pile
    };
    /// The islands of these balls go on, those that are due.
    Stepped step(const std::vector<int>& balls, double now);

  private:
    bool is_pile(const std::vector<int>& island) const;
    bool leave(int ball, double now);
    void step_island(const std::vector<int>& island, double now);
    Vec3 resting_spin(int ball, const Vec3& spin) const;
    void fall_asleep(const std::vector<int>& balls, double now, double calm_speed);

    ExactWorld& world_;
    Links& links_;
    const ContactRules& rules_;
    const InstantNotes& notes_;
    RunLog& log_;
    ClosedForms& forms_;
    HeldBalls& held_;
    IslandLinks island_links_;
    CoupledIslands coupled_;
    SteppedIslands stepped_;
};

}  // namespace carom
