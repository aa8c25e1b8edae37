#include "sim/law/coupled_forces.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/law/contact_modes.h"
#include "sim/law/coupled_equations.h"
#include "sim/law/slip_onset.h"

namespace carom {

namespace {

using Rows = ForceEquations::Rows;
using Sliding = ForceEquations::Sliding;

/// As lift_off_threshold() of one ball; a system of equations leaves more rounding.
constexpr double kLeastPush = 1e-13;

/// Over so much of the time that gravity takes over a radius, both ways, the turning of a direction
/// is found: to 1e-9 of it by curvature, and to 1e-8 by rounding.
constexpr double kTurningTime = 1e-5;

/// A turn that bends by more than this fraction in that time is rounding, or that of directions
/// which the motion leaves undetermined: it counts as none.
constexpr double kSmoothTurn = 0.01;

/// Rounds of putting places right; each squares what is left.
constexpr int kPlaceRounds = 3;

/// What the equations have to bring about: gaps that stay shut, slips that stay 0.
double wanted_by(const CoupledContacts& system, const ForceRow& row, const ContactMotions& at) {
    const CoupledContact& c = system.contacts[row.contact];
    const ContactMotion& m = at[row.contact];
    Vec3 apart = at.pull[static_cast<std::size_t>(c.ball)];
    if (c.other >= 0) apart -= at.pull[static_cast<std::size_t>(c.other)];
    const double pull = row.along.dot(apart);
    return row.normal ? -m.across_speed.dot(m.n_rate) - pull
                      : row.along.dot(m.turn_speed.cross(m.n_rate)) - pull;
}

/// The rates of gap and slip at each contact, from what happens to the balls.
void fill_rates(const CoupledContacts& system, const ContactMotions& at, CoupledForces& r) {
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& contact = system.contacts[i];
        CoupledContactForces& c = r.contacts[i];
        c.normal = at[i].n;
        c.normal_rate = at[i].n_rate;
        c.slip = at[i].slip;
        c.speed = at[i].speed;
        Vec3 a = Vec3::Zero(), turning = Vec3::Zero();
        for (const int ball : {contact.ball, contact.other}) {
            if (ball < 0) continue;
            const auto b = static_cast<std::size_t>(ball);
            a += (ball == contact.ball ? 1 : -1) * r.acceleration[b];
            turning += system.balls[b].radius * r.spin_rate[b];
        }
        c.departure = c.normal.dot(a) + at[i].across_speed.dot(c.normal_rate);
        c.slip_rate = a - turning.cross(c.normal) - at[i].turn_speed.cross(c.normal_rate);
    }
}

/// All forces, where those of friction at incipient slips are given: `held` [N].
CoupledForces forces_with(const CoupledContacts& system, const ContactMotions& at,
                          std::span<const ForceRow> held) {
    const ForceEquations equations(system, at, Rows::kNormalsAndSlips, Sliding::kHeldBack);
    ForceSizes wanted(static_cast<Eigen::Index>(equations.count()));
    for (std::size_t i = 0; i < equations.count(); ++i) {
        const ForceRow& row = equations.row(i);
        double& rate = wanted[static_cast<Eigen::Index>(i)];
        rate = wanted_by(system, row, at);
        for (const ForceRow& h : held) rate -= equations.effect(i, h, h.force);
    }
    const ForceSizes sizes = equations.solve(wanted);

    CoupledChange change;
    for (std::size_t b = 0; b < system.ball_count; ++b) change.linear[b] = at.pull[b];
    equations.apply(sizes, change);
    CoupledForces r;
    for (const ForceRow& h : held) {
        equations.apply(h, h.force, change);
        r.contacts[h.contact].friction = h.force;
    }
    r.acceleration = change.linear;
    r.spin_rate = change.spin;
    for (std::size_t i = 0; i < equations.count(); ++i) {
        const ForceRow& row = equations.row(i);
        CoupledContactForces& c = r.contacts[row.contact];
        const Vec3 force = sizes[static_cast<Eigen::Index>(i)] * row.force;
        c.push += force.dot(row.n);
        c.friction += force - force.dot(row.n) * row.n;
    }
    fill_rates(system, at, r);
    return r;
}

using Turning = std::array<Vec3, kMostCoupledContacts>;

/// The forces where slips begin, whose directions turn as `turning` says [1/s].
CoupledForces forces_of_starts(const CoupledContacts& system, const ContactMotions& at,
                               SlipOnset starts, const Turning& turning) {
    // What happens at the slips that begin is linear in the forces that hold them back.
    for (std::size_t i = 0; i <= 2 * starts.count(); ++i)
        starts.take(i, forces_with(system, at, starts.probe(i)));
    starts.set_turning(at, turning);
    CoupledForces r = forces_with(system, at, starts.friction());
    starts.fill_directions(r);
    return r;
}

/// The directions of slips that begin, `seconds` away, if these do not turn.
Turning directions_at(const CoupledContacts& system, const CoupledState& state,
                      const CoupledForces& f, double seconds) {
    CoupledState there = state;
    for (std::size_t b = 0; b < system.ball_count; ++b) {
        there[b].x += seconds * (state[b].v + 0.5 * seconds * f.acceleration[b]);
        there[b].v += seconds * f.acceleration[b];
        there[b].w += seconds * f.spin_rate[b];
    }
    const ContactMotions at = contact_motions(system, there);
    Turning still;
    still.fill(Vec3::Zero());
    const CoupledForces forces = forces_of_starts(system, at, SlipOnset(system, at), still);
    Turning directions;
    for (std::size_t i = 0; i < system.contact_count; ++i)
        directions[i] = forces.contacts[i].direction;
    return directions;
}

}  // namespace

