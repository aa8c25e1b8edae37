#include "sim/law/single_contact.h"

#include <cmath>

namespace carom {

namespace {

/// Part of gravity that tells a lift-off from rounding, for places no larger than their distances.
constexpr double kLeastPush = 4e-15;

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
    r.acceleration += r.friction;
    r.spin_rate = n.cross(r.friction) * (-1 / (k * R));
    return r;
}

double lift_off_threshold(const SingleContact& c, const Vec3& x) {
    const double size = 1 + (x.cwiseAbs().maxCoeff() + c.origin.cwiseAbs().maxCoeff()) / c.distance;
    return -kLeastPush * size * c.gravity.norm();
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
