// Owners of ODE's handles, and its numbers as ours and back.
// Only .cpp files and headers inside src/sim include this header: it names ODE's types.
#pragma once

#include <ode/ode.h>

#include <memory>

#include "core/types.h"

namespace carom {

static_assert(sizeof(dReal) == sizeof(double), "ODE's headers are set up for single precision");

struct OdeFree {
    void operator()(dxWorld* p) const { dWorldDestroy(p); }
    void operator()(dxSpace* p) const { dSpaceDestroy(p); }
    void operator()(dxJointGroup* p) const { dJointGroupDestroy(p); }
};
using OdeWorldPtr = std::unique_ptr<dxWorld, OdeFree>;
using OdeSpacePtr = std::unique_ptr<dxSpace, OdeFree>;  ///< also destroys the geoms in it
using OdeJointGroupPtr = std::unique_ptr<dxJointGroup, OdeFree>;

/// Starts ODE once for the process and makes it ready for the calling thread.
/// Throws Failure(kRun) if the library was built for single precision.
void start_ode();

inline Vec3 from_ode(const dReal* v) { return {v[0], v[1], v[2]}; }
inline void to_ode(const Vec3& from, dReal* to) {
    to[0] = from.x();
    to[1] = from.y();
    to[2] = from.z();
    to[3] = 0;
}

/// Place [m], velocity [m/s] and spin [rad/s, world axes] of a body.
inline void set_motion(dBodyID body, const Vec3& position, const Vec3& velocity, const Vec3& spin) {
    dBodySetPosition(body, position.x(), position.y(), position.z());
    dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
}

}  // namespace carom
