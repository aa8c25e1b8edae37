#include "sim/law/coupled_equations.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <utility>

namespace carom {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostForces, kMostForces>;

/// Forces whose effects differ by no more than this fraction are the same one twice.
constexpr double kRank = 1e-9;

/// Where all pivots of scaled equations are larger, no force is undetermined.
constexpr double kPivot = 1e-6;

/// Of forces that the motion leaves undetermined, friction is held to be the dearer one: it acts
/// only where a normal force alone would not do.
constexpr double kFrictionIsDear = 1e-3;

ContactMotion contact_motion(const CoupledContacts& system, const CoupledContact& c,
                             const CoupledState& state) {
    const ContactState& a = state[static_cast<std::size_t>(c.ball)];
    ContactMotion m;
    Vec3 v = a.v;
    m.turn_speed = system.balls[static_cast<std::size_t>(c.ball)].radius * a.w;
    if (c.other < 0) {
        const FeatureMotion around = c.feature.motion_at(a.x, a.v);
        m.n = around.normal;
        m.n_rate = around.normal_rate;
        m.gap = around.gap;
        m.across_speed = around.turning_speed;
    } else {
        const ContactState& b = state[static_cast<std::size_t>(c.other)];
        const Vec3 q = a.x - b.x;
        v -= b.v;
        m.across_speed = v;
        m.turn_speed += system.balls[static_cast<std::size_t>(c.other)].radius * b.w;
        const double distance = q.norm();
        m.gap = distance - c.feature.distance;
        m.n = q / distance;
        m.n_rate = (m.across_speed - m.n.dot(m.across_speed) * m.n) / distance;
    }
    m.speed = m.n.dot(v);
    m.slip = v - m.speed * m.n - m.turn_speed.cross(m.n);
    return m;
}

}  // namespace

ContactMotions contact_motions(const CoupledContacts& system, const CoupledState& state) {
    ContactMotions at;
    for (std::size_t b = 0; b < system.ball_count; ++b) {
        const CoupledBall& ball = system.balls[b];
        at.pull[b] = system.pull(b);
        if (ball.air != nullptr) at.pull[b] += ball.air->acceleration(state[b].v, state[b].w);
    }
    for (std::size_t i = 0; i < system.contact_count; ++i)
        at[i] = contact_motion(system, system.contacts[i], state);
    return at;
}

ForceEquations::ForceEquations(const CoupledContacts& system, const ContactMotions& at, Rows rows,
                               Sliding sliding)
    : system_(system) {
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& c = system.contacts[i];
        if (!c.presses) continue;
        const Vec3& n = at[i].n;
        Vec3 force = n;
        if (sliding == Sliding::kHeldBack && c.mode == ContactMode::kSliding)
            force -= c.friction * at[i].slip.stableNormalized();
        rows_[count_++] = {i, n, n, force, true};
        if (rows == Rows::kNormals || c.mode != ContactMode::kRolling) continue;
        const Vec3 t = n.unitOrthogonal(), u = n.cross(t);
        rows_[count_++] = {i, n, t, t, false};
        rows_[count_++] = {i, n, u, u, false};
    }
}

ForceSizes ForceEquations::solve(const ForceSizes& wanted) const {
    const auto size = static_cast<Eigen::Index>(count_);
    if (size == 0) return ForceSizes(0);
    // Scaled to 1 on the diagonal, so that masses of any ratio leave all digits.
    ForceSizes scale(size);
    for (Eigen::Index i = 0; i < size; ++i) {
        const ForceRow& row = rows_[static_cast<std::size_t>(i)];
        scale[i] = 1 / std::sqrt(effect(static_cast<std::size_t>(i), row, row.along));
    }
    Matrix effects(size, size);
    for (Eigen::Index k = 0; k < size; ++k) {
        const ForceRow& acts = rows_[static_cast<std::size_t>(k)];
        for (Eigen::Index i = 0; i < size; ++i)
            effects(i, k) =
                scale[i] * effect(static_cast<std::size_t>(i), acts, acts.force) * scale[k];
    }
    const ForceSizes target = wanted.cwiseProduct(scale);
    // A heavy ball's forces leave a light one's only few digits: once more for what is missing.
    const auto solved_by = [&](const auto& solver) {
        const ForceSizes once = solver.solve(target);
        return ForceSizes(once + solver.solve(target - effects * once));
    };
    const Eigen::PartialPivLU<Matrix> direct(effects);
    if (direct.matrixLU().diagonal().cwiseAbs().minCoeff() > kPivot)
        return solved_by(direct).cwiseProduct(scale);

    ForceSizes price = ForceSizes::Ones(size);
    for (Eigen::Index i = 0; i < size; ++i)
        if (!rows_[static_cast<std::size_t>(i)].normal) price[i] = kFrictionIsDear;
    effects = effects * price.asDiagonal();
    Eigen::CompleteOrthogonalDecomposition<Matrix> least(size, size);
    least.setThreshold(kRank);
    least.compute(effects);
    return solved_by(least).cwiseProduct(price).cwiseProduct(scale);
}

double ForceEquations::effect(std::size_t i, const ForceRow& acts, const Vec3& force) const {
    const ForceRow& seen = rows_[i];
    const CoupledContact& a = system_.contacts[seen.contact];
    const CoupledContact& b = system_.contacts[acts.contact];
    double sum = 0, straight = 0, turned = 0;
    bool known = false;
    for (const int ball : {a.ball, a.other}) {
        if (ball < 0 || (ball != b.ball && ball != b.other)) continue;
        if (!std::exchange(known, true)) {
            straight = seen.along.dot(force);
            // e . ((n x f) x n'), multiplied out.
            turned = acts.n.dot(seen.n) * straight - acts.n.dot(seen.along) * force.dot(seen.n);
        }
        const CoupledBall& body = system_.balls[static_cast<std::size_t>(ball)];
        const double sign = (ball == a.ball) == (ball == b.ball) ? 1 : -1;
        sum += (sign * straight + turned / body.inertia_factor) / body.mass;
    }
    return sum;
}

void ForceEquations::apply(const ForceRow& acts, const Vec3& force, CoupledChange& change) const {
    const CoupledContact& c = system_.contacts[acts.contact];
    const Vec3 torque = acts.n.cross(force);
    for (const int ball : {c.ball, c.other}) {
        if (ball < 0) continue;
        const auto b = static_cast<std::size_t>(ball);
        const CoupledBall& body = system_.balls[b];
        change.linear[b] += (ball == c.ball ? 1 : -1) / body.mass * force;
        change.spin[b] -= torque / (body.inertia_factor * body.mass * body.radius);
    }
}

void ForceEquations::apply(const ForceSizes& sizes, CoupledChange& change) const {
    for (std::size_t i = 0; i < count_; ++i)
        apply(rows_[i], sizes[static_cast<Eigen::Index>(i)] * rows_[i].force, change);
}

}  // namespace carom
