// What the events say about one contact: whether it slides, rolls or rests, and since when that is
// known. All methods state kinds by these rules; what they see in a step is their own.
#pragma once

#include "motion/motion.h"

namespace carom {

/// Steps on end in which a contact is seen to be of one kind before that is stated: one step's
/// error must not tell of a change that is none.
namespace kind_steps {
inline constexpr int kStep = 3;   ///< of ODE, by either method
inline constexpr int kRest = 10;  ///< the same for a rest, which is awaited by a ball that turns
inline constexpr int kPile = 8;   ///< of a pile, whose forces go on converging from step to step
}  // namespace kind_steps

/// A contact that slips faster than `none` [m/s] slides, else it rolls.
inline EventKind kind_of_slip(double slip, double none) {
    return slip > none ? EventKind::kSlide : EventKind::kRoll;
}

class StatedKind {
  public:
    /// kSlide, kRoll or kRest as stated last; kLeave while nothing is.
    EventKind stated() const { return stated_; }
    bool is_stated() const { return stated_ != EventKind::kLeave; }
    /// It exists at time 0, and nothing has been stated yet: its first kind is no news.
    bool from_start() const { return from_start_; }
    void begins_at_start() { from_start_ = true; }
    /// Another kind has been seen of late.
    bool wavers() const { return candidate_ != stated_; }
    /// s, when the kind that was seen last was seen first.
    double since() const { return since_; }

    /// The kind of a contact that takes another one's place.
    void take_over(EventKind stated) { stated_ = stated; }

    /// A kind is seen at `now` [s], in a step of its own that does not count yet.
    void see(EventKind kind, double now) {
        if (kind == candidate_) return;
        candidate_ = kind;
        since_ = now;
        steps_ = 0;
    }
    /// The same in a step that counts. Whether the kind is to be stated: it is another one, and has
    /// been seen for so many steps.
    bool persists(EventKind kind, double now, int steps) {
        see(kind, now);
        return ++steps_ >= steps && kind != stated_;
    }
    /// States a kind. Whether that is an event.
    bool state(EventKind kind) {
        const bool news = !from_start_;
        from_start_ = false;
        stated_ = candidate_ = kind;
        return news;
    }
    /// States a rest that may be woken from. Whether that is an event.
    bool state_rest() {
        const bool news = !from_start_ && stated_ != EventKind::kRest;
        stated_ = EventKind::kRest;
        return news;
    }
    /// The contact is no more, or not a lasting one.
    void state_leave() { stated_ = candidate_ = EventKind::kLeave; }

  private:
    EventKind stated_ = EventKind::kLeave, candidate_ = EventKind::kLeave;
    double since_ = 0;
    int steps_ = 0;
    bool from_start_ = false;
};

}  // namespace carom
