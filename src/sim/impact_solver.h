// Impacts of one instant, solved by ODE's contact joints in a world of its own: no gravity, no
// position correction, no constraint force mixing, so that one dWorldStep is Newton's and Coulomb's
// law to rounding (checked in tests/sim/impact_solver_test.cpp).
#pragma once

#include <memory>
#include <vector>

#include "sim/contact.h"

namespace carom {

/// A ball as an impact sees it.
struct ImpactBody {
    Vec3 position = Vec3::Zero();  ///< m
    Velocities velocities;
    double mass = 1;       ///< kg
    double inertia = 0.4;  ///< kg m^2, about any axis
};

class ImpactSolver {
  public:
    ImpactSolver();
    ~ImpactSolver();
    ImpactSolver(const ImpactSolver&) = delete;
    ImpactSolver& operator=(const ImpactSolver&) = delete;

    /// Solves all `contacts` at once. Their `ball` and `other` (unless a surface) index `bodies`;
    /// normal, arms, restitution and friction are used. Fills speeds, slips and impulses of the
    /// contacts, and the velocities of the bodies after the impact.
    /// Throws Failure(kRun) naming `time` [s] when ODE reports a problem.
    void solve(std::vector<ImpactBody>& bodies, std::vector<Contact>& contacts, double time);

  private:
    struct World;
    void prepare(const std::vector<ImpactBody>& bodies, std::vector<Contact>& contacts);
    void add_joint(const Contact& contact, std::size_t index);

    std::unique_ptr<World> world_;
};

}  // namespace carom
