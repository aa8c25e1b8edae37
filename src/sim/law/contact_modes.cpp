#include "sim/law/contact_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace carom {

namespace {

/// Forces and accelerations are known to this fraction of the weight and of gravity.
constexpr double kModeRounding = 1e-12;

/// An idle contact's gap may open or shut at this fraction of gravity: more than kModeRounding.
constexpr double kIdle = 3e-12;

/// A slip is the difference of speeds, which leaves so much of them.
constexpr double kSlipRounding = 4e-15;

/// Without this contact it would not be pressed: it touches, but bears nothing.
bool bears_nothing(const CoupledContacts& system, const CoupledState& state, std::size_t contact) {
    CoupledContacts without = system;
    without.contacts[contact].presses = false;
    const CoupledForces f = coupled_forces(without, state);
    return f.contacts[contact].departure >= -kModeRounding * system.gravity.norm();
}

}  // namespace

double speed_of(const CoupledContacts& system, const CoupledState& state) {
    double speed = std::sqrt(system.gravity.norm() * system.smallest_radius());
    for (std::size_t b = 0; b < system.ball_count; ++b)
        speed = std::max(speed, state[b].v.norm() + system.balls[b].radius * state[b].w.norm());
    return speed;
}

double idle_margin(const CoupledContacts& system, const CoupledContactForces& forces) {
    return kIdle * system.gravity.norm() - std::abs(forces.departure);
}

bool is_idle(const CoupledContacts& system, const CoupledContactForces& forces) {
    return idle_margin(system, forces) >= 0;
}

double lag_of(const CoupledContactForces& forces, double speed) {
    const double slip = forces.slip.norm();
    if (slip <= 10 * kNoCoupledSlip * speed) return 0;
    const double rounding = kSlipRounding * speed / slip;
    return std::max((forces.slip / slip - forces.direction).norm() - rounding, 0.0);
}

bool begin_slip(CoupledContacts& system, const CoupledState& state, std::size_t contact) {
    system.contacts[contact].mode = ContactMode::kIncipient;
    const CoupledContactForces f = coupled_forces(system, state).contacts[contact];
    return f.slip_rate.dot(f.direction) >= -kLeastDrive * system.gravity.norm() &&
           !f.direction.isZero(0);
}

namespace {

/// The mode of each contact with friction, as far as its slip says it.
void modes_of_slips(CoupledContacts& system, const CoupledState& state) {
    std::array<bool, kMostCoupledContacts> begins{};
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        begins[i] =
            std::exchange(system.contacts[i].mode, ContactMode::kSmooth) == ContactMode::kIncipient;
    }
    const double speed = speed_of(system, state);
    const CoupledForces smooth = coupled_forces(system, state);
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        CoupledContact& c = system.contacts[i];
        if (c.friction == 0) continue;
        c.mode = smooth.contacts[i].slip.norm() > kNoCoupledSlip * speed ? ContactMode::kSliding
                                                                         : ContactMode::kRolling;
    }
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        CoupledContact& c = system.contacts[i];
        if (!begins[i] || c.mode != ContactMode::kSliding) continue;
        c.mode = ContactMode::kIncipient;
        const CoupledContactForces f = coupled_forces(system, state).contacts[i];
        const double drive = f.slip_rate.dot(f.direction);
        if (lag_of(f, speed) > 0.5 * kMostLag || drive <= kLeastDrive * system.gravity.norm())
            c.mode = ContactMode::kSliding;
    }
}

}  // namespace

bool choose_modes(CoupledContacts& system, CoupledState& state) {
    project(system, state);  // what is left of the speeds along normals is part of slips
    modes_of_slips(system, state);
    project(system, state);
    for (std::size_t round = 0; round <= 3 * system.contact_count; ++round) {
        const CoupledForces f = coupled_forces(system, state);
        bool changed = false;
        for (std::size_t i = 0; i < system.contact_count && !changed; ++i) {
            CoupledContact& c = system.contacts[i];
            if (!c.presses) continue;
            if (f.contacts[i].push < lift_off_threshold(system, c, state)) {
                c.presses = false;
                changed = true;
            } else if (c.mode == ContactMode::kRolling &&
                       grip_left(c, f.contacts[i]) < -kModeRounding * system.weight_at(c)) {
                if (bears_nothing(system, state, i))
                    c.presses = false;
                else if (!begin_slip(system, state, i))
                    return false;
                changed = true;
            }
        }
        if (changed) continue;
        for (std::size_t i = 0; i < system.contact_count; ++i)
            if (!system.contacts[i].presses &&
                f.contacts[i].departure < -kModeRounding * system.gravity.norm())
                return false;
        return true;
    }
    return false;
}

}  // namespace carom
