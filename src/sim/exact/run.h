// One run of the method `exact`: balls on their own clocks, and a queue of what happens next.
#pragma once

#include <limits>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "motion/motion_log.h"
#include "sim/collide/can_collide.h"
#include "sim/exact/exact.h"
#include "sim/group/impact_cluster.h"
#include "sim/group/pile.h"
#include "sim/integrate/coupled_motion.h"
#include "sim/integrate/single_phase.h"
#include "sim/record/simulation_result.h"
#include "sim/solve/impact_solver.h"
#include "sim/solve/island_solver.h"
#include "sim/world/event_queue.h"
#include "sim/world/exact_world.h"
#include "sim/world/links.h"

namespace carom {

enum class PredictionKind : std::uint8_t {
    kPhase,   ///< the end of a phase or of a step, or a row that is due
    kImpact,  ///< with `partner`
    kCell     ///< the ball leaves its cell of the grid
};

/// What will process_instant next to a ball if nothing else happens before.
struct alignas(64) Prediction {
    double time = 0;
    int ball = -1;
    std::uint64_t stamp = 0;
    PredictionKind kind = PredictionKind::kPhase;
    Partner partner;
    std::uint64_t partner_stamp = 0;
    double seconds = 0;  ///< since the start of the ball's piece: finer than `time` can say
    double leaves_cell = std::numeric_limits<double>::infinity();  ///< s, if that comes before
};

class ExactRun {
  public:
    ExactRun(const Scene& scene, double end, const ExactOptions& options);

    void run(const std::stop_token& stop, const SimulationProgress& progress, bool until_rest);
    SimulationResult finish();

  private:
    bool current(const Prediction& p) const;
    Prediction due(int ball) const;
    void fetch(int ball) const;
    void predict(int ball, double now);
    void enqueue(int ball, double now);
    void change_cell(int ball, double now);
    void fit_grid(double now);
    void find_impacts_with_surfaces(int ball, double now);
    void find_impact_with_surface(int ball, int surface, double now);
    TimeOfImpact beside_held(int ball, int surface, const TimeOfImpact& toi, double from) const;
    bool is_beside_link(int ball, int surface, double now) const;
    void find_impact_with_ball(int ball, int other, double now);
    bool joins_island(const Partner& partner, int ball, double now);
    void keep_if_earlier(const Partner& partner, int ball, const TimeOfImpact& toi, bool touching,
                         double separation, double from, double now);
    void take_together(const Prediction& next);
    void process_instant(double now);
    Contact contact_met(const Prediction& p, double now);
    void resolve(const Contact& seed, double now);
    void settle(int ball, double now, const Velocities& velocities,
                const std::vector<Contact>& contacts, double speed_scale, bool at_start);
    double pressing_gravity(const Vec3& normal) const;
    double pressing(const Contact& contact, double now, const Vec3& velocity) const;
    Velocities landed(int ball, double now, const Contact& contact, const Velocities& velocities,
                      double separation) const;
    bool lasts(const Contact& contact, int ball, double now, const Vec3& velocity,
               double speed_scale, double& bounce_time_left) const;
    double bounce_of(const Contact& contact) const;
    bool approaches_at_start(int ball, const std::vector<Contact>& contacts) const;
    void begin_flat_contact(int ball, double now, const Contact& contact,
                            const Velocities& velocities, double bounce_time_left, bool at_start);
    void begin_flight(int ball, double now, const Velocities& velocities);
    void begin_flat_piece(int ball, double now, const Partner& surface, const Vec3& normal,
                          EventKind kind, double bounce_time_left, bool at_start);
    void begin_piece(int ball, double now, const BallState& at, const Vec3& a,
                     const Vec3& spin_rate, OptionalCurve curve = {});
    void end_phase(int ball, double now);
    double slip_tolerance(int ball, double now, const Velocities& velocities) const;

    // One contact without a closed form: integrated_contact.cpp.
    void begin_contact(int ball, double now, const Contact& contact, const Velocities& velocities,
                       double bounce_time_left, bool at_start);
    void begin_integrated(int ball, double now, const Contact& contact,
                          const Velocities& velocities, double bounce_time_left, bool at_start);
    void begin_integrated_on(int ball, double now, const Contact& contact,
                             const SingleContact& feature, const Velocities& velocities,
                             double bounce_time_left, bool at_start);
    bool go_over_seam(int ball, double now, const Velocities& velocities);
    SingleContactForces choose_mode(IntegratedPhase& phase, double tolerance) const;
    void lift_off(int ball, double now, const Partner& surface, const Vec3& normal);
    void advance(int ball, double now);
    void step_instead(int ball, double now);
    void give_up_on(const Prediction& p);
    void end_integrated(int ball, double now);
    void put_at(int ball, double now, const Vec3& x);
    void put_on_surface(int ball, double now);

