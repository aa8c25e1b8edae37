// What comes next to a ball if nothing else happens before.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "sim/phase/contact_rules.h"
#include "sim/phase/piles.h"

namespace carom {

enum class PredictionKind : std::uint8_t {
    kPhase,    ///< the end of a phase or of a step, or a row that is due
    kImpact,   ///< with `partner`
    kPresses,  ///< it touches something now and goes on to do so: its island takes a step at once
    kCell      ///< the ball leaves its cell of the grid
};

struct alignas(64) Prediction {
    double time = 0;
    int ball = -1;
    std::uint64_t stamp = 0;
    PredictionKind kind = PredictionKind::kPhase;
    Partner partner;
    std::uint64_t partner_stamp = 0;
    double seconds = 0;  ///< since the start of the ball's piece: finer than `time` can say
    double leaves_cell = std::numeric_limits<double>::infinity();  ///< s, if that comes before
};

/// A ball's prediction, and what was found on the way to it.
struct Outlook {
    struct Pressing {
        Contact contact;
        double event_due = 0;  ///< s, the end of its bouncing series
    };
    Prediction next;
    std::optional<Pressing> pressing;    ///< where kPresses rests on a contact that is no link yet
    std::vector<Contact> pressed_again;  ///< pairs that had separated at this instant
};

/// Looks ahead along the balls' paths. Asking changes nothing: whoever asks acts on the answer.
class Predictor {
  public:
    /// `end` [s] of the motion.
    Predictor(const ExactWorld& world, const Links& links, const InstantNotes& notes,
              const ContactRules& rules, const Piles& piles, double end)
        : world_(world), links_(links), notes_(notes), rules_(rules), piles_(piles), end_(end) {}

    /// From `now` [s] on, whatever is known already. Not for a ball that the pile moves.
    Outlook look_ahead(int ball, double now) const;
    /// Another ball has come into reach: it comes first in `out`, or not.
    void look_at_ball(Outlook& out, int other, double now) const {
        if (!falls_past(out, other)) look_closer(out, other, now);
    }

  private:
    void look_closer(Outlook& out, int other, double now) const;
    bool falls_past(const Outlook& out, int other) const;
    void look_at_surfaces(Outlook& out, double now) const;
    void look_at_surface(Outlook& out, int surface, double now) const;
    TimeOfImpact beside_held(int ball, int surface, const TimeOfImpact& toi, double from) const;
    bool is_beside_link(int ball, int surface, double now) const;
    bool joins_island(Outlook& out, const Partner& partner, double now) const;
    bool rests_against(int ball, const Partner& partner, double now) const;
    bool flies_along(int ball, const Partner& partner, double now) const;
    void press(Outlook& out, const Partner& partner, double now, double event_due) const;
    /// How a partner has been looked at: from `from` [s] on, when they touched or not, separating
    /// at `separation` [m/s].
    struct Look {
        Partner partner;
        bool touching = false;
        double separation = 0;
        double from = 0;
    };
    void keep_if_earlier(Outlook& out, const TimeOfImpact& toi, const Look& look, double now) const;
    /// m, where their paths lead at `time` [s].
    double gap_at(int ball, const Partner& partner, double time) const {
        return -world_.contact_at(ball, partner, time).depth;
    }

    const ExactWorld& world_;
    const Links& links_;
    const InstantNotes& notes_;
    const ContactRules& rules_;
    const Piles& piles_;
    double end_;
};

}  // namespace carom
