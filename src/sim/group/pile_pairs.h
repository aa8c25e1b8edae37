// Who is near whom in a pile.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/group/pile_balls.h"
#include "sim/record/stated_kind.h"
#include "sim/world/links.h"

namespace carom {

/// Two bodies of a pile that are near each other, and what is known of their contact.
struct PilePair {
    int ball = -1;  ///< of two balls the scene's first one
    Partner other;
    double restitution = 1, friction = 0;
    const ContactLaws* laws = nullptr;  ///< as in Touch
    // Of this step.
    Vec3 normal = Vec3::UnitZ();  ///< unit, towards `ball`
    double gap = 0;               ///< m
    double closing = 0;           ///< m/s, at the start
    bool bounces = false;         ///< an impact falls into this step
    double impact_push = 0;       ///< of that impact: along the normal, N s
    double impact_tangential = 0;
    double separation = 0;  ///< after it, m/s
    // Kept from step to step.
    double force = 0;                    ///< along the normal, N
    Vec3 friction_force = Vec3::Zero();  ///< N
    bool touching = false;
    double slip = 0;  ///< at the end of the step, m/s
    StatedKind kind;

    std::int64_t key() const { return key_of(ball, other); }
    /// What orders pairs: ball, then surfaces, then balls.
    static std::int64_t key_of(int ball, const Partner& other) {
        return (static_cast<std::int64_t>(ball) << 32) +
               (other.is_surface ? other.index : (std::int64_t{1} << 31) + other.index);
    }
};

/// The pairs of those awake with all that is nearer than a skin. The list holds until bodies may
/// have closed by that much: then it is made anew.
class PilePairs {
  public:
    PilePairs(ExactWorld& world, PileBalls& balls) : world_(world), balls_(balls) {}

    std::vector<PilePair>& all() { return pairs_; }
    const std::vector<PilePair>& all() const { return pairs_; }

    /// The time has come to `now`, and since then nothing was faster than `fastest` [m/s].
    void age(double now, double fastest);
    /// m: gaps of pairs that are not in the list are wider.
    double sight() const { return skin_ - moved_; }
    /// Whether all of the list has been found at this very instant.
    bool fresh() const { return moved_ == 0; }

    /// All pairs anew, for steps in which balls go as far as `travel` [m] or less; what was known
    /// of the old ones stays.
    void find(double now, double travel, const Links& links);
    /// The pairs of a new member that are not in the list: where it `slept`, those with members
    /// that are awake are there already.
    void add_of(int ball, double now, const Links& links, bool slept);
    /// Where the two stand, and how fast they close.
    void look_at(PilePair& pair, double now) const;
    /// Drops pairs of which nobody is awake: of sleepers nothing is to be solved, and they are
    /// found again when one wakes.
    void tidy();

  private:
    /// Calls f(ball, other) for each pair that add_of() has to add.
    template <class F>
    void for_each_new(int ball, double now, F&& f) const;
    PilePair pair_of(int ball, const Partner& partner, double now, const Links& links,
                     bool slept) const;

    ExactWorld& world_;
    PileBalls& balls_;
    struct Found {
        std::int64_t key = 0;
        int ball = -1;
        Partner other;
    };
    std::vector<PilePair> pairs_, old_pairs_;
    std::vector<Found> found_;
    double skin_ = 0;       ///< m: gaps up to here were found
    double moved_ = 1e300;  ///< m: how far pairs may have closed since
    double aged_ = 0;       ///< s, when that was last looked at
    double fastest_ = 0;    ///< m/s, then
};

}  // namespace carom
