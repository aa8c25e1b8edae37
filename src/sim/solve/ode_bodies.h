// The bodies of an ODE world that serves one solution after the other.
#pragma once

#include <vector>

#include "sim/contact/solver_body.h"
#include "sim/solve/ode_handles.h"

namespace carom {

/// Grows to the most bodies of one solution; those that a smaller one does not need are disabled.
/// The world must outlive it.
class OdeBodies {
  public:
    /// Puts these bodies into the world. Their places are relative to the first one: ODE needs
    /// arms, not places in the world.
    void place(dWorldID world, const std::vector<ImpactBody>& bodies);
    /// Reads back the velocities of the bodies that were placed.
    void read(std::vector<ImpactBody>& bodies) const;
    /// Gives up all but the first `count`: ODE looks at every body in every step.
    void keep(std::size_t count);
    dBodyID at(int i) const { return bodies_[static_cast<std::size_t>(i)].id; }

  private:
    struct Body {
        dBodyID id = nullptr;
        double mass = 0, inertia = 0;  ///< as ODE knows them; setting them costs a matrix inverse
    };
    std::vector<Body> bodies_;
};

}  // namespace carom
