// A geom of ODE for shapes that ODE does not have: it meets balls where the nearest point of the
// shape is (geometry/nearest.h).
#pragma once

#include <ode/ode.h>

#include "geometry/shape.h"

namespace carom {

/// `space` owns it. It stays where the shape is, and meets geoms that are spheres.
dGeomID make_surface_geom(dSpaceID space, const SurfaceShape& shape);

}  // namespace carom
