// When a ball will meet something next, or leave its cell of the grid.
#include <algorithm>
#include <cmath>

#include "sim/exact/run.h"

namespace carom {

namespace {

/// The grid is looked at again after so many events a ball.
constexpr std::int64_t kEventsPerGrid = 16;

/// It is built anew when its cells should be larger or smaller by this factor.
constexpr double kMisfit = 1.5;

}  // namespace

// ---- Predictions
// ---------------------------------------------------------------------------------

void ExactRun::predict(int ball, double now) {
    const ExactBall& b = world_.ball(ball);
    if (b.in_pile && !b.asleep) return;
    if (world_.grid && world_.grid->in_cell(ball)) {
        const NeighbourGrid::Cell cell = world_.grid->cell_at(world_.position(ball, now));
        if (cell != world_.grid->cell_of(ball)) world_.grid->move(ball, cell);
    }
    act_on(predictor_.look_ahead(ball, now), now);
}

/// Takes a ball's outlook over. What touches and goes on to do so joins an island at once.
void ExactRun::act_on(const Outlook& outlook, double now) {
    const int ball = outlook.next.ball;
    for (const Contact& c : outlook.pressed_again) notes_.note_press(c, now);
    Prediction& next = next_[static_cast<std::size_t>(ball)];
    next = outlook.next;
    if (next.kind == PredictionKind::kPresses) {
        if (const auto& pressing = outlook.pressing)
            notes_.note_landing(pressing->contact, now, pressing->event_due);
        enter_island(ball, now, world_.velocities(ball, now));
        next = {};
        next.time = now;
        next.ball = ball;
        next.stamp = world_.ball(ball).stamp;
    }
    enqueue(ball, now);
}

/// The prediction at hand, or the end of the ball's stay in its cell if that comes before.
void ExactRun::enqueue(int ball, double now) {
    Prediction& next = next_[static_cast<std::size_t>(ball)];
    next.leaves_cell = predictor_.leaves_cell(next, now);
    const double time = std::min(next.time, next.leaves_cell);
    if (time <= end_)
        queue_.put(ball, time);
    else
        queue_.drop(ball);
}

/// A ball has left its cell: only the cells that come into reach have to be looked at.
void ExactRun::change_cell(int ball, double now) {
    NeighbourGrid& grid = *world_.grid;
    const NeighbourGrid::Cell from = grid.cell_of(ball);
    const NeighbourGrid::Cell to = grid.cell_at(world_.position(ball, now));
    int moved = 0, axis = 0;
    std::int64_t side = 0;
    for (int i = 0; i < 3; ++i) {
        const std::int64_t step =
            to[static_cast<std::size_t>(i)] - from[static_cast<std::size_t>(i)];
        if (step == 0) continue;
        ++moved;
        axis = i;
        side = step;
    }
    if (moved > 0) grid.move(ball, to);
    Outlook outlook;
    outlook.next = next_[static_cast<std::size_t>(ball)];
    const auto look = [&](int other) { predictor_.look_at_ball(outlook, other, now); };
    if (moved == 1 && std::abs(side) == 1)
        world_.for_each_in_layer(ball, axis, side, look);
    else if (moved > 0)
        world_.for_each_near(ball, look);
    act_on(outlook, now);
}

/// Where balls have spread or gathered, the cells follow.
void ExactRun::fit_grid(double now) {
    if (!world_.grid ||
        ++events_of_grid_ < kEventsPerGrid * static_cast<std::int64_t>(world_.balls.size()))
        return;
    events_of_grid_ = 0;
    Vec3 low = world_.position(0, now), high = low;
    for (int i = 1; i < static_cast<int>(world_.balls.size()); ++i) {
        const Vec3 x = world_.position(i, now);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double ratio = world_.grid->cell_size_for(low, high) / world_.grid->cell_size();
    if (ratio < kMisfit && ratio > 1 / kMisfit) return;
    world_.build_grid(now);
    for (ExactBall& b : world_.balls) b.stamp = next_stamp_++;
    for (int i = 0; i < static_cast<int>(world_.balls.size()); ++i) predict(i, now);
}

}  // namespace carom
