// One run of the method `exact`: balls on their own clocks, and a queue of what happens next.
#pragma once

#include <limits>
#include <queue>
#include <stop_token>
#include <string>
#include <tuple>
#include <vector>

#include "sim/cluster.h"
#include "sim/exact_world.h"
#include "sim/impact_solver.h"
#include "sim/simulate.h"

namespace carom {

/// What will happen next to a ball if nothing else happens before.
struct Prediction {
    double time = 0;
    int ball = -1;
    std::uint64_t stamp = 0;
    bool impact = false;  ///< otherwise the end of a phase, or a row that is due
    Partner partner;
    std::uint64_t partner_stamp = 0;
};

/// Earliest first; at one instant by the balls' order, so that runs repeat exactly.
struct Later {
    bool operator()(const Prediction& a, const Prediction& b) const {
        return std::tie(a.time, a.ball) > std::tie(b.time, b.ball);
    }
};

class ExactRun {
  public:
    ExactRun(const Scene& scene, double end);

    void run(const std::stop_token& stop, const SimulationProgress& progress, bool until_rest);
    SimulationResult finish();

  private:
    bool current(const Prediction& p) const;
    void predict(int ball, double now);
    void consider(int ball, const Partner& partner, double now, Prediction& earliest);
    void happen(const std::vector<Prediction>& together, double now);
    void resolve(const Cluster& cluster, double now);
    void settle(int ball, double now, const Velocities& velocities,
                const std::vector<Contact>& contacts, double speed_scale, bool at_start);
    bool lasts(const Contact& contact, int ball, double speed_scale, double& tail) const;
    void hold(int ball, double now, const Contact& contact, const Velocities& velocities,
              double tail, bool at_start);
    void fly(int ball, double now, const Velocities& velocities);
    void begin_piece(int ball, double now, const BallState& at, const Vec3& a,
                     const Vec3& spin_rate);
    void end_phase(int ball, double now);
    void require_departure(int ball, double time, const Contact& contact) const;
    void row(double now, EventKind kind, int ball);
    void write_impacts(const std::vector<Contact>& impacts, double now);
    double hop_limit(int ball, const Vec3& position) const;
    bool all_at_rest() const;
    [[noreturn]] void refuse(const std::string& what, int ball, const Partner& partner,
                             double now) const;

    ExactWorld world_;
    double end_;
    ImpactSolver solver_;
    std::priority_queue<Prediction, std::vector<Prediction>, Later> queue_;
    Motion motion_;
    SimulationReport report_;
    std::uint64_t next_stamp_ = 1;
};

}  // namespace carom
