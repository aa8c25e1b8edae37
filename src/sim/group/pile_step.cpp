// One step of a pile: impacts, then forces, then what they leave of overlaps.
#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"
#include "sim/group/pile.h"

namespace carom {

namespace {

/// Sweeps for the impacts of a step, and for its forces; the forces start from those of the step
/// before, so that a pile goes on converging while it comes to rest.
constexpr PileSweeps kImpactSweeps{60, 1e-4};
constexpr PileSweeps kForceSweeps{12, 1e-6};

/// What closes faster than this part of slow_speed() is stopped by an impulse at the step's start,
/// slower things by a force during it.
constexpr double kNudge = 0.25;

/// Sweeps that move overlapping balls apart, and the part of an overlap that one takes away.
constexpr int kOverlapSweeps = 3;
constexpr double kRelaxation = 0.4;

/// Overlaps up to this fraction of the smallest radius stay, so that resting balls do not move.
constexpr double kSlop = 1e-5;

/// What parting overlaps may take of the energy that the step has lost: it never gains.
constexpr double kOverlapBudget = 0.5;

}  // namespace

double Pile::kinetic_energy() const {
    double sum = 0;
    for (const int ball : awake_) {
        const PileBody& b = bodies_[static_cast<std::size_t>(ball)];
        sum += b.velocity.squaredNorm() / b.inverse_mass + b.rim.squaredNorm() / b.inverse_spin;
    }
    return 0.5 * sum;
}

/// What gravity has given over the step: m g . h (v + v')/2 of all.
double Pile::fall_energy() const {
    const Vec3 g = world_.scene.simulation.gravity;
    double sum = 0;
    for (const int ball : awake_) {
        const PileBody& b = bodies_[static_cast<std::size_t>(ball)];
        sum += g.dot(of(ball).started.linear + b.velocity) / b.inverse_mass;
    }
    return 0.5 * seconds_ * sum;
}

/// Takes an energy out of all speeds, evenly: what the unfinished iterations had gained.
void Pile::slow_down(double too_much) {
    const double all = kinetic_energy();
    if (!(too_much > 0) || !(all > 0)) return;
    const double factor = std::sqrt(std::max(1 - too_much / all, 0.0));
    for (const int ball : awake_) {
        body(ball).velocity *= factor;
        body(ball).rim *= factor;
    }
}

// ---- Rows
// ---------------------------------------------------------------------------------------

/// The normal of the middle of the step: there uniform rolling keeps its energy.
void Pile::aim_at_mid_step(PileRow& row, const PilePair& pair) const {
    row.normal = pair.normal;
    const double half = 0.5 * seconds_;
    const BallState& a = of(pair.ball).at;
    Vec3 x = a.position + half * a.velocity;
    if (!pair.other.is_surface) {
        const BallState& b = of(pair.other.index).at;
        x -= b.position + half * b.velocity;
        if (const double distance = x.norm(); distance > 0) row.normal = x / distance;
        return;
    }
    const SurfaceShape& shape = world_.surface(pair.other.index).shape;
    if (is_unbounded(shape)) return;
    row.normal = nearest_on(shape, x, world_.ball(pair.ball).radius).normal;
}

void Pile::build_rows() {
    active_.clear();
    rows_.clear();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        PilePair& pair = pairs_[i];
        pair.bounces = false;
        pair.impact_push = pair.impact_tangential = 0;
        if (!(pair.gap < slack_)) {
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

void Pile::solve_impacts() {
    bool any = false;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        PilePair& pair = pairs_[active_[k]];
        PileRow& row = rows_[k];
        const double closing = -normal_speed(row, bodies_);
        pair.bounces = closing > slow_speed() && closing * seconds_ > pair.gap;
        row.target =
            pair.bounces ? pair.restitution * closing : -std::max(pair.gap, 0.0) / seconds_;
        any |= closing > kNudge * slow_speed() && closing * seconds_ > pair.gap;
    }
    if (!any) return;
    const double before = kinetic_energy();
    sweep_pile(bodies_, rows_, kImpactSweeps);
    slow_down(kinetic_energy() - before);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        PilePair& pair = pairs_[active_[k]];
        pair.impact_push = rows_[k].push;
        pair.impact_tangential = rows_[k].tangential.norm();
        if (pair.bounces) pair.separation = normal_speed(rows_[k], bodies_);
        rows_[k].push = 0;
        rows_[k].tangential.setZero();
    }
}

void Pile::solve_forces() {
    const double before = kinetic_energy();
    for (const int ball : awake_)
        of(ball).started = {body(ball).velocity, body(ball).rim / world_.ball(ball).radius};
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const PilePair& pair = pairs_[active_[k]];
        PileRow& row = rows_[k];
        // (v + v')_n h / 2 >= -gap; what still closes is stopped, but not thrown back.
        row.target =
            std::min(-normal_speed(row, bodies_) - 2 * std::max(pair.gap, 0.0) / seconds_, 0.0);
        row.push = pair.force * seconds_;
        row.tangential = pair.friction_force * seconds_;
    }
    const Vec3 fall = seconds_ * world_.scene.simulation.gravity;
    for (const int ball : awake_) body(ball).velocity += fall;
    sweep_pile(bodies_, rows_, kForceSweeps);
    slow_down(kinetic_energy() - before - fall_energy());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        PilePair& pair = pairs_[active_[k]];
        const PileRow& row = rows_[k];
        pair.force = row.push / seconds_;
        pair.friction_force = row.tangential / seconds_;
        const Vec3 relative = relative_velocity(row, bodies_);
        pair.slip =
            row.friction > 0 ? (relative - relative.dot(row.normal) * row.normal).norm() : 0;
    }
}

