// Impacts of one instant. One contact has a closed form (contact_rows.h): both arms lie along its
// normal, so that Newton's law and Coulomb's are independent. Several are solved by ODE's contact
// joints in a world of its own: no gravity, no position correction, no constraint force mixing, so
// that one dWorldStep is both laws to rounding, as long as friction does not act on the normal
// impulses of others: it takes Coulomb's bounds from forces without friction, and a box for the
// cone. Where its answer does not obey both laws, they are solved together (coulomb_impact.h, which
// states them), and by sweeps (contact_sweeps.h) where contacts are too many, or ODE fails without
// friction. ODE's answer to one contact is the closed form to rounding, at several times the cost
// (tests/sim/impact_solver_test.cpp holds the two against each other).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

enum class SingleContacts { kClosedForm, kOde };

class ImpactSolver {
  public:
    explicit ImpactSolver(SingleContacts single = SingleContacts::kClosedForm);
    ~ImpactSolver();
    ImpactSolver(const ImpactSolver&) = delete;
    ImpactSolver& operator=(const ImpactSolver&) = delete;

    /// Solves all `contacts` at once. Their `body` and `other_body` (unless a surface) index
    /// `bodies`; normal, arms, restitution, friction and laws are used. Fills speeds, slips and
    /// impulses of the contacts, the restitution where it depends on the approach speed, and the
    /// velocities of the bodies after the impact. Throws Failure(kRun) naming `time` [s] when ODE
    /// cannot solve a single contact.
    void solve(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts, double time);

    /// How often sweeps had to help so far.
    std::int64_t sweeps() const { return sweeps_; }

  private:
    struct World;
    void solve_single(std::vector<ImpactBody>& bodies, SolverContact& contact) const;
    void solve_many(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts,
                    double time);
    void add_joint(const SolverContact& contact, std::size_t index);
    bool solve_with_ode(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts,
                        double time);

    SingleContacts single_;
    std::unique_ptr<World> world_;
    std::vector<ImpactBody> before_;
    std::int64_t sweeps_ = 0;
};

}  // namespace carom