    // Islands of lasting contacts that ODE steps: islands.cpp and island_links.cpp.
    void enter_island(int ball, double now, const Velocities& velocities);
    bool rests_against(int ball, const Partner& partner, double now);
    bool flies_along(int ball, const Partner& partner, double now) const;
    double gap_at(int ball, const Partner& partner, double time) const;
    void press(int ball, const Partner& partner, double now, double event_due);
    void join_at_once(int ball, double now);
    std::vector<Contact> linked_contacts(const std::vector<Contact>& seeds, double now) const;
    bool in_island(const ImpactCluster& cluster) const;
    ImpactCluster::Limits limits_of(const ImpactCluster& cluster) const;
    void settle_cluster(const ImpactCluster& cluster, double now);
    void step_islands(const std::vector<int>& balls, double now);
    bool is_pile(const std::vector<int>& island) const;
    double step_speed(const std::vector<int>& balls) const;
    Vec3 resting_spin(int ball, const Vec3& spin) const;
    void step_island(const std::vector<int>& balls, double now);
    bool leave_island(int ball, double now);
    void fall_asleep(const std::vector<int>& balls, double now, double calm_speed);
    /// A bouncing series that is over, or a contact that something presses: whatever speed is left
    /// between the two, they touch from now on.
    struct Landing {
        int ball = -1;
        Partner partner;
        double time = 0;       ///< s
        double event_due = 0;  ///< s, the end of the series
    };
    void note_landing(const Contact& contact, double now, double event_due);
    const Landing* landing_of(const Contact& contact, double now) const;
    bool slid_in_impact(const Contact& contact, double now) const;
    double next_contact_event(const std::vector<int>& island, double now) const;
    bool is_coarse(const Contact& contact) const;
    bool in_reach(const Contact& contact) const;
    bool stays_together(const Contact& contact, double now, const Link* link = nullptr);
    void note_push(const Contact& contact, const Vec3& push);
    bool hops_on(const Contact& contact, const Link& link, double separation, double now) const;
    std::vector<int> link_neighbours(std::vector<int> balls, double now);
    void link_near(int ball, double now, std::vector<Link>& before);
    void add_link(const Contact& contact, int ball, const Partner& partner, const Link* before,
                  double now);
    void note_link(Link& link, const Contact& contact, bool calm, double calm_speed, double now);
    void note_departures(int ball, const std::vector<Link>& before, double now);
    void add_contact_event(const Contact& contact, EventKind kind, double now);

    // Small islands whose contacts all last, integrated: integrated_islands.cpp.
    /// Two that touch, but do not press any more.
    struct Separation {
        int ball = -1;
        Partner partner;
        double time = 0;       ///< s
        bool pressed = false;  ///< they do, as their paths say: no parting
    };
    struct PieceGuess {
        double seconds = 0;         ///< a good length for the next piece ...
        std::uint64_t modes = 0;    ///< ... while contacts and modes are these
        int short_pieces = 0;       ///< on end, shorter than a step
        double stepped_until = -1;  ///< s
    };
    struct CoupledIsland {
        CoupledContacts system;
        CoupledState state;
        std::vector<Contact> contacts;  ///< in the order of the system's
    };
    bool coupled_system(const std::vector<int>& island, double now, CoupledIsland& is) const;
    bool has_many_balls() const;
    void note_separation(const Contact& contact, double now);
    void unlink(const Contact& contact, double now);
    Separation* separation_of(const Contact& contact, double now);
    bool integrate(const std::vector<int>& island, double now);
    CoupledPiece piece_of(int first_ball, double now, CoupledIsland& is, CoupledForces& forces);
    void pay_for_places(const std::vector<int>& island, double now, CoupledIsland& is) const;
    void begin_pieces(const std::vector<int>& island, double now, const CoupledIsland& is,
                      const CoupledPiece& piece, double rounding_speed);
    bool is_at_rest(const std::vector<int>& island, const CoupledIsland& is,
                    const CoupledForces& forces, double now, double seconds);
    void note_forces(const CoupledIsland& is, const CoupledForces& forces, bool still, double now);

    // Piles: piles.cpp.
    bool meets_pile(const Prediction& p) const;
    void note_impact(int ball, double now);
    bool stand_together(int ball, double now);
    void want_in_pile(int ball, double now);
    void enter_pile(int ball, double now);
    void step_pile(double now);
    void move_with_pile(int ball, double now);
    void leave_pile(int ball, double now);
    bool leaves_pile_alone(int ball, double now, const Velocities& velocities);
    void state_pair(PilePair& pair, double now);
    Event event_of(const PilePair& pair, EventKind kind, double now) const;

    bool can_hold(int ball, double now, const Contact& contact, const Velocities& velocities) const;
    void add_event(double now, EventKind kind, int ball);
    void add_impact_events(const std::vector<Contact>& impacts, double now);
    double hop_limit(int ball, const Vec3& position) const;
    bool at_rest(int ball) const;
    bool all_at_rest();
    std::string doing(int ball) const;
    std::string unrest() const;
    [[noreturn]] void refuse(const std::string& what, int ball, const Partner& partner,
                             double now) const;

    ExactWorld world_;
    double end_;
    ImpactSolver solver_;
    IslandSolver island_solver_;
    Links links_;
    Pile pile_;
    double next_step_ = std::numeric_limits<double>::infinity();  ///< of the pile, s
    EventQueue queue_;
    MotionLog log_;
    Motion motion_;  ///< its trajectories are filled in the end
    SimulationReport report_;
    std::uint64_t next_stamp_ = 1;
    std::map<int, IntegratedPhase> integrated_;  ///< by ball
    std::map<int, PieceGuess> piece_guess_;      ///< of an integrated island, by its first ball
    std::vector<Separation> separations_;        ///< of this instant, and of the ends of pieces
    std::vector<Landing> landings_;              ///< of this instant
    std::vector<Prediction> next_;               ///< per ball
    std::int64_t events_of_grid_ = 0;
    CanCollide can_collide_;
    std::size_t awake_ = 0;  ///< a ball that was not at rest when last looked at

    // Of one instant; members, so that an event allocates nothing once they have grown.
    ImpactCluster cluster_;
    Seeds seeds_;
    std::vector<Prediction> together_;
    std::vector<Contact> impacts_;
    std::vector<Contact> contacts_;
    std::vector<int> taken_;    ///< by the pile
    std::vector<int> stepped_;  ///< balls whose island is due
    std::uint64_t instant_ = 0;
};

}  // namespace carom