/// Moves overlapping balls apart, the lighter ones more, as far as the lost energy lifts them.
void Pile::part_overlaps(double budget) {
    bool any = false;
    for (int sweep = 0; sweep < kOverlapSweeps; ++sweep) {
        bool moved = false;
        for (const std::size_t i : active_) {
            const PilePair& pair = pairs_[i];
            Vec3 apart = shift_[static_cast<std::size_t>(pair.ball)];
            double masses = body(pair.ball).inverse_mass;
            if (!pair.other.is_surface) {
                apart -= shift_[static_cast<std::size_t>(pair.other.index)];
                masses += body(pair.other.index).inverse_mass;
            }
            const double gap = pair.gap + apart.dot(pair.normal);
            if (gap >= -kSlop * smallest_radius_) continue;
            moved = true;
            const Vec3 push = -kRelaxation * gap / masses * pair.normal;
            shift_[static_cast<std::size_t>(pair.ball)] += body(pair.ball).inverse_mass * push;
            if (!pair.other.is_surface)
                shift_[static_cast<std::size_t>(pair.other.index)] -=
                    body(pair.other.index).inverse_mass * push;
        }
        if (!moved) break;
        any = true;
    }
    if (!any) return;
    double rise = 0;
    for (const int ball : awake_)
        rise -= world_.ball(ball).mass *
                world_.scene.simulation.gravity.dot(shift_[static_cast<std::size_t>(ball)]);
    const double most = std::max(budget, 0.0);
    const double factor = rise > most ? most / rise : 1;
    for (const int ball : awake_) {
        Vec3& shift = shift_[static_cast<std::size_t>(ball)];
        of(ball).at.position += factor * shift;
        shift.setZero();
    }
}

void Pile::solve() {
    build_rows();
    const double before = kinetic_energy();
    solve_impacts();
    solve_forces();
    const double lost = before + fall_energy() - kinetic_energy();
    part_overlaps(kOverlapBudget * lost);
    for (const int ball : awake_) {
        PileBall& b = of(ball);
        b.after = {body(ball).velocity, body(ball).rim / world_.ball(ball).radius};
        b.near = 0;
        b.pushed = false;
    }
    for (PilePair& pair : pairs_) {
        if (!(pair.gap < 2 * slack_)) continue;
        const bool pushes = pair.force > 0 || pair.impact_push > 0;
        pair.touching = pair.gap < separation_gap();
        ++of(pair.ball).near;
        of(pair.ball).pushed |= pushes;
        if (pair.other.is_surface) continue;
        ++of(pair.other.index).near;
        of(pair.other.index).pushed |= pushes;
    }
}

}  // namespace carom
