// How a turn since the start of a piece, a rotation vector, changes with the spin.
#pragma once

#include "core/types.h"

namespace carom {

/// The rate of a turn u [rad] of q = exp(u) q0 for q' = w q / 2, the inverse of spin_of_turn():
///   u' = w - u x w / 2 + c u x (u x w),  c = (1 - |u|/2 cot(|u|/2)) / |u|^2.
/// Meant for |u| <= 1.
Vec3 turn_rate(const Vec3& u, const Vec3& w);

/// u'' for a spin that changes by b [rad/s^2].
Vec3 turn_second_rate(const Vec3& u, const Vec3& w, const Vec3& b);

}  // namespace carom
