// Which contacts last, and what counts as none: the limits of the method `exact`.
#pragma once

#include <vector>

#include "sim/phase/instant_notes.h"
#include "sim/world/exact_world.h"
#include "sim/world/links.h"

namespace carom {

/// Answers from the balls' paths and the notes of the instant; changes nothing.
class ContactRules {
  public:
    ContactRules(const ExactWorld& world, const InstantNotes& notes)
        : world_(world), notes_(notes) {}

    /// m: a hop lower than this drowns in the rounding of the ball's place; or, where slow impacts
    /// lose ever less, so that bounces have no end, is a thousand times as high.
    double hop_limit(int ball, const Vec3& position, const ContactLaws* laws) const;
    /// What presses a ball of the velocity `velocity` [m/s] onto a surface, m/s^2: gravity and
    /// air, and on a surface that bends towards the ball, such as the inside of a ring, its own
    /// motion along it. 0 where that is none, but for rounding.
    double pressing(const Contact& contact, double now, const Vec3& velocity) const;
    /// m/s: a slip is none if it is rounding of the velocities, or ends within that of the time.
    double slip_tolerance(int ball, double now, const Velocities& velocities) const;
    /// Whether one of the contacts that a ball has at the start is an impact: it approaches, and
    /// faster than in the bounces that would be summed.
    bool approaches_at_start(int ball, const std::vector<Contact>& contacts) const;
    /// Whether a contact that does not approach is a lasting one; `bounce_time_left` [s] is how
    /// long its remaining bounces take: 2 v / (g_n (1 - e)), v the separation speed and g_n what
    /// presses at `velocity` [m/s].
    bool lasts(const Contact& contact, int ball, double now, const Vec3& velocity,
               double speed_scale, double& bounce_time_left) const;

    /// Whether the two of an island are near enough to touch: to rounding, or, where ODE steps one
    /// of them, to what a step can tell.
    bool in_reach(const Contact& contact) const;
    struct Together {
        bool lasts = false;
        bool presses_again = false;  ///< it had separated at this instant (InstantNotes)
    };
    /// Whether a contact of an island lasts: no gap, and no speed along the normal but for
    /// rounding. `link` is what is known of it, if it has lasted so far.
    Together stays_together(const Contact& contact, double now, const Link* link = nullptr) const;

  private:
    bool is_coarse(const Contact& contact) const;
    bool hops_on(const Contact& contact, const Link& link, double separation, double now) const;

    const ExactWorld& world_;
    const InstantNotes& notes_;
};

}  // namespace carom
