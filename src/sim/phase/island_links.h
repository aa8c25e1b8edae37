// Which contacts of an island last, and what the events say about them.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/phase/contact_rules.h"
#include "sim/phase/run_log.h"

namespace carom {

/// Where there are more balls, three that touch will soon touch others, as in a box into which they
/// are poured: they are stepped from the beginning.
inline constexpr std::size_t kFewBalls = 20;
inline bool has_many_balls(const ExactWorld& world) { return world.balls.size() > kFewBalls; }

/// Makes and ends the links of islands.
class IslandLinks {
  public:
    IslandLinks(ExactWorld& world, Links& links, const ContactRules& rules, InstantNotes& notes,
                RunLog& log)
        : world_(world), links_(links), rules_(rules), notes_(notes), log_(log) {}

    /// The ball gets these velocities, and its island takes a step at once.
    void enter(int ball, double now, const Velocities& velocities);
    /// The contacts that are met now, and those links through which they may act.
    std::vector<Contact> linked_contacts(const std::vector<Contact>& seeds, double now) const;
    /// Forms the links of these balls anew. Returns them with all that hangs on them, sorted.
    std::vector<int> link_neighbours(std::vector<int> balls, double now);
    /// When the next event of a bouncing series that is over is due [s]; infinite if none is.
    double next_contact_event(const std::vector<int>& island, double now) const;

    /// The impulse of a step [N s] on the first ball of a contact, for the links of both.
    void note_push(const Contact& contact, const Vec3& push);
    /// A step's contact as solved. `calm`: its island moves no faster than this speed [m/s].
    void note_step(const Contact& contact, bool calm, double calm_speed, double now);
    /// Two of an integrated island part.
    void unlink(const Contact& contact, double now);

  private:
    void link_near(int ball, double now, std::vector<Link>& before);
    bool stays_together(const Contact& contact, double now, const Link* link);
    void add_link(const Contact& contact, int ball, const Partner& partner, const Link* before,
                  double now);
    void note_link(Link& link, const Contact& contact, bool calm, double calm_speed, double now);
    void note_departures(int ball, const std::vector<Link>& before, double now);

    ExactWorld& world_;
    Links& links_;
    const ContactRules& rules_;
    InstantNotes& notes_;
    RunLog& log_;
};

}  // namespace carom
