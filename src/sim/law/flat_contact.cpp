#include "sim/law/flat_contact.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Slip and gravity along the surface count as parallel up to this sine: their product is made of
/// a few roundings.
constexpr double kParallel = 1e-14;

}  // namespace

std::optional<FlatMotion> flat_motion(const FlatContact& contact, const Velocities& now,
                                      double slip_tolerance) {
    const Vec3& n = contact.normal;
    const double g_n = -contact.gravity.dot(n);
    Vec3 g_t = contact.gravity + g_n * n;
    if (g_t.norm() <= kParallel * g_n) g_t.setZero();

    FlatMotion motion;
    motion.velocities = now;
    motion.velocities.linear -= now.linear.dot(n) * n;
    const Vec3& v = motion.velocities.linear;

    if (contact.friction == 0) {
        motion.acceleration = g_t;
        motion.kind = v.isZero(0) && g_t.isZero(0) ? EventKind::kRest : EventKind::kSlide;
        return motion;
    }

    const double R = contact.radius, k = contact.inertia_factor;
    const double grip = contact.friction * g_n;  // largest friction, as an acceleration
    const Vec3 slip = v - R * now.spin.cross(n);
    const double slip_speed = slip.norm();
    const auto slide_along = [&](const Vec3& direction) {
        motion.kind = EventKind::kSlide;
        motion.acceleration = g_t - grip * direction;
        motion.spin_rate = (grip / (k * R)) * n.cross(direction);
    };

    if (slip_speed > slip_tolerance) {
        const Vec3 direction = slip / slip_speed;
        const Vec3 across = g_t - g_t.dot(direction) * direction;
        if (across.norm() > kParallel * (g_t.norm() + grip)) return std::nullopt;
        slide_along(direction);
        const double slowing = grip * (1 + 1 / k) - g_t.dot(direction);
        if (slowing > 0) motion.seconds = slip_speed / slowing;
        return motion;
    }
    // No slip: it rolls if friction can hold it, otherwise it starts to slide down.
    motion.velocities.spin = now.spin.dot(n) * n + n.cross(v) / R;
    if (g_t.norm() > grip * (1 + 1 / k)) {
        slide_along(g_t.normalized());
        return motion;
    }
    motion.acceleration = g_t / (1 + k);
    motion.spin_rate = n.cross(motion.acceleration) / R;
    motion.kind = v.isZero(0) && g_t.isZero(0) ? EventKind::kRest : EventKind::kRoll;
    return motion;
}

Velocities without_bounces(const FlatContact& contact, const Velocities& now, double separation,
                           double slip_tolerance) {
    if (contact.friction == 0 || separation == 0) return now;
    const Vec3& n = contact.normal;
    const double R = contact.radius, k = contact.inertia_factor;
    const Vec3 slip = tangential_part(now.linear, n) - R * now.spin.cross(n);
    const double slip_speed = slip.norm();
    if (!(slip_speed > slip_tolerance)) return now;  // it has gripped, and will at each impact
    // Before an impact: at most as much as stops the slip.
    const double given = std::max(contact.friction * separation, -slip_speed / (1 + 1 / k));
    const Vec3 change = (given / slip_speed) * slip;
    return {now.linear + change, now.spin - n.cross(change) / (k * R)};
}

}  // namespace carom
