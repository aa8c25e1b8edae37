#include "sim/group/island_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "geometry/nearest.h"

namespace carom {

namespace {

/// Sweeps over all contacts of an island in one step; what is left is for the next step.
constexpr int kSweeps = 8;

/// Part of an overlap that one sweep takes away: several contacts push a ball at once.
constexpr double kRelaxation = 0.5;

/// Overlaps up to this fraction of the smaller radius stay, so that resting balls do not move.
constexpr double kSlop = 1e-9;

/// A rise of energy by this fraction is rounding; potentials follow speeds after so many rounds.
constexpr double kEnergyRounding = 1e-14;
constexpr int kEnergyRounds = 3;

double inverse_mass(const ExactWorld& world, int ball) { return 1 / world.ball(ball).mass; }

/// How fast a contact's pair parts, m/s.
double normal_speed(const Contact& c, const std::vector<ImpactBody>& bodies) {
    const auto linear = [&](int i) {
        return bodies[static_cast<std::size_t>(i)].velocities.linear;
    };
    Vec3 relative = linear(c.ball);
    if (!c.other.is_surface) relative -= linear(c.other.index);
    return relative.dot(c.normal);
}

}  // namespace

IslandStep::IslandStep(const ExactWorld& world, const Links& links, const std::vector<int>& balls,
                       double now)
    : world_(world), balls_(balls), results_(balls.size()), after_(balls.size()) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const BallState& start = results_[i].start = world.state(balls[i], now);
        places_.push_back(start.position);
        energy_ += 0.5 * world.ball(balls[i]).mass * start.velocity.squaredNorm() +
                   turning_energy(i, start.spin);
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
    if (c.other.is_surface) return nearest_on(world_.surface(c.other.index).shape, x, radius);
    const BallState& b = results_[index_of(c.other.index)].start;
    const SphereShape other{b.position + ahead * b.velocity, world_.ball(c.other.index).radius};
    return nearest_on(other, x, radius);
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

/// The balls as the solver sees them, `ahead` seconds on.
std::vector<ImpactBody> IslandStep::bodies(double ahead) const {
    std::vector<ImpactBody> all;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        const ExactBall& b = world_.ball(balls_[i]);
        const BallState& s = results_[i].start;
        all.push_back({s.position + ahead * s.velocity,
                       {s.velocity, s.spin},
                       b.mass,
                       b.inertia_factor * b.mass * b.radius * b.radius});
    }
    return all;
}

/// The contacts under the numbers that the balls have in the island, `ahead` seconds on.
std::vector<Contact> IslandStep::local_contacts(double ahead) const {
    std::vector<Contact> local = contacts_;
    for (Contact& c : local) {
        c.depth = -gap(c, 0).gap;
        c.normal = gap(c, ahead).normal;
        c.arm = -world_.ball(c.ball).radius * c.normal;
        if (!c.other.is_surface) c.arm_other = world_.ball(c.other.index).radius * c.normal;
        c.ball = static_cast<int>(index_of(c.ball));
        if (!c.other.is_surface) c.other.index = static_cast<int>(index_of(c.other.index));
    }
    return local;
}

/// What approaches meets without rebound at once: over a step it would overlap before it stops.
void IslandStep::stop_approaches(IslandSolver& solver) {
    std::vector<ImpactBody> meeting = bodies(0);
    std::vector<Contact> local = local_contacts(0);
    bool approaches = false;
    for (Contact& c : local) {
        const double overlap = c.depth - 0.5 * seconds_ * normal_speed(c, meeting);
        if (normal_speed(c, meeting) >= 0 || overlap <= kSlop * c.arm.norm()) continue;
        approaches = true;
        c.depth = 0;
    }
    if (!approaches) return;
    std::vector<Vec3> pushes(pushes_.size(), Vec3::Zero());
    solver.step(meeting, local, pushes, Vec3::Zero(), seconds_);
    std::vector<Velocities> velocities;
    for (const ImpactBody& body : meeting) velocities.push_back(body.velocities);
    set_start(velocities);
}

void IslandStep::set_start(const std::vector<Velocities>& velocities) {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        results_[i].start.velocity = velocities[i].linear;
        results_[i].start.spin = velocities[i].spin;
    }
}

void IslandStep::solve(IslandSolver& solver) {
    stop_approaches(solver);
    keep_energy_at_start();
    std::vector<ImpactBody> moving = bodies(0.5 * seconds_);
    std::vector<Contact> local = local_contacts(0.5 * seconds_);
    solver.step(moving, local, pushes_, world_.scene.simulation.gravity, seconds_);

    for (std::size_t i = 0; i < balls_.size(); ++i) after_[i] = moving[i].velocities;
    keep_energy_at_end();
    for (std::size_t i = 0; i < balls_.size(); ++i) {
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

double IslandStep::turning_energy(std::size_t ball, const Vec3& spin) const {
    const ExactBall& b = world_.ball(balls_[ball]);
    return 0.5 * b.inertia_factor * b.mass * b.radius * b.radius * spin.squaredNorm();
}

/// The kinetic energy that the balls would have, less what gravity has done on the way to `ends`.
double IslandStep::energy(const std::vector<Velocities>& velocities,
                          const std::vector<Vec3>& ends) const {
    double sum = 0;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        const double mass = world_.ball(balls_[i]).mass;
        sum += 0.5 * mass * velocities[i].linear.squaredNorm() +
               turning_energy(i, velocities[i].spin) -
               mass * world_.scene.simulation.gravity.dot(ends[i] - places_[i]);
    }
    return sum;
}

/// Takes an excess of energy [J] from speeds relative to the centre of mass, if that suffices.
/// False where there is none beyond rounding.
bool IslandStep::take_away(double excess, std::vector<Velocities>& velocities) const {
    Vec3 centre = Vec3::Zero();
    double total_mass = 0;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        centre += world_.ball(balls_[i]).mass * velocities[i].linear;
        total_mass += world_.ball(balls_[i]).mass;
    }
    centre /= total_mass;
    double relative = 0;
    for (std::size_t i = 0; i < balls_.size(); ++i)
        relative +=
            0.5 * world_.ball(balls_[i]).mass * (velocities[i].linear - centre).squaredNorm() +
            turning_energy(i, velocities[i].spin);
    const double all = relative + 0.5 * total_mass * centre.squaredNorm();
    if (excess <= kEnergyRounding * all) return false;
    const bool suffices = relative > 2 * excess;
    if (!suffices) centre.setZero();
    const double factor = std::sqrt(std::max(0.0, 1 - excess / (suffices ? relative : all)));
    for (Velocities& v : velocities) {
        v.linear = centre + factor * (v.linear - centre);
        v.spin *= factor;
    }
    return true;
}

/// Places that are put right may lie higher.
void IslandStep::keep_energy_at_start() {
    std::vector<Velocities> velocities;
    std::vector<Vec3> places;
    for (const Result& r : results_) {
        velocities.push_back({r.start.velocity, r.start.spin});
        places.push_back(r.start.position);
    }
    if (take_away(energy(velocities, places) - energy_, velocities)) set_start(velocities);
    energy_ = energy(velocities, places);  // less where something has been stopped
}

void IslandStep::keep_energy_at_end() {
    for (int round = 0; round < kEnergyRounds; ++round) {
        std::vector<Vec3> ends;
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            const BallState& start = results_[i].start;
            ends.push_back(start.position + 0.5 * seconds_ * (start.velocity + after_[i].linear));
        }
        if (!take_away(energy(after_, ends) - energy_, after_)) return;
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
