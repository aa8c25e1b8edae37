#include "sim/group/pile_step.h"

#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"
#include "sim/contact/rolling_resistance.h"

namespace carom {

namespace {

/// The longest step of a pile [s], and how often it may be halved.
constexpr double kLongestStep = 1.0 / 1000;
constexpr int kMostHalvings = 12;

/// A rebound at a step's start is early by at most this part of the smallest radius; gravity moves
/// a ball by no more in the longest step.
constexpr double kStepOfRadius = 0.03;

/// Gaps of up to this part of the smallest radius are looked at in any case.
constexpr double kLeastSlack = 1e-4;

/// A touching pair of which one sleeps has parted when its gap is above this part of the smallest
/// radius: its support may be gone.
constexpr double kParted = 1e-3;

/// Sweeps for the impacts of a step, and for its forces; the forces start from those of the step
/// before, so that a pile goes on converging while it comes to rest.
constexpr PileSweeps kImpactSweeps{60, 1e-4};
constexpr PileSweeps kForceSweeps{12, 1e-6};

/// What closes faster than this part of slow_speed() is stopped by an impulse at the step's start,
/// slower things by a force during it.
constexpr double kNudge = 0.25;

/// Sweeps that move overlapping balls apart, and the part of an overlap that one takes away.
constexpr int kOverlapSweeps = 3;
constexpr double kPileRelaxation = 0.4;

/// Overlaps up to this fraction of the smallest radius stay, so that resting balls do not move.
constexpr double kPileSlop = 1e-5;

/// What parting overlaps may take of the energy that the step loses: it never gains.
constexpr double kOverlapBudget = 0.5;

}  // namespace

PileStep::PileStep(const ExactWorld& world, PileBalls& balls, PilePairs& pairs)
    : world_(world),
      balls_(balls),
      pairs_(pairs),
      shift_(world.balls.size(), Vec3::Zero()),
      longest_(kLongestStep) {
    const double g = world.scene.simulation.gravity.norm();
    for (int i = 0; i < kMostHalvings; ++i)
        if (g * longest_ * longest_ > near_gap()) longest_ *= 0.5;
}

double PileStep::near_gap() const { return kStepOfRadius * balls_.smallest_radius(); }

double PileStep::slack(double seconds) const {
    return kLeastSlack * balls_.smallest_radius() + near_gap() +
           world_.scene.simulation.gravity.norm() * seconds * seconds;
}

double PileStep::until_meeting(const PilePair& pair, double closing, double seconds) const {
    if (!(pair.gap > near_gap()) || !(closing * seconds > pair.gap)) return seconds;
    return pair.gap / closing;
}

double PileStep::slow_speed() const {
    return 2 * world_.scene.simulation.gravity.norm() * longest_;
}

double PileStep::separation_gap() const { return kParted * balls_.smallest_radius(); }

double PileStep::solve(double now, double seconds) {
    seconds_ = seconds;
    build_rows();
    const double before = kinetic_energy();
    solve_impacts();
    const double at_start = kinetic_energy();
    shorten(now);
    solve_forces();
    const double by_impacts = std::max(before - at_start, 0.0);
    const double by_forces = at_start + fall_energy() - kinetic_energy();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const PilePair& pair = pairs_.all()[active_[k]];
        if (pair.laws != nullptr && pair.laws->resists()) resist_rolling(pair, rows_[k]);
    }
    note_contacts();
    part_overlaps(by_impacts, by_forces);
    return seconds_;
}

// ---- Energy
// -------------------------------------------------------------------------------------

double PileStep::kinetic_energy() const {
    double sum = 0;
    for (const int ball : balls_.awake()) {
        const PileBody& b = balls_.body(ball);
        sum += b.velocity.squaredNorm() / b.inverse_mass + b.rim.squaredNorm() / b.inverse_spin;
    }
    return 0.5 * sum;
}

double PileStep::kinetic_energy(int ball, const Velocities& v) const {
    const ExactBall& b = world_.ball(ball);
    return 0.5 * b.mass *
           (v.linear.squaredNorm() + b.inertia_factor * b.radius * b.radius * v.spin.squaredNorm());
}

/// What gravity has given over the step: m g . h (v + v')/2 of all.
double PileStep::fall_energy() const {
    double sum = 0;
    for (const int ball : balls_.awake()) {
        const PileBody& b = balls_.body(ball);
        const Vec3 pull = world_.pull_on(ball, balls_.of(ball).started);
        sum += pull.dot(balls_.of(ball).started.linear + b.velocity) / b.inverse_mass;
    }
    return 0.5 * seconds_ * sum;
}

/// Takes an energy out of all speeds, evenly: what the unfinished iterations had gained.
void PileStep::slow_down(double too_much) {
    const double all = kinetic_energy();
    if (!(too_much > 0) || !(all > 0)) return;
    const double factor = std::sqrt(std::max(1 - too_much / all, 0.0));
    for (const int ball : balls_.awake()) {
        balls_.body(ball).velocity *= factor;
        balls_.body(ball).rim *= factor;
    }
}

