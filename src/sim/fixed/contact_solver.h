// From the contacts of a step to ODE's contact joints, and back to speeds and impulses.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/fixed/ode_world.h"

namespace carom {

/// How the contacts of a step are solved.
struct StepContactRules {
    double step = 0;              ///< s
    Vec3 gravity = Vec3::Zero();  ///< m/s^2
    int iterations = 0;           ///< 0: dWorldStep, otherwise dWorldQuickStep
    /// Approach speed above which a contact is an impact, m/s.
    double impact_threshold = 0;
    /// Position correction pushes contacts apart no faster than this, m/s.
    double correction_speed = 0;
};

/// Sets `alone` of each contact: islands are balls joined by contacts; surfaces do not join.
/// Union-find with path halving (Tarjan and van Leeuwen 1984).
class ContactIslands {
  public:
    explicit ContactIslands(int balls)
        : parent_(static_cast<std::size_t>(balls)), contacts_(static_cast<std::size_t>(balls)) {}
    void mark_lonely(std::vector<Contact>& contacts);

  private:
    int root(int ball);
    std::vector<int> parent_;
    std::vector<int> contacts_;  ///< per root
};

/// Solves the contacts of one step with ODE.
///
/// An impact bounces (Newton's law with the pair's coefficient, on the velocities before the step)
/// and takes no position correction, which would otherwise replace a small coefficient by
/// erp depth / dt. Any other contact must separate at least at the speed by which ODE's default ERP
/// corrects its overlap, at most at `correction_speed`.
///
/// Friction is Coulomb's cone where the contact is alone in its island: the first friction axis
/// lies along the slip that the contact would have after the step without friction. A ball's
/// resistance to slip is the same in all directions, so friction then has no part across that axis,
/// and ODE's box of two axes, |f1|, |f2| <= mu N, cuts exactly where the cone does. (Hwangbo, Kang
/// and others, SimBenchmark 2018, show the error of a fixed axis: up to sqrt 2.)
class ContactSolver {
  public:
    ContactSolver(OdeWorld& world, const StepContactRules& rules);

    /// Fills what comes "from the velocities before the step" and adds the joints.
    void add_joints(std::vector<Contact>& contacts, const std::vector<Velocities>& before);
    /// Steps the world.
    void step() { world_.step(rules_.step, rules_.iterations); }
    /// Fills what comes "from the step" and removes the joints.
    void finish(std::vector<Contact>& contacts, const std::vector<Velocities>& after);

    /// The last step's impulse on the ball of a contact, N s.
    Vec3 push(std::size_t contact) const { return rules_.step * from_ode(feedback_[contact].f1); }

  private:
    void prepare(Contact& contact, const std::vector<Velocities>& before) const;
    double free_speed(const Contact& contact) const;
    double target_speed(const Contact& contact) const;
    dContact joint_of(const Contact& contact) const;

    OdeWorld& world_;
    StepContactRules rules_;
    double erp_;            ///< of the world, 1 per step
    double tie_speed_ = 0;  ///< closer than this to its target, a contact's speed is tied, m/s
    ContactIslands islands_;
    std::vector<dJointFeedback> feedback_;  ///< one per contact of the step
};

}  // namespace carom
