// Which pairs of bodies are in a lasting contact that ODE steps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "motion/motion.h"
#include "sim/contact/contact.h"
#include "sim/record/stated_kind.h"

namespace carom {

/// A lasting contact as one of its balls sees it.
struct Link {
    Partner partner;
    Vec3 push =
        Vec3::Zero();  ///< impulse of the last step on the scene's first ball of the two, N s
    bool slip_begins = false;  ///< integrated, and its slip is incipient
    // What the rows of EVENTS.csv say about it, kept with the ball that the scene names first.
    Contact last;  ///< as it was when it last pressed
    bool pressed = false;
    double event_due = 0;  ///< s: the end of its bouncing series, before which nothing is stated
    StatedKind kind;
};

/// A ball as a member of its island, since it joined.
struct IslandMember {
    int steps = 0;               ///< taken or integrated
    double stepped_seconds = 0;  ///< of those that ODE took, s
    int calm_steps = 0;          ///< on end, in which it hardly moved
    int slow_steps = 0;          ///< on end, in which it moved, but slowly
};

/// Instants that differ by so many roundings are one.
inline constexpr double kSameInstant = 16 * std::numeric_limits<double>::epsilon();

/// Whether the bounces before a contact are not over at `now` [s].
inline bool row_waits(const Link& link, double now) {
    return link.event_due > now * (1 + kSameInstant);
}

/// Per ball, its links and what it is to its island. A link between two balls stands with both of
/// them.
class Links {
  public:
    explicit Links(std::size_t balls) : of_(balls), members_(balls) {}

    IslandMember& member(int ball) { return members_[static_cast<std::size_t>(ball)]; }
    const IslandMember& member(int ball) const { return members_[static_cast<std::size_t>(ball)]; }

    std::vector<Link>& of(int ball) { return of_[static_cast<std::size_t>(ball)]; }
    const std::vector<Link>& of(int ball) const { return of_[static_cast<std::size_t>(ball)]; }
    bool linked(int ball, const Partner& partner) const { return find(ball, partner) != nullptr; }
    const Link* find(int ball, const Partner& partner) const {
        const auto& links = of(ball);
        const auto found = std::find_if(links.begin(), links.end(), [&partner](const Link& link) {
            return link.partner == partner;
        });
        return found == links.end() ? nullptr : &*found;
    }

    /// The links of a ball end, on both sides.
    void drop(int ball) {
        for (const Link& link : of(ball))
            if (!link.partner.is_surface) unlink(link.partner.index, {false, ball});
        of(ball).clear();
    }
    /// A ball's own link to a partner ends, that of the partner to it stays.
    void unlink(int ball, const Partner& partner) {
        std::erase_if(of(ball), [&](const Link& link) { return link.partner == partner; });
    }

  private:
    std::vector<std::vector<Link>> of_;
    std::vector<IslandMember> members_;
};

}  // namespace carom
