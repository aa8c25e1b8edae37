#include "plain_ode.h"

#include <array>
#include <vector>

#include "core/check.h"
#include "sim/contact/restitution.h"
#include "sim/fixed/ode_world.h"

namespace carom::bench {

namespace {

class PlainOde : public SteppedWorld {
  public:
    PlainOde(const Scene& scene, double step, OdeStepper stepper);

    void step() override;
    Vec3 position(std::size_t i) const override { return from_ode(dBodyGetPosition(bodies_[i])); }
    Vec3 velocity(std::size_t i) const override { return from_ode(dBodyGetLinearVel(bodies_[i])); }
    Vec3 spin(std::size_t i) const override { return from_ode(dBodyGetAngularVel(bodies_[i])); }

  private:
    void add_ball(const Ball& ball);
    static void near(void* self, dGeomID a, dGeomID b);

    double step_;
    OdeStepper stepper_;
    PairTable pairs_;
    OdeWorldPtr world_;
    OdeSpacePtr space_;
    OdeJointGroupPtr contacts_;
    std::vector<dBodyID> bodies_;
    std::vector<int> materials_;  ///< geoms point into it
};

PlainOde::PlainOde(const Scene& scene, double step, OdeStepper stepper)
    : step_(step), stepper_(stepper), pairs_(scene) {
    start_ode();
    world_.reset(dWorldCreate());
    space_.reset(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
    contacts_.reset(dJointGroupCreate(0));
    const Vec3& g = scene.simulation.gravity;
    dWorldSetGravity(world_.get(), g.x(), g.y(), g.z());
    dWorldSetERP(world_.get(), 0);
    dWorldSetCFM(world_.get(), 0);
    dRandSetSeed(0);  // of QuickStep
    materials_.reserve(scene.balls.size() + scene.surfaces.size());
    for (const Surface& surface : scene.surfaces) {
        const auto* plane = std::get_if<PlaneShape>(&surface.shape);
        CAROM_CHECK(plane, !=, nullptr);
        dGeomID geom = dCreatePlane(space_.get(), plane->normal.x(), plane->normal.y(),
                                    plane->normal.z(), plane->offset_m);
        materials_.push_back(surface.material);
        dGeomSetData(geom, &materials_.back());
    }
    for (const Ball& ball : scene.balls) add_ball(ball);
}

void PlainOde::add_ball(const Ball& ball) {
    dBodyID body = dBodyCreate(world_.get());
    dMass mass;
    const double inertia = ball.inertia_factor * ball.mass * ball.radius * ball.radius;
    dMassSetParameters(&mass, ball.mass, 0, 0, 0, inertia, inertia, inertia, 0, 0, 0);
    dBodySetMass(body, &mass);
    set_motion(body, ball.position, ball.velocity, ball.spin);
    dGeomID geom = dCreateSphere(space_.get(), ball.radius);
    dGeomSetBody(geom, body);
    materials_.push_back(ball.material);
    dGeomSetData(geom, &materials_.back());
    bodies_.push_back(body);
}

void PlainOde::near(void* self, dGeomID a, dGeomID b) {
    auto& ode = *static_cast<PlainOde*>(self);
    dContact contact{};
    if (dCollide(a, b, 1, &contact.geom, sizeof(dContact)) == 0) return;
    const int of_a = *static_cast<int*>(dGeomGetData(a)),
              of_b = *static_cast<int*>(dGeomGetData(b));
    contact.surface.mode = dContactBounce;
    contact.surface.bounce = ode.pairs_.at(of_a, of_b).restitution;
    dJointID joint = dJointCreateContact(ode.world_.get(), ode.contacts_.get(), &contact);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
}

void PlainOde::step() {
    dSpaceCollide(space_.get(), this, near);
    if (stepper_ == OdeStepper::kWorld)
        dWorldStep(world_.get(), step_);
    else
        dWorldQuickStep(world_.get(), step_);
    dJointGroupEmpty(contacts_.get());
}

}  // namespace

std::unique_ptr<SteppedWorld> make_plain_ode(const Scene& scene, double step, OdeStepper stepper) {
    return std::make_unique<PlainOde>(scene, step, stepper);
}

}  // namespace carom::bench