// ---- Rows
// ---------------------------------------------------------------------------------------

/// The normal of the middle of the step: there uniform rolling keeps its energy.
void PileStep::aim_at_mid_step(PileRow& row, const PilePair& pair) const {
    row.normal = pair.normal;
    const double half = 0.5 * seconds_;
    const BallState& a = balls_.of(pair.ball).at;
    Vec3 x = a.position + half * a.velocity;
    if (!pair.other.is_surface) {
        const BallState& b = balls_.of(pair.other.index).at;
        x -= b.position + half * b.velocity;
        if (const double distance = x.norm(); distance > 0) row.normal = x / distance;
        return;
    }
    const SurfaceShape& shape = world_.surface(pair.other.index).shape;
    if (is_unbounded(shape)) return;
    row.normal = nearest_on(shape, x, world_.ball(pair.ball).radius).normal;
}

void PileStep::build_rows() {
    active_.clear();
    rows_.clear();
    std::vector<PilePair>& pairs = pairs_.all();
    const double reach = slack(seconds_);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        PilePair& pair = pairs[i];
        pair.bounces = false;
        pair.impact_push = pair.impact_tangential = 0;
        if (!(pair.gap < reach)) {
            pair.force = 0;
            pair.friction_force.setZero();
            continue;
        }
        active_.push_back(i);
        PileRow& row = rows_.emplace_back();
        row.ball = pair.ball;
        row.other = pair.other.is_surface ? -1 : pair.other.index;
        row.friction = pair.friction;
        aim_at_mid_step(row, pair);
    }
}

// ---- Parts
// --------------------------------------------------------------------------------------

void PileStep::solve_impacts() {
    bool any = false;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        PilePair& pair = pairs_.all()[active_[k]];
        PileRow& row = rows_[k];
        const double closing = -normal_speed(row, balls_.bodies());
        pair.bounces = closing > slow_speed() && closing * seconds_ > pair.gap;
        if (pair.bounces && pair.laws != nullptr && pair.laws->by_speed())
            pair.restitution = pair.laws->restitution_at(closing);
        row.target =
            pair.bounces ? pair.restitution * closing : -std::max(pair.gap, 0.0) / seconds_;
        any |= closing > kNudge * slow_speed() && closing * seconds_ > pair.gap;
    }
    if (!any) return;
    const double before = kinetic_energy();
    sweep_pile(balls_.bodies(), rows_, kImpactSweeps);
    slow_down(kinetic_energy() - before);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        PilePair& pair = pairs_.all()[active_[k]];
        pair.impact_push = rows_[k].push;
        pair.impact_tangential = rows_[k].tangential.norm();
        if (pair.bounces) pair.separation = normal_speed(rows_[k], balls_.bodies());
        rows_[k].push = 0;
        rows_[k].tangential.setZero();
    }
}

/// Impacts have changed velocities: the step ends before what they have sent on its way meets.
void PileStep::shorten(double now) {
    const auto velocity = [&](int ball) {
        return balls_.is_awake(ball) ? balls_.body(ball).velocity : balls_.velocity(ball, now);
    };
    double fastest = 0;
    for (const int ball : balls_.awake())
        fastest = std::max(fastest, balls_.body(ball).velocity.squaredNorm());
    // What is not in the list is out of sight, and not so near that it could not bounce early.
    const double sight = std::max(pairs_.sight(), near_gap());
    if (const double most = 2 * std::sqrt(fastest); most * seconds_ > sight)
        seconds_ = sight / most;
    for (const PilePair& pair : pairs_.all()) {
        if (!(pair.gap > near_gap())) continue;
        Vec3 apart = velocity(pair.ball);
        if (!pair.other.is_surface) apart -= velocity(pair.other.index);
        seconds_ = until_meeting(pair, -apart.dot(pair.normal), seconds_);
    }
}

void PileStep::solve_forces() {
    const double before = kinetic_energy();
    for (const int ball : balls_.awake()) {
        const PileBody& b = balls_.body(ball);
        balls_.of(ball).started = {b.velocity, b.rim / world_.ball(ball).radius};
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const PilePair& pair = pairs_.all()[active_[k]];
        PileRow& row = rows_[k];
        // (v + v')_n h / 2 >= -gap; what still closes is stopped, but not thrown back.
        row.target = std::min(
            -normal_speed(row, balls_.bodies()) - 2 * std::max(pair.gap, 0.0) / seconds_, 0.0);
        row.push = pair.force * seconds_;
        row.tangential = pair.friction_force * seconds_;
    }
    for (const int ball : balls_.awake())
        balls_.body(ball).velocity += seconds_ * world_.pull_on(ball, balls_.of(ball).started);
    sweep_pile(balls_.bodies(), rows_, kForceSweeps);
    slow_down(kinetic_energy() - before - fall_energy());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        PilePair& pair = pairs_.all()[active_[k]];
        const PileRow& row = rows_[k];
        pair.force = row.push / seconds_;
        pair.friction_force = row.tangential / seconds_;
        const Vec3 relative = relative_velocity(row, balls_.bodies());
        pair.slip =
            row.friction > 0 ? (relative - relative.dot(row.normal) * row.normal).norm() : 0;
    }
}

