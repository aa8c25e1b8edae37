// To which feature of a body a ball's centre belongs, axis by axis: before, within or beyond its
// extent.
#pragma once

#include <cmath>

namespace carom {

/// A centre along one axis of a body, from the middle of its extent: place [m], velocity [m/s] and
/// what pulls it [m/s^2].
struct AxisMotion {
    double place = 0;
    double rate = 0;
    double pull = 0;
};

/// A place this close to a border of two features, as a fraction of the ball's radius and the
/// place, is on the border: some thousand roundings.
inline constexpr double kBorder = 1e-12;

/// A velocity with no more than this part across a border has none: rounding of its direction.
inline constexpr double kAlongBorder = 1e-12;

/// -1 before, 0 within, 1 beyond the extent from -half to half [m]. On a border, `border` [m] wide
/// to both sides, the feature is the one that the motion leads to: the velocity decides where it
/// has a part of `speed` [m/s] across, else what pulls.
inline int side_of(const AxisMotion& m, double half, double border, double speed) {
    const int sign = m.place < 0 ? -1 : 1;
    const double out = sign * m.place - half;
    if (out > border) return sign;
    if (out <= -border) return 0;
    const bool moves = std::abs(m.rate) > kAlongBorder * speed;
    return sign * (moves ? m.rate : m.pull) > 0 ? sign : 0;
}

/// Whether a motion leads beyond a border that is at `place` 0. On it, `border` [m] wide to both
/// sides, what side_of() says counts.
inline bool leads_beyond(const AxisMotion& m, double border, double speed) {
    if (std::abs(m.place) > border) return m.place > 0;
    return (std::abs(m.rate) > kAlongBorder * speed ? m.rate : m.pull) > 0;
}

}  // namespace carom
