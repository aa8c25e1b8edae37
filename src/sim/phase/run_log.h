// What a run of the method `exact` tells: events and counts.
#pragma once

#include <vector>

#include "motion/motion.h"
#include "sim/law/single_contact.h"
#include "sim/record/simulation_result.h"
#include "sim/world/exact_world.h"

namespace carom {

/// What the events call a contact of this mode while something moves.
inline EventKind kind_of(ContactMode mode) {
    return mode == ContactMode::kRolling ? EventKind::kRoll : EventKind::kSlide;
}

class RunLog {
  public:
    explicit RunLog(const ExactWorld& world) : world_(world) {}

    SimulationReport report;

    const std::vector<Event>& events() const { return events_; }
    std::vector<Event> take_events() { return std::move(events_); }
    /// To take away those before the instant at hand.
    std::vector<Event>& kept_events() { return events_; }
    void add(const Event& event) { events_.push_back(event); }
    /// A contact begins to slide, roll or rest, or is left.
    void add(EventKind kind, const Contact& contact, double now);
    /// The same of the contact that a single ball is held by.
    void add_of_held(EventKind kind, int ball, double now);
    void add_impacts(const std::vector<Contact>& impacts, double now);

    /// Whether the contact has slid all through an impact at this instant, the friction of which it
    /// gives back: that of an earlier one has had its effect, and that of one which gripped has
    /// stopped a slip that another bounce would find stopped.
    bool slid_in_impact(const Contact& contact, double now) const;

  private:
    const ExactWorld& world_;
    std::vector<Event> events_;
};

}  // namespace carom
