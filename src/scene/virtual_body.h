// The paper's virtual body and the coefficient of restitution that it stands for.
// Source: Khurelbaatar et al., The Graphical Method for Decision of Restitution Coefficient and Its
// Applications (2012), Eq. 6, 7 and 10.
#pragma once

#include "scene/scene.h"

namespace carom {

/// Coefficient against a rigid body: exp(-K x / (2 v)), with x in m, v in m/s, K in 1/s.
double rigid_restitution(const VirtualBody& body, double restitution_constant);

/// The virtual body with x / v = -2 ln e / K at v = 1 m/s. e = 1 gives a distance of exactly 0,
/// e = 0 an infinite one.
VirtualBody virtual_body_for(double restitution, double restitution_constant);

}  // namespace carom
