#include "sim/fixed/surface_geom.h"

#include <memory>

#include "geometry/bounds.h"
#include "geometry/nearest.h"

namespace carom {

namespace {

/// What ODE keeps with such a geom: the shape, on the heap.
struct GeomData {
    SurfaceShape* shape;
};

const SurfaceShape& shape_of(dGeomID geom) {
    return *static_cast<GeomData*>(dGeomGetClassData(geom))->shape;
}

/// ODE asks with the new geom first. The contact's normal points into it, as of all its colliders.
int meet_sphere(dGeomID surface, dGeomID sphere, int, dContactGeom* contact, int) {
    const dReal* at = dGeomGetPosition(sphere);
    const Nearest nearest =
        nearest_on(shape_of(surface), Vec3(at[0], at[1], at[2]), dGeomSphereGetRadius(sphere));
    if (!(nearest.gap < 0)) return 0;
    for (int i = 0; i < 3; ++i) {
        contact->pos[i] = nearest.point[i];
        contact->normal[i] = -nearest.normal[i];
    }
    contact->depth = -nearest.gap;
    contact->g1 = surface;
    contact->g2 = sphere;
    contact->side1 = contact->side2 = -1;
    return 1;
}

dColliderFn* collider_for(int other) { return other == dSphereClass ? &meet_sphere : nullptr; }

void find_bounds(dGeomID geom, dReal aabb[6]) {
    const Box3 box = bounds_of(shape_of(geom));
    for (int i = 0; i < 3; ++i) {
        aabb[2 * i] = box.min()[i];
        aabb[2 * i + 1] = box.max()[i];
    }
}

void forget(dGeomID geom) { delete static_cast<GeomData*>(dGeomGetClassData(geom))->shape; }

/// ODE numbers classes once for the whole program.
int surface_class() {
    static const int kClass = [] {
        dGeomClass made{};
        made.bytes = sizeof(GeomData);
        made.collider = &collider_for;
        made.aabb = &find_bounds;
        made.dtor = &forget;
        return dCreateGeomClass(&made);
    }();
    return kClass;
}

}  // namespace

dGeomID make_surface_geom(dSpaceID space, const SurfaceShape& shape) {
    auto owned = std::make_unique<SurfaceShape>(shape);
    dGeomID geom = dCreateGeom(surface_class());
    static_cast<GeomData*>(dGeomGetClassData(geom))->shape = owned.release();
    dSpaceAdd(space, geom);
    return geom;
}

}  // namespace carom
