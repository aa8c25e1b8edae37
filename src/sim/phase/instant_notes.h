// What contacts did at the instant at hand, as far as paths and places do not tell it any more.
#pragma once

#include <vector>

#include "sim/contact/contact.h"

namespace carom {

/// A bouncing series that is over, or a contact that something presses: whatever speed is left
/// between the two, they touch from now on.
struct Landing {
    int ball = -1;
    Partner partner;
    double time = 0;       ///< s
    double event_due = 0;  ///< s, the end of the series
};

/// Two that touch, but do not press any more.
struct Separation {
    int ball = -1;
    Partner partner;
    double time = 0;       ///< s
    bool pressed = false;  ///< they do, as their paths say: no parting
};

/// Landings and separations by pair; those of earlier instants are forgotten.
class InstantNotes {
  public:
    void note_landing(const Contact& contact, double now, double event_due);
    /// Takes a landing of the pair back.
    void note_separation(const Contact& contact, double now);
    /// A pair that has separated now presses all the same; nothing if it has not.
    void note_press(const Contact& contact, double now);

    const Landing* landing_of(const Contact& contact, double now) const;
    const Separation* separation_of(const Contact& contact, double now) const;

  private:
    std::vector<Landing> landings_;
    std::vector<Separation> separations_;
};

}  // namespace carom
