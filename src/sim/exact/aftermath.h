// What balls do after the impacts of an instant, and at the start.
#pragma once

#include <vector>

#include "sim/phase/islands.h"

namespace carom {

/// Hands each ball to the phase that follows: flight, a lasting contact, an island.
class Aftermath {
  public:
    Aftermath(ExactWorld& world, const ContactRules& rules, InstantNotes& notes, RunLog& log,
              ClosedForms& forms, HeldBalls& held, Islands& islands)
        : world_(world),
          rules_(rules),
          notes_(notes),
          log_(log),
          forms_(forms),
          held_(held),
          islands_(islands) {}

    /// A ball as the scene has it, at time 0.
    void start(int ball);
    /// The balls of a cluster that has been resolved; `impacts` are those of it that met.
    void settle(const ImpactCluster& cluster, double first_approach,
                const std::vector<Contact>& impacts, double now);

  private:
    /// What the lasting contacts of a ball are told from, besides their own speeds.
    struct Scale {
        double speed = 0;  ///< m/s: relative speeds of this times kStillFraction are none
        bool at_start = false;
    };
    void settle_ball(int ball, double now, const Velocities& velocities,
                     const std::vector<Contact>& contacts, const std::vector<Contact>& impacts,
                     const Scale& scale);
    double bounce_of(const Contact& contact, const std::vector<Contact>& impacts) const;

    ExactWorld& world_;
    const ContactRules& rules_;
    InstantNotes& notes_;
    RunLog& log_;
    ClosedForms& forms_;
    HeldBalls& held_;
    Islands& islands_;
    std::vector<Contact> contacts_;  ///< a member, so that an event allocates nothing
};

}  // namespace carom
