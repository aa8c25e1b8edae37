// Turns the contacts of steps into the events of a motion.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "motion/motion.h"
#include "sim/contact/contact.h"
#include "sim/record/stated_kind.h"

namespace carom {

/// An event of two that touch, at their contact; speeds and impulses are those of an impact alone.
inline Event event_at(const Contact& contact, EventKind kind, double time) {
    Event e;
    e.time = time;
    e.ball = contact.ball;
    e.other = contact.other;
    e.kind = kind;
    e.point = contact.point;
    e.normal = contact.normal;
    return e;
}

/// When two bodies count as moving, slipping, or staying together. The method's own resolution:
/// within a step of h seconds gravity alone changes a speed by g h.
struct EventRules {
    /// A contact whose normal speed after the step is below this stays together, m/s.
    double lasting_speed = 0;
    /// Speeds below this are none, m/s.
    double rest_speed = 0;
    /// Slips below this are none, m/s.
    double slip_speed = 0;

    /// Rules for steps of `step` seconds under gravity of `gravity` m/s^2; `speed` [m/s] is the
    /// largest speed at the start, whose rounding is the floor of all three.
    static EventRules for_steps(double step, double gravity, double speed);
};

/// Impacts are written as they come. Between them each pair is watched: it begins to slide, roll
/// or rest when it does so for some steps on end (dated to the first of them), and leaves when it
/// has not touched for some steps (dated to the first of them). What touches at time 0 gives no row
/// for the kind with which it begins.
class EventLog {
  public:
    EventLog(const EventRules& rules, int balls);

    /// The contacts of the step that starts at `time`, solved, and all balls' velocities after it.
    void add_step(double time, const std::vector<Contact>& contacts,
                  const std::vector<Velocities>& after);

    std::int64_t impacts() const { return impacts_; }
    /// Every ball rests on something, and no pair does anything else.
    bool all_at_rest() const;
    /// The events so far, in order of time; those of one instant in the order of the contacts.
    std::vector<Event> finish();

    /// Steps on end that make a kind of contact, a rest, a departure. A rest must be told from a
    /// ball that is about to roll away.
    static constexpr int kKindSteps = kind_steps::kStep;
    static constexpr int kRestSteps = kind_steps::kRest;
    static constexpr int kLeaveSteps = 3;

  private:
    struct Pair {
        Contact last;  ///< as it was when it last touched
        StatedKind kind;
        double gone_time = 0;  ///< s
        int gone_steps = 0;
        bool seen = false;  ///< in this step
    };
    using Key = std::pair<int, std::pair<bool, int>>;  ///< ball, other is a ball, other's index

    bool lasting(const Contact& contact) const;
    EventKind kind_of(const Contact& contact, const std::vector<Velocities>& after) const;
    void add_impact(double time, const Contact& contact);
    void watch(double time, const Contact& contact, const std::vector<Velocities>& after);
    void drop_departed(double time);
    void add_row(double time, EventKind kind, const Contact& contact);

    EventRules rules_;
    int balls_;
    bool first_step_ = true;
    std::int64_t impacts_ = 0;
    std::map<Key, Pair> pairs_;
    std::vector<Event> events_;
};

}  // namespace carom
