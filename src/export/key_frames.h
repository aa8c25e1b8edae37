// A ball's path as key frames of glTF, whose times are floats.
#pragma once

#include <vector>

#include "core/types.h"
#include "motion/motion.h"

namespace carom {

/// Position relative to an origin [m], with the velocity [m/s]: a cubic Hermite spline between two
/// keys, which is a parabola exactly.
struct PlaceKey {
    float time = 0;  ///< s
    Vec3 place = Vec3::Zero();
    Vec3 rate = Vec3::Zero();
};

/// Orientation (world from ball) with its time derivative, in the order of Quat::coeffs().
struct TurnKey {
    float time = 0;
    Eigen::Vector4d turn = Eigen::Vector4d(0, 0, 0, 1);
    Eigen::Vector4d rate = Eigen::Vector4d::Zero();
};

/// Two keys for all that goes on smoothly, say from one impact to the next: at its first float and
/// at its last, so that the jump of the impact lies between two neighbouring floats; between them
/// more only where the motion is no cubic to within `tolerance_m`. Times increase strictly. One key
/// for a ball that stays where it is.
std::vector<PlaceKey> place_keys(const Trajectory& ball, double duration_s, const Vec3& origin,
                                 double tolerance_m);

enum class TurnSplines {
    kLinear,  ///< spherical linear between keys: exact for a constant spin
    kCubic,   ///< Hermite splines of the coefficients, then normalized
};

/// The same for the orientation, within `tolerance` [rad]; neighbours are less than half a turn
/// apart, and their signs are such that they lie on one half of the sphere. One key for a ball that
/// does not turn.
std::vector<TurnKey> turn_keys(const Trajectory& ball, double duration_s, TurnSplines splines,
                               double tolerance);

}  // namespace carom
