// What meets at one instant and hangs together.
#pragma once

#include <vector>

#include "sim/group/seeds.h"
#include "sim/solve/impact_solver.h"
#include "sim/world/exact_world.h"

namespace carom {

/// The balls that touch each other at one instant, directly or through others, and their contacts.
/// One object serves all clusters of a run, so that an event allocates nothing once its vectors
/// have grown.
class ImpactCluster {
  public:
    explicit ImpactCluster(ExactWorld& world);

    /// Grown from one of the contacts that are known to be met now, whatever rounding says of their
    /// gaps; the other `seeds` belong to it where they share a ball with it.
    void gather(const Contact& seed, const Seeds& seeds, double time);
    /// The same of what hangs together over gaps of at most `near` of a radius.
    void gather_heap(const Contact& seed, const Seeds& seeds, double near, double time);

    double time() const { return time_; }  ///< s
    const std::vector<int>& balls() const { return balls_; }
    /// Where a ball of it stands in balls() and bodies().
    std::size_t index_of(int ball) const;
    std::vector<ImpactBody>& bodies() { return bodies_; }
    const ImpactBody& body(int ball) const { return bodies_[index_of(ball)]; }
    std::vector<Contact>& contacts() { return contacts_; }
    std::size_t contact_count() const { return contacts_.size(); }
    /// The contacts of one ball.
    void contacts_of(int ball, std::vector<Contact>& result) const;

    /// m/s, along the normal, as the bodies move now.
    double approach(const Contact& contact) const;
    /// m/s: the largest of a centre and a rim together, when it was gathered.
    double largest_speed() const { return largest_speed_; }
    /// Relative speeds below this are what rounding left of a zero, m/s.
    double rounding_speed() const { return kStillFraction * largest_speed_; }

  private:
    bool has(int ball) const { return place_[static_cast<std::size_t>(ball)] >= 0; }
    void grow(const Contact& seed, const Seeds& seeds, double time);
    void add(const Contact& contact);
    bool meets(const Contact& contact, double size) const;
    bool is_known(int ball, const Partner& other) const;
    void add_new(const Contact& contact);
    void add_ball(int ball);
    void touch_surfaces(int ball);
    void touch_balls(int ball);

    ExactWorld& world_;
    double time_ = 0;
    double near_ = 0;         ///< of a radius: wider gaps are none of a contact; 0 for rounding
    std::vector<int> balls_;  ///< in the order found
    std::vector<ImpactBody> bodies_;
    std::vector<Contact> contacts_;
    std::size_t first_of_ball_ = 0;  ///< contacts from here on came with the ball at hand
    std::vector<int> place_;         ///< per ball of the scene: index into balls_, or -1
    double largest_speed_ = 0;
};

}  // namespace carom
