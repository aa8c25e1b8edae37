// Impacts of one instant that hang together.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "sim/solve/impact_solver.h"
#include "sim/world/exact_world.h"

namespace carom {

/// The contacts that are known to be met at one instant, one per pair, by ball.
class Seeds {
  public:
    explicit Seeds(std::size_t balls) : first_(balls, -1) {}
    void clear();
    void add(const Contact& contact);
    const std::vector<Contact>& all() const { return all_; }
    /// Calls f(contact) for those of one ball.
    template <class F>
    void for_each_of(int ball, F&& f) const {
        for (int i = first_[static_cast<std::size_t>(ball)]; i >= 0; i = next_of(i, ball))
            f(all_[static_cast<std::size_t>(i)]);
    }

  private:
    int next_of(int seed, int ball) const;

    std::vector<Contact> all_;
    std::vector<std::array<int, 2>> next_;  ///< in the lists of `ball` and of the other ball
    std::vector<int> first_;                ///< per ball, -1 for none
};

/// The balls that touch each other at one instant, directly or through others, and their contacts.
///
/// Contacts are solved together only while their approach speeds are equal to rounding and the
/// largest: Newton's law at different approach speeds can gain energy when solved at once, equal
/// ones cannot. So a touching cradle passes its impulse on, and a symmetric arrangement stays so.
///
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

    /// When a cluster is resolved before nothing approaches any more. Inelastic collapse would need
    /// infinitely many rounds.
    struct Limits {
        /// m/s: what approaches no faster is left to the steps of an island, which take over then.
        double enough = 0;
        /// Before what is left is solved as one inelastic contact; 0 for rounds_to_end().
        std::size_t rounds = 0;
        /// Of the first approach: what is slower does not rebound, and is solved at once.
        double slow = 0;
    };

    /// Solves until nothing approaches any more. `impacts` gets one entry per pair that met: how
    /// fast it came at first, how fast it leaves in the end, and all its impulses together.
    void resolve(ImpactSolver& solver, std::vector<Contact>& impacts, const Limits& limits);
    std::size_t contact_count() const { return contacts_.size(); }

    const std::vector<int>& balls() const { return balls_; }
    const ImpactBody& body(int ball) const { return bodies_[index_of(ball)]; }
    /// The contacts of one ball, with the separation speeds that resolve() left.
    void contacts_of(int ball, std::vector<Contact>& result) const;
    std::vector<Contact> contacts_of(int ball) const;
    /// The largest approach speed at the beginning, m/s.
    double first_approach() const { return first_approach_; }
    /// Relative speeds below this are what rounding left of a zero, m/s.
    double rounding_speed() const { return kStillFraction * largest_speed_; }

  private:
    std::size_t index_of(int ball) const;
    bool has(int ball) const { return place_[static_cast<std::size_t>(ball)] >= 0; }
    void grow(const Contact& seed, const Seeds& seeds, double time);
    void add(const Contact& contact);
    bool meets(const Contact& contact, double size) const;
    bool is_known(int ball, const Partner& other) const;
    void add_new(const Contact& contact);
    void press_together();
    void add_ball(int ball);
    void touch_surfaces(int ball);
    void touch_balls(int ball);
    double approach(const Contact& contact) const;
    SolverContact under_own_numbers(const Contact& contact) const;
    std::size_t rounds_to_end() const;
    void find_speeds();
    void update_speeds();
    void choose(double slowest);
    void solve(ImpactSolver& solver, bool inelastic, double enough, std::vector<Contact>& impacts);
    void note_impulse(std::size_t contact, const SolverContact& solved,
                      std::vector<Contact>& impacts);
    void press_rest(ImpactSolver& solver, std::vector<Contact>& impacts);
    void resolve_single(ImpactSolver& solver, std::vector<Contact>& impacts, const Limits& limits);
    void end_impacts(std::vector<Contact>& impacts);

    ExactWorld& world_;
    double time_ = 0;
    double near_ = 0;         ///< of a radius: wider gaps are none of a contact; 0 for rounding
    std::vector<int> balls_;  ///< in the order found
    std::vector<ImpactBody> bodies_;
    std::vector<Contact> contacts_;
    std::size_t first_of_ball_ = 0;  ///< contacts from here on came with the ball at hand
    std::vector<int> place_;         ///< per ball of the scene: index into balls_, or -1
    double first_approach_ = 0;
    double largest_speed_ = 0;

    std::vector<int> impact_of_;  ///< per contact: its entry among the impacts, or -1
    // Of one round: what the solver gets, and which contact each entry was.
    std::vector<double> speeds_;
    std::vector<std::vector<std::size_t>> of_ball_;  ///< contacts, by ball of the cluster
    std::vector<std::size_t> chosen_;
    std::vector<int> number_;  ///< per ball of the cluster: its number for the solver, or -1
    std::vector<std::size_t> here_;
    std::vector<ImpactBody> solver_bodies_;
    std::vector<SolverContact> solver_contacts_;
};

}  // namespace carom
