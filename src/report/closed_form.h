// Motions that are known without any solver: what errors are measured against where a scene has
// one.
#pragma once

#include <optional>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// The motion of balls that meet nothing, or each just one plane, without friction: with gap y, its
/// speed v, and gravity g against the plane's normal, impact n comes at
///   t_1 + 2 u/g (e + ... + e^(n-1)),  u = sqrt(v^2 + 2 g y),  t_1 = (v + u) / g,
/// leaves with e^n u, and tops at (e^n u)^2 / 2g. Along the plane gravity alone acts. A series ends
/// when a hop is below 1e-12 of the ball's place; from then on the ball lies on the plane.
/// Computed with 64 bits of mantissa, independently of src/sim, and rounded once.
///
/// `motion` is a simulation of the scene: it only says who meets whom. Empty where a ball meets
/// more than that, where there is air, where friction or a ball's contact at the start is involved,
/// or where gravity pulls away from the plane.
std::optional<Motion> closed_form_motion(const Scene& scene, const Motion& motion);

}  // namespace carom