/// What rolling resistance and pivoting take from the velocities that the step has led to.
void PileStep::resist_rolling(const PilePair& pair, const PileRow& row) {
    struct Resisted {
        Velocities velocities;
        ResistedBall ball;
    };
    const auto begin = [this](int i, Resisted& resisted) {
        const PileBody& b = balls_.body(i);
        const double radius = world_.ball(i).radius;
        resisted.velocities = {b.velocity, b.rim / radius};
        resisted.ball = {&resisted.velocities, radius, 1 / b.inverse_mass,
                         radius * radius / b.inverse_spin};
    };
    const auto end = [this](int i, const Resisted& resisted) {
        balls_.body(i).velocity = resisted.velocities.linear;
        balls_.body(i).rim = world_.ball(i).radius * resisted.velocities.spin;
    };
    // A sleeping partner does not move.
    if (!balls_.is_awake(pair.ball) || (row.other >= 0 && !balls_.is_awake(row.other))) return;
    Resisted ball, other;
    begin(pair.ball, ball);
    if (row.other >= 0) begin(row.other, other);
    Touch contact;
    contact.normal = row.normal;
    contact.friction = row.friction;
    contact.laws = pair.laws;
    resist(contact, {row.push, row.tangential}, ball.ball, row.other >= 0 ? &other.ball : nullptr);
    end(pair.ball, ball);
    if (row.other >= 0) end(row.other, other);
}

// ---- Overlaps
// -----------------------------------------------------------------------------------

/// Moves the two of a pair apart, the lighter one more: by how much [m].
double PileStep::part_pair(const PilePair& pair) {
    Vec3& shift = shift_[static_cast<std::size_t>(pair.ball)];
    Vec3* other =
        pair.other.is_surface ? nullptr : &shift_[static_cast<std::size_t>(pair.other.index)];
    const double mine = balls_.body(pair.ball).inverse_mass;
    const double its = other == nullptr ? 0 : balls_.body(pair.other.index).inverse_mass;
    const Vec3 apart = other == nullptr ? shift : Vec3(shift - *other);
    const double gap = pair.gap + apart.dot(pair.normal);
    if (gap >= -kPileSlop * balls_.smallest_radius()) return 0;
    const Vec3 push = -kPileRelaxation * gap / (mine + its) * pair.normal;
    shift += mine * push;
    if (other != nullptr) *other -= its * push;
    return -kPileRelaxation * gap;
}

/// Moves overlapping balls apart at the step's start, as far as the energy lifts them that impacts
/// have taken there, and that forces are yet to take from speeds: these are lower at the start
/// then, and as without it at the end.
void PileStep::part_overlaps(double by_impacts, double by_forces) {
    bool any = false;
    for (int sweep = 0; sweep < kOverlapSweeps; ++sweep) {
        double moved = 0;
        for (const std::size_t i : active_) moved = std::max(moved, part_pair(pairs_.all()[i]));
        if (!(moved > 0)) break;
        any = true;
    }
    if (!any) return;
    const auto shift = [&](int ball) -> Vec3& { return shift_[static_cast<std::size_t>(ball)]; };
    double rise = 0, moving = 0;
    for (const int ball : balls_.awake()) {
        const PileBall& b = balls_.of(ball);
        rise -= world_.ball(ball).mass * world_.pull(ball).dot(shift(ball));
        if (b.pushed) moving += kinetic_energy(ball, b.started);
    }
    const double most = kOverlapBudget * (by_impacts + std::clamp(by_forces, 0.0, moving));
    const double factor = rise > most ? most / rise : 1;
    const double unpaid = std::max(factor * rise - by_impacts, 0.0);
    const double slower = unpaid > 0 ? std::sqrt(1 - unpaid / moving) : 1;
    for (const int ball : balls_.awake()) {
        PileBall& b = balls_.of(ball);
        b.at.position += factor * shift(ball);
        shift(ball).setZero();
        if (!b.pushed) continue;
        b.started.linear *= slower;
        b.started.spin *= slower;
    }
}

/// What the step means for each ball and each pair.
void PileStep::note_contacts() {
    for (const int ball : balls_.awake()) {
        PileBall& b = balls_.of(ball);
        b.after = {balls_.body(ball).velocity, balls_.body(ball).rim / world_.ball(ball).radius};
        b.near = 0;
        b.pushed = false;
    }
    const double reach = 2 * slack(longest_);
    for (PilePair& pair : pairs_.all()) {
        if (!(pair.gap < reach)) continue;
        const bool pushes = pair.force > 0 || pair.impact_push > 0;
        pair.touching = pair.gap < separation_gap();
        ++balls_.of(pair.ball).near;
        balls_.of(pair.ball).pushed |= pushes;
        if (pair.other.is_surface) continue;
        ++balls_.of(pair.other.index).near;
        balls_.of(pair.other.index).pushed |= pushes;
    }
}

}  // namespace carom
