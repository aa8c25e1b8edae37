#include "sim/law/single_contact.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Part of gravity that tells a lift-off from rounding, for places no larger than their distances.
constexpr double kLeastSinglePush = 4e-15;

/// What pivoting can do to the spin about the normal, rad/s^2.
double largest_pivot_rate(const SingleContact& c, const SingleContactForces& forces) {
    return c.pivoting * std::max(forces.push, 0.0) / (c.inertia_factor * c.radius * c.radius);
}

/// What it does.
double pivot_rate(const SingleContact& c, const SingleContactForces& forces,
                  const ContactState& state) {
    if (c.pivots == 0) return -state.w.dot(forces.normal_rate);
    return -c.pivots * largest_pivot_rate(c, forces);
}

}  // namespace

SingleContact single_contact(const SurfaceShape& shape, const Vec3& x, const Vec3& v, double radius,
                             const Vec3& gravity) {
    SingleContact c;
    static_cast<Feature&>(c) = feature_at(shape, {x, v, gravity}, radius);
    c.radius = radius;
    c.gravity = gravity;
    return c;
}

SingleContactForces single_contact_forces(const SingleContact& c, ContactMode mode,
                                          const ContactState& state) {
    SingleContactForces r;
    const FeatureMotion motion = c.motion_at(state.x, state.v);
    r.normal = motion.normal;
    r.normal_rate = motion.normal_rate;
    const Vec3& n = r.normal;
    const Vec3 gravity = c.pull(state);
    const double g_n = -gravity.dot(n);
    r.push = g_n - state.v.dot(r.normal_rate);
    r.acceleration = gravity + r.push * n;
    if (c.pivoting > 0) r.spin_rate = pivot_rate(c, r, state) * n;
    if (mode == ContactMode::kSmooth) return r;

    const double R = c.radius, k = c.inertia_factor;
    const double spin_n = state.w.dot(n);
    r.slip = state.v - n.dot(state.v) * n - R * state.w.cross(n);
    r.drive = gravity + g_n * n - (R * spin_n) * n.cross(r.normal_rate);
    if (mode == ContactMode::kRolling) {
        r.friction = -(k / (1 + k)) * r.drive;
    } else {
        const Vec3& against = mode == ContactMode::kSliding ? r.slip : r.drive;
        const double size = against.norm();
        if (size > 0) r.friction = (-c.friction * r.push / size) * against;
    }
    Vec3 turning = r.friction;  // the force at the rim that would turn the ball as it turns
    if (c.rolling > 0 && mode == ContactMode::kRolling) {
        const Vec3 v = state.v - n.dot(state.v) * n;
        const Vec3 along = (c.roll_begins ? r.drive : v).stableNormalized();
        const Vec3 resistance = rolling_resistance(c, r, along) * along;
        r.friction -= resistance;
        turning = r.friction + (1 + k) * resistance;
    }
    r.acceleration += r.friction;
    const Vec3 turned = n.cross(turning) * (-1 / (k * R));
    r.spin_rate = c.pivoting > 0 ? Vec3(r.spin_rate + turned) : turned;
    return r;
}

double rolling_resistance(const SingleContact& c, const SingleContactForces& forces,
                          const Vec3& along) {
    // |k/(1+k) b + r u| = mu N at the most.
    const Vec3 rest = c.inertia_factor / (1 + c.inertia_factor) * forces.drive;
    const double part = rest.dot(along), grip = c.friction * forces.push;
    const double left = grip * grip - rest.squaredNorm() + part * part;
    const double most = std::sqrt(std::max(left, 0.0)) - part;
    return std::clamp(most, 0.0, c.rolling * std::max(forces.push, 0.0));
}

bool holds_still(const SingleContact& c, const SingleContactForces& forces) {
    if (!(c.rolling > 0)) return false;
    const double pull = forces.drive.norm();
    return pull / (1 + c.inertia_factor) <=
           rolling_resistance(c, forces, forces.drive.stableNormalized());
}

double pivot_hold_left(const SingleContact& c, const SingleContactForces& forces,
                       const ContactState& state) {
    return largest_pivot_rate(c, forces) - std::abs(state.w.dot(forces.normal_rate));
}

int pivot_of(const SingleContact& c, ContactMode mode, ContactState& state, double still) {
    if (!(c.pivoting > 0)) return 0;
    const SingleContactForces forces = single_contact_forces(c, mode, state);
    const double spin = state.w.dot(forces.normal);
    if (std::abs(spin) > still) return spin > 0 ? 1 : -1;
    state.w -= spin * forces.normal;
    if (pivot_hold_left(c, forces, state) >= 0) return 0;
    return state.w.dot(forces.normal_rate) > 0 ? 1 : -1;
}

double lift_off_threshold(const SingleContact& c, const Vec3& x) {
    const double size = 1 + (x.cwiseAbs().maxCoeff() + c.origin.cwiseAbs().maxCoeff()) / c.distance;
    return -kLeastSinglePush * size * c.gravity.norm();
}

double grip_left(const SingleContact& c, const SingleContactForces& forces) {
    const double k = c.inertia_factor;
    return c.friction * forces.push - k / (1 + k) * forces.drive.norm();
}

void end_slip(const SingleContact& c, ContactState& state) {
    const double k = c.inertia_factor;
    const Vec3 n = c.normal_at(state.x);
    const Vec3 slip = state.v - n.dot(state.v) * n - c.radius * state.w.cross(n);
    // A change of v changes the slip by 1 + 1/k times as much.
    const Vec3 change = -slip / (1 + 1 / k);
    state.v += change;
    state.w -= n.cross(change) / (k * c.radius);
}

double energy_difference(const ContactState& a, const ContactState& b, double radius,
                         double inertia_factor, const Vec3& gravity) {
    const double inertia = inertia_factor * radius * radius;
    return 0.5 * (a.v - b.v).dot(a.v + b.v) + 0.5 * inertia * (a.w - b.w).dot(a.w + b.w) -
           gravity.dot(a.x - b.x);
}

double energy_in_play(const ContactState& s, double radius, double inertia_factor,
                      const Vec3& gravity) {
    const double inertia = inertia_factor * radius * radius;
    return 0.5 * s.v.squaredNorm() + 0.5 * inertia * s.w.squaredNorm() + gravity.norm() * radius;
}

void project(const SingleContact& c, ContactMode mode, ContactState& state) {
    const Vec3 n = c.normal_at(state.x);
    state.x -= c.gap_at(state.x) * n;
    state.v -= n.dot(state.v) * n;
    if (mode == ContactMode::kRolling) state.w = state.w.dot(n) * n + n.cross(state.v) / c.radius;
}

}  // namespace carom
