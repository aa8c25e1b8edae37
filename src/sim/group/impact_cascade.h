// Impacts of one instant that pass from contact to contact, until nothing approaches any more.
#pragma once

#include <vector>

#include "sim/group/impact_cluster.h"

namespace carom {

/// Contacts are solved together only while their approach speeds are equal to rounding and the
/// largest: Newton's law at different approach speeds can gain energy when solved at once, equal
/// ones cannot. So a touching cradle passes its impulse on, and a symmetric arrangement stays so.
class ImpactCascade {
  public:
    /// Resolves what `cluster` has gathered.
    explicit ImpactCascade(ImpactCluster& cluster) : cluster_(cluster) {}

    /// When a cluster counts as resolved before nothing approaches any more. Inelastic collapse
    /// would need infinitely many rounds.
    struct Limits {
        /// m/s: what approaches no faster is left to the steps of an island, which take over then.
        double enough = 0;
        /// Before what is left is solved as one inelastic contact; 0 for rounds_to_end().
        std::size_t rounds = 0;
        /// Of the first approach: what is slower does not rebound, and is solved at once.
        double slow = 0;
    };

    /// Solves until nothing approaches any more: the bodies' velocities, the contacts' separation
    /// speeds. `impacts` gets one entry per pair that met: how fast it came at first, how fast it
    /// leaves in the end, and all its impulses together.
    void resolve(std::vector<Contact>& impacts, const Limits& limits);
    /// The largest approach speed at the beginning, m/s.
    double first_approach() const { return first_approach_; }

  private:
    SolverContact under_own_numbers(const Contact& contact) const;
    std::size_t rounds_to_end() const;
    void find_speeds();
    void update_speeds();
    void choose(double slowest);
    void solve(bool inelastic, double enough, std::vector<Contact>& impacts);
    void note_impulse(std::size_t contact, const SolverContact& solved,
                      std::vector<Contact>& impacts);
    void press_rest(std::vector<Contact>& impacts);
    void press_together();
    void resolve_single(std::vector<Contact>& impacts, const Limits& limits);
    void end_impacts(std::vector<Contact>& impacts);

    ImpactCluster& cluster_;
    ImpactSolver solver_;
    double first_approach_ = 0;
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
