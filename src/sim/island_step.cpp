#include "sim/island_step.h"

#include <algorithm>
#include <limits>

#include "core/check.h"

namespace carom {

namespace {

/// Sweeps over all contacts of an island in one step; what is left is for the next step.
constexpr int kSweeps = 8;

/// Part of an overlap that one sweep takes away: several contacts push a ball at once.
constexpr double kRelaxation = 0.5;

/// Overlaps up to this fraction of the smaller radius stay, so that resting balls do not move.
constexpr double kSlop = 1e-9;

double inverse_mass(const ExactWorld& world, int ball) { return 1 / world.ball(ball).mass; }

}  // namespace

IslandStep::IslandStep(const ExactWorld& world, const Links& links, const std::vector<int>& balls,
                       double now)
    : world_(world), balls_(balls), results_(balls.size()), after_(balls.size()) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        results_[i].start = world.state(balls[i], now);
        for (const Link& link : links.of(balls[i])) {
            const Contact c = world.contact_at(balls[i], link.partner, now);
            if (c.ball != balls[i]) continue;
            contacts_.push_back(c);
            pushes_.push_back(link.push);
        }
    }
    if (balls.size() == 1 && contacts_.size() == 1) seconds_ = kLoneStep;
}

std::size_t IslandStep::index_of(int ball) const {
    const auto found = std::lower_bound(balls_.begin(), balls_.end(), ball);
    CAROM_CHECK(found != balls_.end(), ==, true);
    return static_cast<std::size_t>(found - balls_.begin());
}

/// The gap of a contact's pair where the balls will be `ahead` seconds on, at the speeds of now.
Nearest IslandStep::gap(const Contact& c, double ahead) const {
    const BallState& a = results_[index_of(c.ball)].start;
    const Vec3 x = a.position + ahead * a.velocity;
    const double radius = world_.ball(c.ball).radius;
    if (c.other.is_surface)
        return nearest_on_surface(x, radius, world_.surface(c.other.index).shape);
    const BallState& b = results_[index_of(c.other.index)].start;
    const SphereShape other{b.position + ahead * b.velocity, world_.ball(c.other.index).radius};
    return nearest_on_surface(x, radius, other);
}

void IslandStep::correct_positions() {
    std::vector<Vec3> push(balls_.size());
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        // All from the same places, so that what is symmetric stays so.
        std::fill(push.begin(), push.end(), Vec3::Zero());
        bool moved = false;
        for (const Contact& c : contacts_) {
            const Nearest nearest = gap(c, 0);
            double radius = world_.ball(c.ball).radius;
            double ours = inverse_mass(world_, c.ball), theirs = 0;
            if (!c.other.is_surface) {
                radius = std::min(radius, world_.ball(c.other.index).radius);
                theirs = inverse_mass(world_, c.other.index);
            }
            if (nearest.gap >= -kSlop * radius) continue;
            moved = true;
            const Vec3 apart = -kRelaxation * nearest.gap / (ours + theirs) * nearest.normal;
            push[index_of(c.ball)] += ours * apart;
            if (!c.other.is_surface) push[index_of(c.other.index)] -= theirs * apart;
        }
        if (!moved) return;
        for (std::size_t i = 0; i < balls_.size(); ++i) results_[i].start.position += push[i];
    }
}

void IslandStep::solve(IslandSolver& solver) {
    std::vector<ImpactBody> bodies;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        const ExactBall& b = world_.ball(balls_[i]);
        const BallState& s = results_[i].start;
        bodies.push_back({s.position + 0.5 * seconds_ * s.velocity,
                          {s.velocity, s.spin},
                          b.mass,
                          b.inertia_factor * b.mass * b.radius * b.radius});
    }
    std::vector<Contact> local = contacts_;
    for (Contact& c : local) {
        c.depth = -gap(c, 0).gap;
        c.normal = gap(c, 0.5 * seconds_).normal;
        c.arm = -world_.ball(c.ball).radius * c.normal;
        if (!c.other.is_surface) c.arm_other = world_.ball(c.other.index).radius * c.normal;
        c.ball = static_cast<int>(index_of(c.ball));
        if (!c.other.is_surface) c.other.index = static_cast<int>(index_of(c.other.index));
    }
    solver.step(bodies, local, pushes_, world_.scene.simulation.gravity, seconds_);

    for (std::size_t i = 0; i < balls_.size(); ++i) {
        after_[i] = bodies[i].velocities;
        Result& r = results_[i];
        r.acceleration = (after_[i].linear - r.start.velocity) / seconds_;
        r.spin_rate = (after_[i].spin - r.start.spin) / seconds_;
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const int ball = contacts_[i].ball;
        const Partner other = contacts_[i].other;
        contacts_[i] = local[i];
        contacts_[i].ball = ball;
        contacts_[i].other = other;
    }
}

bool IslandStep::is_calm(double speed) const {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        if (after_[i].linear.norm() > speed || results_[i].start.velocity.norm() > speed)
            return false;
        const double turned = (after_[i].spin - results_[i].start.spin).norm();
        if (world_.ball(balls_[i]).radius * turned > speed) return false;
    }
    return std::all_of(contacts_.begin(), contacts_.end(), [speed](const Contact& c) {
        return c.friction == 0 || c.slip_after.norm() <= speed;
    });
}

}  // namespace carom
