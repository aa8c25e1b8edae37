// Many balls close together, whose impacts are too many to be told apart: stepped together.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/group/pile_solver.h"
#include "sim/record/stated_kind.h"
#include "sim/world/exact_world.h"
#include "sim/world/links.h"

namespace carom {

/// Two bodies of a pile that are near each other, and what is known of their contact.
struct PilePair {
    int ball = -1;  ///< of two balls the scene's first one
    Partner other;
    double restitution = 1, friction = 0;
    // Of this step.
    Vec3 normal = Vec3::UnitZ();  ///< unit, towards `ball`
    double gap = 0;               ///< m
    double closing = 0;           ///< m/s, at the start
    bool bounces = false;         ///< an impact falls into this step
    double impact_push = 0;       ///< of that impact: along the normal, N s
    double impact_tangential = 0;
    double separation = 0;  ///< after it, m/s
    // Kept from step to step.
    double force = 0;                    ///< along the normal, N
    Vec3 friction_force = Vec3::Zero();  ///< N
    bool touching = false;
    double slip = 0;  ///< at the end of the step, m/s
    StatedKind kind;

    /// What orders pairs: ball, then surfaces, then balls.
    std::int64_t key() const {
        return (static_cast<std::int64_t>(ball) << 32) +
               (other.is_surface ? other.index : (std::int64_t{1} << 31) + other.index);
    }
};

/// A ball of the scene, as far as the pile has to do with it.
struct PileBall {
    bool wanted = false;      ///< becomes a member at the next step
    bool waits = false;       ///< its pairs are still to be found
    BallState at;             ///< at the start of the step
    Velocities after;         ///< at its end
    Velocities started;       ///< at its start, behind the impacts
    double wake_speed = 0;    ///< m/s, with which it was woken in this step
    double load = 0;          ///< N: the largest force on it
    double calm_seconds = 0;  ///< on end, in which it hardly moved
    int near = 0;             ///< pairs of it in reach
    int lone_steps = 0;       ///< on end, in which at most a surface was
    bool pushed = false;      ///< something acted on it in this step
};

/// Steps of a pile. Its members move at constant accelerations from one step to the next; each
/// step has two parts:
///   impacts: contacts that close faster than gravity makes them, and before the step ends, rebound
///     at its start by Newton's law, all others passing it on: they end the part at -gap/h or more;
///   forces: the midpoint rule of IslandSolver, (v + v')_n h / 2 >= -gap.
/// Neither gains energy, and what the unfinished iterations would leave of a gain is taken out of
/// the speeds. The step is as long as the fastest closing pair allows.
class Pile {
  public:
    explicit Pile(ExactWorld& world);

    bool empty() const { return awake_.empty() && wanted_.empty(); }
    bool member(int ball) const { return in_pile(world_.ball(ball).phase()); }
    bool asleep(int ball) const { return world_.ball(ball).phase() == Phase::kPileAsleep; }
    bool is_awake(int ball) const { return world_.ball(ball).phase() == Phase::kPile; }
    PileBall& of(int ball) { return balls_[static_cast<std::size_t>(ball)]; }
    const PileBall& of(int ball) const { return balls_[static_cast<std::size_t>(ball)]; }
    const std::vector<int>& awake() const { return awake_; }  ///< sorted
    const std::vector<PilePair>& pairs() const { return pairs_; }
    std::vector<PilePair>& pairs() { return pairs_; }
    double seconds() const { return seconds_; }

    /// The ball shall be taken in at the next step.
    void want(int ball);
    /// Gathers who takes part in a step that begins now: members, and what comes into their reach.
    /// `taken` gets the balls that are new, or that woke: they are in the phase kPile from now on.
    void gather(double now, const Links& links, std::vector<int>& taken);
    /// Solves the step of what was gathered.
    void solve();
    /// The ball's phase has become kPileAsleep.
    void lay_to_sleep(int ball);
    /// After some have left or fallen asleep: drops what is no pair any more.
    void tidy();

    /// What closes slower does not bounce: gravity makes half of it in the longest step [m/s].
    double slow_speed() const;

    /// Of a pair that has parted again, and slept or slides no more.
    double separation_gap() const;

  private:
    PileBody& body(int ball) { return bodies_[static_cast<std::size_t>(ball)]; }
    void take(int ball, double now, double wake_speed, const Links& links);
    void find_pairs(double now, const Links& links);
    void add_pairs_of(int ball, double now, const Links& links, bool all);
    void look_at(PilePair& pair, double now);
    bool draws_in(const PilePair& pair, double now, const Links& links, std::vector<int>& taken);
    void choose_seconds();
    void build_rows();
    void aim_at_mid_step(PileRow& row, const PilePair& pair) const;
    void solve_impacts();
    void solve_forces();
    double kinetic_energy() const;
    double fall_energy() const;
    void slow_down(double too_much);
    void part_overlaps(double budget);
    Vec3 position_of(int ball, double now) const;
    Vec3 velocity_of(int ball, double now) const;

    ExactWorld& world_;
    std::vector<PileBall> balls_;   ///< per ball of the scene
    std::vector<PileBody> bodies_;  ///< the same
    std::vector<int> awake_, wanted_;
    std::vector<PilePair> pairs_, old_pairs_;
    std::vector<std::size_t> active_;  ///< the pairs in reach, one row each
    std::vector<PileRow> rows_;
    std::vector<Vec3> shift_;  ///< per ball
    double seconds_ = 0;
    double fastest_closing_ = 0;  ///< m/s
    double slack_ = 0;            ///< m: gaps up to here take part in the step
    double skin_ = 0;             ///< m: gaps up to here are in pairs_
    double moved_ = 1e300;        ///< m: how far pairs may have closed since pairs_ was made
    double smallest_radius_ = 0;
    double longest_ = 0;  ///< s: step where nothing is fast
};

}  // namespace carom
