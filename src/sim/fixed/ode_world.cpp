#include "sim/fixed/ode_world.h"

#include "sim/fixed/surface_geom.h"
#include "sim/solve/ode_messages.h"

namespace carom {

namespace {

/// From here on a sweep over sorted bounds beats testing all pairs.
constexpr std::size_t kManyBalls = 12;

void set_pose(dGeomID geom, const Vec3& position, const Quat& orientation) {
    dGeomSetPosition(geom, position.x(), position.y(), position.z());
    const dQuaternion q = {orientation.w(), orientation.x(), orientation.y(), orientation.z()};
    dGeomSetQuaternion(geom, q);
}

dGeomID make_geom(dSpaceID space, const PlaneShape& plane) {
    return dCreatePlane(space, plane.normal.x(), plane.normal.y(), plane.normal.z(),
                        plane.offset_m);
}

dGeomID make_geom(dSpaceID space, const BoxShape& box) {
    dGeomID geom = dCreateBox(space, box.size.x(), box.size.y(), box.size.z());
    set_pose(geom, box.center, box.orientation);
    return geom;
}

dGeomID make_geom(dSpaceID space, const SphereShape& sphere) {
    dGeomID geom = dCreateSphere(space, sphere.radius);
    set_pose(geom, sphere.center, Quat::Identity());
    return geom;
}

/// ODE's capsule lies along its own z axis; `length` is that of the cylinder between the caps.
dGeomID make_geom(dSpaceID space, const CapsuleShape& capsule) {
    const Vec3 axis = capsule.to - capsule.from;
    dGeomID geom = dCreateCapsule(space, capsule.radius, axis.norm());
    const Quat turn = axis.isZero(0) ? Quat::Identity() : Quat::FromTwoVectors(Vec3::UnitZ(), axis);
    set_pose(geom, 0.5 * (capsule.from + capsule.to), turn);
    return geom;
}

dGeomID make_geom(dSpaceID space, const CylinderShape& cylinder) {
    return make_surface_geom(space, cylinder);
}

dGeomID make_geom(dSpaceID space, const RingShape& ring) { return make_surface_geom(space, ring); }

dGeomID make_geom(dSpaceID space, const BowlShape& bowl) { return make_surface_geom(space, bowl); }
dGeomID make_geom(dSpaceID space, const PipeShape& pipe) { return make_surface_geom(space, pipe); }

OdeSpacePtr make_ball_space(std::size_t balls) {
    if (balls < kManyBalls) return OdeSpacePtr(dSimpleSpaceCreate(nullptr));
    return OdeSpacePtr(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
}

}  // namespace

OdeWorld::OdeWorld(const Scene& scene) {
    start_ode();
    world_.reset(dWorldCreate());
    ball_space_ = make_ball_space(scene.balls.size());
    surface_space_.reset(dSimpleSpaceCreate(nullptr));
    contacts_.reset(dJointGroupCreate(0));

    const Vec3& g = scene.simulation.gravity;
    dWorldSetGravity(world(), g.x(), g.y(), g.z());
    dWorldSetCFM(world(), 0);              // the default leaks 4 m CFM / dt of the speed per bounce
    dWorldSetAutoDisableFlag(world(), 0);  // a disabled ball would not feel what happens next

    tags_.reserve(scene.balls.size() + scene.surfaces.size());
    for (std::size_t i = 0; i < scene.balls.size(); ++i) add_ball(scene, static_cast<int>(i));
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) add_surface(scene, static_cast<int>(i));
}

void OdeWorld::add_ball(const Scene& scene, int index) {
    const Ball& ball = scene.balls[static_cast<std::size_t>(index)];
    dBodyID body = dBodyCreate(world());
    bodies_.push_back(body);
    const double inertia = ball.inertia_factor * ball.mass * ball.radius * ball.radius;
    dMass mass;
    dMassSetParameters(&mass, ball.mass, 0, 0, 0, inertia, inertia, inertia, 0, 0, 0);
    dBodySetMass(body, &mass);
    // I is the same about every axis: the gyroscopic torque w x I w is 0, so it need not be solved.
    dBodySetGyroscopicMode(body, 0);
    dBodySetPosition(body, ball.position.x(), ball.position.y(), ball.position.z());
    dBodySetLinearVel(body, ball.velocity.x(), ball.velocity.y(), ball.velocity.z());
    dBodySetAngularVel(body, ball.spin.x(), ball.spin.y(), ball.spin.z());

    dGeomID geom = dCreateSphere(ball_space_.get(), ball.radius * (1 + kTouch));
    dGeomSetBody(geom, body);
    tag(geom, scene, ball.material, {false, index}, ball.radius);
}

void OdeWorld::add_surface(const Scene& scene, int index) {
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(index)];
    dGeomID geom = std::visit([this](const auto& s) { return make_geom(surface_space_.get(), s); },
                              surface.shape);
    tag(geom, scene, surface.material, {true, index}, 0);
}

void OdeWorld::tag(dGeomID geom, const Scene& scene, int material, const Partner& self,
                   double radius) {
    const Material& of = scene.materials.at(static_cast<std::size_t>(material));
    tags_.push_back({self, of.virtual_body, material, radius});
    dGeomSetData(geom, &tags_.back());
}

void OdeWorld::collide(void* data, dNearCallback* near) {
    // A space and a geom, not two spaces: then ODE tests bounds once and goes no deeper.
    for (int i = 0; i < dSpaceGetNumGeoms(surface_space_.get()); ++i)
        dSpaceCollide2(reinterpret_cast<dGeomID>(ball_space_.get()),
                       dSpaceGetGeom(surface_space_.get(), i), data, near);
    if (bodies_.size() > 1) dSpaceCollide(ball_space_.get(), data, near);
}

dJointID OdeWorld::add_contact(const dContact& contact, int ball, const Partner& other) {
    dJointID joint = dJointCreateContact(world(), contacts_.get(), &contact);
    dJointAttach(joint, body(ball), other.is_surface ? nullptr : body(other.index));
    return joint;
}

void OdeWorld::accelerate(int ball, const Vec3& linear, const Vec3& spin) {
    dMass mass;
    dBodyGetMass(body(ball), &mass);
    const Vec3 force = mass.mass * linear, torque = mass.I[0] * spin;  // a ball's has no direction
    dBodyAddForce(body(ball), force.x(), force.y(), force.z());
    dBodyAddTorque(body(ball), torque.x(), torque.y(), torque.z());
}

void OdeWorld::set_velocities(int ball, const Vec3& linear, const Vec3& spin) {
    dBodySetLinearVel(body(ball), linear.x(), linear.y(), linear.z());
    dBodySetAngularVel(body(ball), spin.x(), spin.y(), spin.z());
}

void OdeWorld::step(double seconds, int iterations) {
    if (iterations > 0) dWorldSetQuickStepNumIterations(world(), iterations);
    const int ok =
        iterations > 0 ? dWorldQuickStep(world(), seconds) : dWorldStep(world(), seconds);
    if (ok == 0) throw OdeFatal("no memory for the step");
}

}  // namespace carom