CoupledForces coupled_forces(const CoupledContacts& system, const CoupledState& state) {
    const ContactMotions at = contact_motions(system, state);
    const SlipOnset starts(system, at);
    if (starts.count() == 0) return forces_with(system, at, {});
    Turning turning;
    turning.fill(Vec3::Zero());
    const CoupledForces still = forces_of_starts(system, at, starts, turning);
    // To first order a direction turns as it would if it did not lag.
    const double seconds =
        kTurningTime * std::sqrt(system.smallest_radius() / system.gravity.norm());
    const Turning after = directions_at(system, state, still, seconds);
    const Turning before = directions_at(system, state, still, -seconds);
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const Vec3 turn = after[i] - before[i];
        const Vec3 bend = after[i] + before[i] - 2 * still.contacts[i].direction;
        if (bend.norm() < kSmoothTurn * turn.norm()) turning[i] = turn / (2 * seconds);
    }
    return forces_of_starts(system, at, starts, turning);
}

void project(const CoupledContacts& system, CoupledState& state) {
    for (int round = 0; round < kPlaceRounds; ++round) {
        const ContactMotions at = contact_motions(system, state);
        const ForceEquations equations(system, at, Rows::kNormals, Sliding::kSmooth);
        ForceSizes wanted(static_cast<Eigen::Index>(equations.count()));
        for (std::size_t i = 0; i < equations.count(); ++i) {
            const std::size_t contact = equations.row(i).contact;
            wanted[static_cast<Eigen::Index>(i)] = -at[contact].gap;
        }
        CoupledChange change;
        equations.apply(equations.solve(wanted), change);
        for (std::size_t i = 0; i < system.ball_count; ++i) state[i].x += change.linear[i];
    }
    const ContactMotions at = contact_motions(system, state);
    const ForceEquations equations(system, at, Rows::kNormalsAndSlips, Sliding::kSmooth);
    ForceSizes wanted(static_cast<Eigen::Index>(equations.count()));
    for (std::size_t i = 0; i < equations.count(); ++i) {
        const ForceRow& row = equations.row(i);
        const ContactMotion& m = at[row.contact];
        wanted[static_cast<Eigen::Index>(i)] = -row.along.dot(m.slip + m.speed * m.n);
    }
    CoupledChange change;
    equations.apply(equations.solve(wanted), change);
    for (std::size_t i = 0; i < system.ball_count; ++i) {
        state[i].v += change.linear[i];
        state[i].w += change.spin[i];
    }
}

void land(const CoupledContacts& system, const std::array<bool, kMostCoupledContacts>& gives_back,
          CoupledState& state) {
    const ContactMotions at = contact_motions(system, state);
    CoupledContacts sliding = system;
    const double no_slip = kNoCoupledSlip * speed_of(system, state);
    for (std::size_t i = 0; i < sliding.contact_count; ++i) {
        CoupledContact& c = sliding.contacts[i];
        c.mode = gives_back[i] && c.friction > 0 && at[i].slip.norm() > no_slip
                     ? ContactMode::kSliding
                     : ContactMode::kSmooth;
    }
    const ForceEquations equations(sliding, at, Rows::kNormals, Sliding::kHeldBack);
    ForceSizes wanted(static_cast<Eigen::Index>(equations.count()));
    for (std::size_t i = 0; i < equations.count(); ++i)
        wanted[static_cast<Eigen::Index>(i)] = -at[equations.row(i).contact].speed;
    CoupledChange change;
    equations.apply(equations.solve(wanted), change);
    for (std::size_t i = 0; i < system.ball_count; ++i) {
        state[i].v += change.linear[i];
        state[i].w += change.spin[i];
    }
}

double grip_left(const CoupledContact& contact, const CoupledContactForces& forces) {
    return contact.friction * forces.push - forces.friction.norm();
}

double lift_off_threshold(const CoupledContacts& system, const CoupledContact& c,
                          const CoupledState& state) {
    const ContactState& a = state[static_cast<std::size_t>(c.ball)];
    const double size = 1 + a.x.cwiseAbs().maxCoeff() / c.feature.distance;
    return -kLeastPush * size * system.weight_at(c);
}

}  // namespace carom
