#include "sim/group/island_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "geometry/nearest.h"
#include "sim/contact/rolling_resistance.h"

namespace carom {

namespace {

/// Sweeps over all contacts of an island in one step; what is left is for the next step.
constexpr int kSweeps = 8;

/// Part of an overlap that one sweep takes away: several contacts push a ball at once.
constexpr double kIslandRelaxation = 0.5;

/// Overlaps up to this fraction of the smaller radius stay, so that resting balls do not move.
constexpr double kIslandSlop = 1e-9;

/// What moving overlapping balls apart may take of the kinetic energy: they go on moving.
constexpr double kLiftPart = 0.5;

/// Potentials follow speeds after so many rounds.
constexpr int kEnergyRounds = 3;

/// Between the ends of a step the energy may rise by this fraction of what is in play. A step that
/// would do more is shortened, which lowers it with the square; at most to this fraction.
constexpr double kRise = 5e-10;
constexpr double kShortest = 1.0 / 64;

double inverse_mass(const ExactWorld& world, int ball) { return 1 / world.ball(ball).mass; }

/// How fast a contact's pair parts, m/s.
double normal_speed(const SolverContact& c, const std::vector<ImpactBody>& bodies) {
    const auto linear = [&](int i) {
        return bodies[static_cast<std::size_t>(i)].velocities.linear;
    };
    Vec3 relative = linear(c.body);
    if (!c.on_surface()) relative -= linear(c.other_body);
    return relative.dot(c.normal);
}

}  // namespace

IslandStep::IslandStep(const ExactWorld& world, const Links& links, const std::vector<int>& balls,
                       double now)
    : world_(world), balls_(balls), results_(balls.size()), after_(balls.size()) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const BallState& start = results_[i].start = world.state(balls[i], now);
        const ExactBall& b = world.ball(balls[i]);
        account_.add(b.mass, b.inertia_factor * b.mass * b.radius * b.radius, b.radius,
                     start.position, world.pull_on(balls[i], {start.velocity, start.spin}));
        for (const Link& link : links.of(balls[i])) {
            const Contact c = world.contact_at(balls[i], link.partner, now);
            if (c.ball != balls[i]) continue;
            contacts_.push_back(c);
            pushes_.push_back(link.push);
        }
    }
    energy_ = account_.total(start_places(), start_velocities());
    if (balls.size() == 1 && contacts_.size() == 1) seconds_ = kLoneStep;
}

std::vector<Vec3> IslandStep::start_places() const {
    std::vector<Vec3> places;
    for (const Result& r : results_) places.push_back(r.start.position);
    return places;
}

std::vector<Velocities> IslandStep::start_velocities() const {
    std::vector<Velocities> velocities;
    for (const Result& r : results_) velocities.push_back({r.start.velocity, r.start.spin});
    return velocities;
}

std::vector<Vec3> IslandStep::end_places() const {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < results_.size(); ++i) {
        const BallState& start = results_[i].start;
        places.push_back(start.position + 0.5 * seconds_ * (start.velocity + after_[i].linear));
    }
    return places;
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

/// Whether there were any.
bool IslandStep::part_overlaps() {
    bool any = false;
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
            if (nearest.gap >= -kIslandSlop * radius) continue;
            moved = true;
            const Vec3 apart = -kIslandRelaxation * nearest.gap / (ours + theirs) * nearest.normal;
            push[index_of(c.ball)] += ours * apart;
            if (!c.other.is_surface) push[index_of(c.other.index)] -= theirs * apart;
        }
        if (!moved) return any;
        any = true;
        for (std::size_t i = 0; i < balls_.size(); ++i) results_[i].start.position += push[i];
    }
    return any;
}

void IslandStep::correct_positions() {
    const std::vector<Vec3> old_places = start_places();
    if (!part_overlaps()) return;
    const double lift = account_.lift(old_places, start_places());
    const double most = kLiftPart * account_.kinetic(start_velocities());
    if (lift <= most) return;
    const double part = most / lift;
    for (std::size_t i = 0; i < results_.size(); ++i) {
        Vec3& x = results_[i].start.position;
        x = old_places[i] + part * (x - old_places[i]);
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
                       b.inertia_factor * b.mass * b.radius * b.radius,
                       world_.air_on(balls_[i], {s.velocity, s.spin})});
    }
    return all;
}

/// The contacts under the numbers that the balls have in the island, `ahead` seconds on.
std::vector<SolverContact> IslandStep::local_contacts(double ahead) const {
    std::vector<SolverContact> local;
    for (const Contact& contact : contacts_) {
        const bool surface = contact.other.is_surface;
        SolverContact& c =
            local.emplace_back(contact, static_cast<int>(index_of(contact.ball)),
                               surface ? -1 : static_cast<int>(index_of(contact.other.index)));
        c.depth = -gap(contact, 0).gap;
        c.normal = gap(contact, ahead).normal;
        c.arm = -world_.ball(contact.ball).radius * c.normal;
        if (!surface) c.arm_other = world_.ball(contact.other.index).radius * c.normal;
    }
    return local;
}

