#include "sim/solve/ode_bodies.h"

namespace carom {

void OdeBodies::place(dWorldID world, const std::vector<ImpactBody>& bodies) {
    while (bodies_.size() < bodies.size()) {
        bodies_.push_back({dBodyCreate(world), 0, 0});
        dBodySetGyroscopicMode(bodies_.back().id, 0);  // a ball's inertia has no direction
    }
    const Vec3 origin = bodies.front().position;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        Body& body = bodies_[i];
        if (i >= bodies.size()) {
            dBodyDisable(body.id);
            continue;
        }
        const ImpactBody& b = bodies[i];
        if (b.mass != body.mass || b.inertia != body.inertia) {
            dMass mass;
            dMassSetParameters(&mass, b.mass, 0, 0, 0, b.inertia, b.inertia, b.inertia, 0, 0, 0);
            dBodySetMass(body.id, &mass);
            body.mass = b.mass;
            body.inertia = b.inertia;
        }
        dBodyEnable(body.id);
        // ODE turns a ball's inertia with it, which rounds: an earlier step must leave no trace.
        dMatrix3 upright;
        dRSetIdentity(upright);
        dBodySetRotation(body.id, upright);
        if (!b.air.isZero(0)) {
            const Vec3 force = b.mass * b.air;
            dBodyAddForce(body.id, force.x(), force.y(), force.z());
        }
        set_motion(body.id, b.position - origin, b.velocities.linear, b.velocities.spin);
    }
}

void OdeBodies::read(std::vector<ImpactBody>& bodies) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i].velocities.linear = from_ode(dBodyGetLinearVel(bodies_[i].id));
        bodies[i].velocities.spin = from_ode(dBodyGetAngularVel(bodies_[i].id));
    }
}

void OdeBodies::keep(std::size_t count) {
    while (bodies_.size() > count) {
        dBodyDestroy(bodies_.back().id);
        bodies_.pop_back();
    }
}

}  // namespace carom
