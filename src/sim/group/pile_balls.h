// The balls of a pile, as all its parts know them.
#pragma once

#include <vector>

#include "sim/group/pile_solver.h"
#include "sim/world/exact_world.h"

namespace carom {

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

/// Which balls of the scene are members of the pile, and where. Members that are awake are in the
/// phase kPile, members that sleep in kPileAsleep.
class PileBalls {
  public:
    explicit PileBalls(ExactWorld& world);

    bool member(int ball) const { return in_pile(world_.ball(ball).phase()); }
    bool asleep(int ball) const { return world_.ball(ball).phase() == Phase::kPileAsleep; }
    bool is_awake(int ball) const { return world_.ball(ball).phase() == Phase::kPile; }
    const std::vector<int>& awake() const { return awake_; }  ///< sorted

    PileBall& of(int ball) { return balls_[static_cast<std::size_t>(ball)]; }
    const PileBall& of(int ball) const { return balls_[static_cast<std::size_t>(ball)]; }
    PileBody& body(int ball) { return bodies_[static_cast<std::size_t>(ball)]; }
    const PileBody& body(int ball) const { return bodies_[static_cast<std::size_t>(ball)]; }
    std::vector<PileBody>& bodies() { return bodies_; }  ///< per ball of the scene

    /// At the start of the step, members' and others' [m, m/s].
    Vec3 position(int ball, double now) const {
        return member(ball) ? of(ball).at.position : world_.position(ball, now);
    }
    Vec3 velocity(int ball, double now) const {
        return member(ball) ? of(ball).at.velocity : world_.velocities(ball, now).linear;
    }
    /// m/s: the fastest of all that do not sleep.
    double fastest(double now) const;

    /// Makes a ball a member that is awake.
    void add(int ball, double now, double wake_speed);
    /// The state at which a step of those awake begins.
    void begin_step(double now);
    /// The ball's phase has become kPileAsleep.
    void lay_to_sleep(int ball);
    /// Forgets those that are not awake any more.
    void tidy();

    double smallest_radius() const { return smallest_radius_; }  ///< m, of the whole scene

  private:
    ExactWorld& world_;
    std::vector<PileBall> balls_;   ///< per ball of the scene
    std::vector<PileBody> bodies_;  ///< the same
    std::vector<int> awake_;
    double smallest_radius_ = 0;
};

}  // namespace carom