/// What approaches meets without rebound at once: over a step it would overlap before it stops.
void IslandStep::stop_approaches(IslandSolver& solver) {
    std::vector<ImpactBody> meeting = bodies(0);
    std::vector<SolverContact> local = local_contacts(0);
    bool approaches = false;
    for (SolverContact& c : local) {
        const double overlap = c.depth - 0.5 * seconds_ * normal_speed(c, meeting);
        if (normal_speed(c, meeting) >= 0 || overlap <= kIslandSlop * c.arm.norm()) continue;
        approaches = true;
        c.depth = 0;
    }
    if (!approaches) return;
    for (ImpactBody& body : meeting) body.air.setZero();
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
    const double full = seconds_;
    std::vector<SolverContact> local;
    for (;;) {
        std::vector<ImpactBody> moving = bodies(0.5 * seconds_);
        local = local_contacts(0.5 * seconds_);
        solver.step(moving, local, pushes_, world_.scene.simulation.gravity, seconds_);
        resist_rolling(moving, local);
        for (std::size_t i = 0; i < balls_.size(); ++i) after_[i] = moving[i].velocities;
        keep_energy_at_end();
        set_rates();
        const double too_much = rise_within() / (kRise * account_.in_play(start_velocities()));
        if (!(too_much > 1) || seconds_ <= kShortest * full) break;
        const double part = std::clamp(0.9 / std::sqrt(too_much), 0.125, 0.75);
        seconds_ *= part;
        for (Vec3& push : pushes_) push *= part;
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i)
        contacts_[i] = {local[i], contacts_[i].ball, contacts_[i].other};
}

/// What rolling resistance and pivoting take from the velocities that the step has led to.
void IslandStep::resist_rolling(std::vector<ImpactBody>& moving,
                                const std::vector<SolverContact>& local) const {
    const auto resisted = [&](int body) {
        ImpactBody& b = moving[static_cast<std::size_t>(body)];
        return ResistedBall{&b.velocities,
                            world_.ball(balls_[static_cast<std::size_t>(body)]).radius, b.mass,
                            b.inertia};
    };
    for (std::size_t i = 0; i < local.size(); ++i) {
        const SolverContact& c = local[i];
        if (!is_resisted(c)) continue;
        const ResistedBall other = c.on_surface() ? ResistedBall{} : resisted(c.other_body);
        resist(c, {c.impulse, tangential_part(pushes_[i], c.normal)}, resisted(c.body),
               c.on_surface() ? nullptr : &other);
    }
}

void IslandStep::set_rates() {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        Result& r = results_[i];
        r.acceleration = (after_[i].linear - r.start.velocity) / seconds_;
        r.spin_rate = (after_[i].spin - r.start.spin) / seconds_;
    }
}

/// How far the energy rises on the way, J.
double IslandStep::rise_within() const {
    std::vector<Vec3> accelerations, spin_rates;
    for (const Result& r : results_) {
        accelerations.push_back(r.acceleration);
        spin_rates.push_back(r.spin_rate);
    }
    const double bulge =
        -0.125 * seconds_ * seconds_ * account_.second_rate(accelerations, spin_rates);
    return rise_of_parabola(energy_ - account_.total(end_places(), after_), bulge);
}

/// Places that are put right may lie higher.
void IslandStep::keep_energy_at_start() {
    std::vector<Velocities> velocities = start_velocities();
    const std::vector<Vec3> places = start_places();
    if (account_.take_away(account_.total(places, velocities) - energy_, velocities))
        set_start(velocities);
    energy_ = account_.total(places, velocities);  // less where something has been stopped
}

void IslandStep::keep_energy_at_end() {
    for (int round = 0; round < kEnergyRounds; ++round)
        if (!account_.take_away(account_.total(end_places(), after_) - energy_, after_)) return;
}

bool IslandStep::is_calm(double speed) const {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        if (after_[i].linear.norm() > speed || results_[i].start.velocity.norm() > speed)
            return false;
        const double turned = (after_[i].spin - results_[i].start.spin).norm();
        if (world_.ball(balls_[i]).radius * turned > speed) return false;
    }
    return std::all_of(contacts_.begin(), contacts_.end(), [&](const Contact& c) {
        if (c.friction > 0 && c.slip_after.norm() > speed) return false;
        if (c.laws == nullptr || !(c.laws->pivoting > 0)) return true;
        // However slowly pivoting ends it.
        Vec3 spin = after_[index_of(c.ball)].spin;
        if (!c.other.is_surface) spin -= after_[index_of(c.other.index)].spin;
        return world_.ball(c.ball).radius * std::abs(spin.dot(c.normal)) <= speed;
    });
}

}  // namespace carom
