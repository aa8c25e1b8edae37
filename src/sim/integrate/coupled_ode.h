// The motion of a few linked balls as a differential equation, and its solutions from one state on.
#pragma once

#include "sim/integrate/single_ode.h"
#include "sim/law/coupled_forces.h"

namespace carom {

/// Per ball d (way since the start), v, w and the turn since the start.
using LinkedNumbers = std::array<double, 12 * kMostLinkedBalls>;

inline Vec3 part(const LinkedNumbers& y, std::size_t ball, std::size_t i) {
    const std::size_t at = 12 * ball + 3 * i;
    return {y[at], y[at + 1], y[at + 2]};
}

class LinkedCourse {
  public:
    LinkedCourse(const LinkedBalls& system, const LinkedState& start)
        : system_(system), start_(start) {}

    LinkedNumbers first() const;
    LinkedState state(const LinkedNumbers& y) const;
    LinkedForces forces(const LinkedState& s) const { return linked_forces(system_, s); }

    /// Goes on from y. Throws odeint's own error when it makes no progress.
    void advance(LinkedNumbers& y, double seconds) const;

    const LinkedBalls& system() const { return system_; }
    const LinkedState& start() const { return start_; }

  private:
    const LinkedBalls& system_;
    const LinkedState& start_;
};

}  // namespace carom
