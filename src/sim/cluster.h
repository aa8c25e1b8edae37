// Impacts of one instant that hang together.
#pragma once

#include <utility>
#include <vector>

#include "sim/exact_world.h"
#include "sim/impact_solver.h"

namespace carom {

/// The balls that touch each other at one instant, directly or through others, and their contacts.
///
/// Contacts are solved together only while their approach speeds are equal to rounding and the
/// largest: Newton's law at different approach speeds can gain energy when solved at once, equal
/// ones cannot. So a touching cradle passes its impulse on, and a symmetric arrangement stays so.
class Cluster {
  public:
    /// Grown from one of the contacts that are known to be met now, whatever rounding says of their
    /// gaps; the other `seeds` belong to it where they share a ball with it.
    Cluster(ExactWorld& world, const Contact& seed, const std::vector<Contact>& seeds, double time);

    /// Solves until nothing approaches any more. `impacts` gets one entry per pair and impact.
    void resolve(ImpactSolver& solver, std::vector<Contact>& impacts);

    const std::vector<int>& balls() const { return balls_; }
    const ImpactBody& body(int ball) const { return bodies_[index_of(ball)]; }
    /// The contacts of one ball, as they are after resolve().
    std::vector<Contact> contacts_of(int ball) const;
    /// The largest approach speed at the beginning, m/s.
    double first_approach() const { return first_approach_; }

  private:
    std::size_t index_of(int ball) const;
    void add(const Contact& contact);
    void grow(const std::vector<Contact>& seeds);
    void add_ball(int ball);
    void add_contact(const Contact& contact);
    double approach(const Contact& contact) const;
    void solve(ImpactSolver& solver, const std::vector<std::size_t>& chosen, bool inelastic,
               std::vector<Contact>& impacts);

    ExactWorld& world_;
    double time_;
    std::vector<int> balls_;  ///< in the order found
    std::vector<ImpactBody> bodies_;
    std::vector<Contact> contacts_;
    double first_approach_ = 0;
};

}  // namespace carom
