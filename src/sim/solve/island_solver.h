// One step of balls that lasting contacts hold together, solved by ODE in a world of its own.
#pragma once

#include <memory>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

/// Advances velocities over a step in which contacts push, but do not bounce.
///
/// A ball's velocity goes from v to v' at constant acceleration, so that it moves by h (v + v')/2.
/// A contact with the gap d keeps that motion from ending in an overlap:
///   (v + v')_n h / 2 >= -d, with the normal n of the middle of the step.
/// The work of its normal force is then force times -d <= 0, and that of gravity is exact: no step
/// gains energy, and uniform rolling in a groove is exact (the midpoint rule of J. J. Moreau,
/// "Numerical aspects of the sweeping process", Computer Methods in Applied Mechanics and
/// Engineering 177, 1999).
class IslandSolver {
  public:
    IslandSolver();
    ~IslandSolver();
    IslandSolver(const IslandSolver&) = delete;
    IslandSolver& operator=(const IslandSolver&) = delete;

    /// `bodies` stand where they are in the middle of the step, with the velocities of its start;
    /// they get those of its end. Of `contacts`, whose `body` and `other_body` (unless a surface)
    /// index the bodies, normal, arms, depth (at the start of the step) and friction are used;
    /// slips, speeds and impulses are filled. `pushes`, one per contact, are the impulses of the
    /// step before on its ball [N s], zero for a new contact; they are replaced by those of this
    /// step. Never fails: where ODE's exact solver gives up, or would take too long, sweeps take
    /// the step.
    void step(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts,
              std::vector<Vec3>& pushes, const Vec3& gravity, double seconds);

  private:
    struct World;
    void add_joint(const SolverContact& contact, std::size_t index);
    void follow_slip(const SolverContact& contact, const ImpactBody& body, const Vec3& fall,
                     std::size_t index);
    bool solve_with_ode(std::vector<ImpactBody>& bodies, const std::vector<SolverContact>& contacts,
                        const Vec3& gravity, double seconds);

    std::unique_ptr<World> world_;
};

}  // namespace carom
