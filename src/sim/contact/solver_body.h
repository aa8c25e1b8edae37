// A ball as an impact sees it.
#pragma once

#include "sim/contact/contact.h"

namespace carom {

struct ImpactBody {
    Vec3 position = Vec3::Zero();  ///< m
    Velocities velocities;
    double mass = 1;       ///< kg
    double inertia = 0.4;  ///< kg m^2, about any axis
};

}  // namespace carom
