#include "sim/exact/cells.h"

#include <algorithm>
#include <limits>

#include "sim/collide/time_of_impact_high_degree.h"
#include "sim/math/polynomial.h"

namespace carom {

namespace {

/// Seconds until x + v s + a s^2 / 2 leaves (low, high), where it is now; at most `horizon`.
double seconds_inside(double x, double v, double a, double low, double high, double horizon) {
    if (a == 0) {
        if (v == 0) return horizon;
        return std::min(((v > 0 ? high : low) - x) / v, horizon);
    }
    for (const auto& gap :
         {Polynomial{{x - low, v, 0.5 * a, 0, 0}}, Polynomial{{high - x, -v, -0.5 * a, 0, 0}}}) {
        const Roots out = downward_crossings(gap, horizon);
        if (out.count > 0) horizon = std::min(horizon, out.at[0]);
    }
    return horizon;
}

/// Seconds from `now` [s] on, at most `horizon`. Only for a ball that has a place.
double seconds_in_place(const ExactWorld& world, int ball, double now, double horizon) {
    const Path path = world.path(ball, now);
    const Box3 place = world.place_of(ball);
    double seconds = horizon;
    const Piece& piece = world.ball(ball).piece;
    for (int i = 0; i < 3; ++i) {
        const double low = place.min()[i], high = place.max()[i];
        if (piece.curve) {
            const HighDegreePath curved = high_degree_path(piece, now, std::max(seconds, 0.0));
            seconds = seconds_above(curved, Vec3::Unit(i), low);
            seconds = std::min(seconds, seconds_above(curved, -Vec3::Unit(i), -high));
            continue;
        }
        seconds = seconds_inside(path.position[i], path.velocity[i], path.acceleration[i], low,
                                 high, seconds);
    }
    return seconds;
}

}  // namespace

double leaves_cell(const ExactWorld& world, int ball, double now, double until) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    if (!world.has_place(ball)) return kNever;
    const double horizon = until - now;
    const double seconds = seconds_in_place(world, ball, now, horizon);
    return seconds < horizon ? now + seconds : kNever;
}

CellChange enter_cell(ExactWorld& world, int ball, double now) {
    if (world.lists) {
        world.lists->move(ball, world.position(ball, now), world.velocities(ball, now).linear);
        return {3, 0, 0};
    }
    NeighbourGrid& grid = *world.grid;
    const NeighbourGrid::Cell from = grid.cell_of(ball);
    const NeighbourGrid::Cell to = grid.cell_at(world.position(ball, now));
    CellChange change;
    for (int i = 0; i < 3; ++i) {
        const std::int64_t step =
            to[static_cast<std::size_t>(i)] - from[static_cast<std::size_t>(i)];
        if (step == 0) continue;
        ++change.axes;
        change.axis = i;
        change.side = step;
    }
    if (change.axes > 0) grid.move(ball, to);
    return change;
}

}  // namespace carom
