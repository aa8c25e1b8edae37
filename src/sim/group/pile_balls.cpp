#include "sim/group/pile_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

PileBalls::PileBalls(ExactWorld& world)
    : world_(world), balls_(world.balls.size()), bodies_(world.balls.size()) {
    smallest_radius_ = std::numeric_limits<double>::infinity();
    for (const Ball& b : world.scene.balls) smallest_radius_ = std::min(smallest_radius_, b.radius);
}

double PileBalls::fastest(double now) const {
    double square = 0;
    for (int i = 0; i < static_cast<int>(balls_.size()); ++i)
        if (!asleep(i)) square = std::max(square, velocity(i, now).squaredNorm());
    return std::sqrt(square);
}

void PileBalls::add(int ball, double now, double wake_speed) {
    PileBall& b = of(ball);
    b.wanted = false;
    b.wake_speed = wake_speed;
    b.lone_steps = 0;
    b.calm_seconds = 0;
    b.at = world_.state(ball, now);
    const ExactBall& known = world_.ball(ball);
    body(ball) = {b.at.velocity, known.radius * b.at.spin, 1 / known.mass,
                  1 / (known.inertia_factor * known.mass), 0};
    awake_.insert(std::lower_bound(awake_.begin(), awake_.end(), ball), ball);
}

void PileBalls::begin_step(double now) {
    for (const int ball : awake_) {
        PileBall& b = of(ball);
        b.at = world_.state(ball, now);
        b.wake_speed = 0;
        body(ball).velocity = b.at.velocity;
        body(ball).rim = world_.ball(ball).radius * b.at.spin;
    }
}

void PileBalls::lay_to_sleep(int ball) {
    of(ball).at.velocity.setZero();
    body(ball).velocity.setZero();
    body(ball).inverse_mass = body(ball).inverse_spin = 0;
}

void PileBalls::tidy() {
    std::erase_if(awake_, [this](int ball) { return !is_awake(ball); });
}

}  // namespace carom
