#include "sim/exact/cell_exit.h"

#include <algorithm>

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

}  // namespace

double seconds_in_cell(const ExactWorld& world, int ball, double now, double horizon) {
    const Path path = world.path(ball, now);
    const double size = world.grid->cell_size(), margin = world.grid->margin();
    const NeighbourGrid::Cell& cell = world.grid->cell_of(ball);
    double seconds = horizon;
    const Piece& piece = world.ball(ball).piece;
    for (int i = 0; i < 3; ++i) {
        const auto low = static_cast<double>(cell[static_cast<std::size_t>(i)]) * size;
        if (piece.curve) {
            const HighDegreePath curved = high_degree_path(piece, now, std::max(seconds, 0.0));
            seconds = seconds_above(curved, Vec3::Unit(i), low - margin);
            seconds =
                std::min(seconds, seconds_above(curved, -Vec3::Unit(i), -(low + size + margin)));
            continue;
        }
        seconds = seconds_inside(path.position[i], path.velocity[i], path.acceleration[i],
                                 low - margin, low + size + margin, seconds);
    }
    return seconds;
}

}  // namespace carom
