#include "sim/law/flat_contact.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Slip and gravity along the surface count as parallel up to this sine: their product is made of
/// a few roundings.
constexpr double kParallel = 1e-14;

/// A roll that slows, or a ball that stands still: `motion` has its velocities.
std::optional<FlatMotion> resisted_roll(const FlatContact& contact, const Vec3& g_t,
                                        FlatMotion motion, double still) {
    const Vec3& n = contact.normal;
    const double R = contact.radius, k = contact.inertia_factor;
    const double g_n = -contact.gravity.dot(n);
    const double speed = motion.velocities.linear.norm();
    const bool moves = speed > still;
    // The direction of the roll: that of the motion, or in which gravity would set it going.
    Vec3 along = Vec3::Zero();
    if (moves) {
        along = motion.velocities.linear / speed;
    } else {
        motion.velocities.linear.setZero();
        motion.velocities.spin = motion.velocities.spin.dot(n) * n;
        if (!g_t.isZero(0)) along = g_t.normalized();
    }
    const double pull = g_t.dot(along);
    if ((g_t - pull * along).norm() > kParallel * (g_t.norm() + contact.friction * g_n))
        return std::nullopt;
    const double most = contact.friction * g_n - k / (1 + k) * pull;  // what friction leaves
    const double resistance = std::min(contact.rolling * g_n, most);
    const double rate = pull / (1 + k) - resistance;
    if (!moves && rate <= 0) {
        motion.kind = EventKind::kRest;
        return motion;
    }
    motion.kind = EventKind::kRoll;
    motion.acceleration = rate * along;
    motion.spin_rate = n.cross(motion.acceleration) / R;
    if (rate < 0) motion.seconds = speed / -rate;
    return motion;
}

/// Motion along the surface; spin about the normal goes on as it is.
std::optional<FlatMotion> motion_along(const FlatContact& contact, const Velocities& now,
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
    if (contact.rolling > 0) return resisted_roll(contact, g_t, motion, slip_tolerance);
    motion.acceleration = g_t / (1 + k);
    motion.spin_rate = n.cross(motion.acceleration) / R;
    motion.kind = v.isZero(0) && g_t.isZero(0) ? EventKind::kRest : EventKind::kRoll;
    return motion;
}

/// What pivoting does to the spin about the normal, until that ends.
void slow_pivot(const FlatContact& contact, FlatMotion& motion, double slip_tolerance) {
    const Vec3& n = contact.normal;
    const double R = contact.radius;
    const double g_n = -contact.gravity.dot(n);
    const double spin = motion.velocities.spin.dot(n);
    const double rate = contact.pivoting * g_n / (contact.inertia_factor * R * R);
    // Rounding of the time leaves so much more of it as the rim slows faster than gravity pulls.
    const double faster = contact.pivoting / (contact.inertia_factor * R);
    if (R * std::abs(spin) <= slip_tolerance * (1 + faster)) {
        motion.velocities.spin -= spin * n;
        return;
    }
    motion.spin_rate -= std::copysign(rate, spin) * n;
    motion.seconds = std::min(motion.seconds, std::abs(spin) / rate);
}

}  // namespace

std::optional<FlatMotion> flat_motion(const FlatContact& contact, const Velocities& now,
                                      double slip_tolerance) {
    std::optional<FlatMotion> motion = motion_along(contact, now, slip_tolerance);
    if (motion && contact.pivoting > 0) slow_pivot(contact, *motion, slip_tolerance);
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
