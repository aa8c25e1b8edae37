#include "sim/phase/stepped_islands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/group/island_step.h"

namespace carom {

namespace {

/// An island rests when none of its balls has moved faster than this fraction of g h for
/// kCalmSeconds: gravity sets nothing in motion there at more than 5e-5 g. What ODE's constraint
/// force mixing leaves of a resting pile's speeds is a hundred times less.
constexpr double kCalmFraction = 1e-3;
constexpr double kCalmSeconds = 20 * kIslandStep;

/// Of balls so small that gravity gives them no more than a step's speed over their own size, a
/// part of sqrt(g r), the speed that belongs to the smallest radius, stands in the place of g h.
constexpr double kSizeFraction = 8e-3;

/// It rests as well when none has been faster than this for so long: gravity does less than 1e-4 g.
constexpr double kSlowFraction = 2e-2;
constexpr double kSlowSeconds = 200 * kIslandStep;

}  // namespace

/// What gravity does to speeds in a step, or what is little for balls of this size, m/s.
double SteppedIslands::step_speed(const std::vector<int>& balls) const {
    double radius = std::numeric_limits<double>::infinity();
    for (const int ball : balls) radius = std::min(radius, world_.ball(ball).radius);
    return std::min(slow_speed(world_),
                    kSizeFraction * std::sqrt(world_.scene.simulation.gravity.norm() * radius));
}

std::optional<double> SteppedIslands::step(const std::vector<int>& balls, double now) {
    IslandStep step(world_, links_, balls, now);
    step.correct_positions();
    step.solve(solver_);
    ++log_.report.steps;

    const double calm_speed = kCalmFraction * step_speed(balls);
    const double still_speed = kSlowFraction / kCalmFraction * calm_speed;
    const bool calm = step.is_calm(calm_speed);
    const bool slow = calm || step.is_calm(still_speed);
    bool asleep = slow;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        ExactBall& b = world_.ball(balls[i]);
        IslandMember& m = links_.member(balls[i]);
        const IslandStep::Result& r = step.result(i);
        m.calm_steps = calm ? m.calm_steps + 1 : 0;
        m.slow_steps = slow ? m.slow_steps + 1 : 0;
        asleep = asleep && (m.calm_steps * step.seconds() >= kCalmSeconds ||
                            m.slow_steps * step.seconds() >= kSlowSeconds);
        ++m.steps;
        m.stepped_seconds += step.seconds();
        b.phase_end = now + step.seconds();
        b.coarse = true;
        world_.begin_piece(balls[i], now, r.start, r.acceleration, r.spin_rate);
    }
    for (std::size_t i = 0; i < step.contacts().size(); ++i) {
        const Contact& c = step.contacts()[i];
        island_links_.note_push(c, kIslandStep / step.seconds() * step.push(i));
        island_links_.note_step(c, calm, calm_speed, now);
    }
    if (!asleep) return {};
    return calm ? calm_speed : still_speed;
}

}  // namespace carom
