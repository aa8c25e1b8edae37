// Slip across a slope: ds/dt = g_t - mu g_n (1 + 1/k) s/|s|, dv/dt = g_t - mu g_n s/|s|, integrated
// by the classical Runge-Kutta method with steps of 1e-5 s: its own error is below 1e-15.
#pragma once

#include <cmath>

#include "core/types.h"

namespace carom::testing {

struct Slip {
    Vec3 slip, velocity, position;
};

/// `along` is gravity along the plane, `grip` mu g_n, k the ball's I / (m r^2).
inline Slip slip_reference(const Vec3& along, double grip, double k, Slip now, double seconds) {
    const auto rate = [&](const Slip& s) {
        const Vec3 friction = -grip * s.slip.normalized();
        return Slip{along + (1 + 1 / k) * friction, along + friction, s.velocity};
    };
    const auto ahead = [](const Slip& s, const Slip& d, double h) {
        return Slip{s.slip + h * d.slip, s.velocity + h * d.velocity, s.position + h * d.position};
    };
    const int steps = static_cast<int>(std::lround(seconds / 1e-5));
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i) {
        const Slip a = rate(now), b = rate(ahead(now, a, h / 2)), c = rate(ahead(now, b, h / 2)),
                   d = rate(ahead(now, c, h));
        now = ahead(ahead(ahead(ahead(now, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    }
    return now;
}

}  // namespace carom::testing
