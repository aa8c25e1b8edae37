// The scene as ODE's objects: a world with bodies and geoms in it.
// Only .cpp files and headers inside src/sim include this header: it names ODE's types.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <vector>

#include "core/types.h"
#include "motion/motion.h"
#include "scene/scene.h"
#include "sim/solve/ode_handles.h"

namespace carom {

/// What hangs on each geom: who it is, and its virtual body, as the paper's section 7 has it.
struct GeomTag {
    Partner self;              ///< a ball or a surface
    VirtualBody virtual_body;  ///< x [m] and v [m/s] of its material
    int material = 0;
    double radius = 0;  ///< of a ball, m
};

/// A touching ball counts as touching up to this fraction of its radius: the scene format's rule
/// for what touches. Its geom is that much larger, so that a resting ball, whose height carries
/// rounding errors of 1e-16, does not lose its contact every other step and fall g dt^2.
constexpr double kTouch = 1e-9;

/// The bodies of all balls (at the scene's start) and the geoms of balls and surfaces.
/// World settings are ODE's defaults except: gravity from the scene, CFM 0, no auto-disabling.
class OdeWorld {
  public:
    /// Failure(kRun) with ODE's text if something cannot be made.
    explicit OdeWorld(const Scene& scene);

    /// Calls `near` for each pair of geoms whose bounds overlap: each ball against each surface
    /// and, if there are two balls, ball against ball. Never surface against surface.
    void collide(void* data, dNearCallback* near);

    /// A contact joint of this step. `other` is the second ball, or none for a surface.
    dJointID add_contact(const dContact& contact, int ball, const Partner& other);

    /// Adds to what gravity does to a ball in the next step [m/s^2], and to its spin [rad/s^2].
    void accelerate(int ball, const Vec3& linear, const Vec3& spin);

    /// What a ball goes on with [m/s, rad/s], after a step.
    void set_velocities(int ball, const Vec3& linear, const Vec3& spin);

    /// One step of `seconds` with the joints added since clear_contacts().
    /// `iterations` 0: dWorldStep; otherwise dWorldQuickStep.
    void step(double seconds, int iterations);
    void clear_contacts() { dJointGroupEmpty(contacts_.get()); }

    dWorldID world() { return world_.get(); }
    int ball_count() const { return static_cast<int>(bodies_.size()); }
    Vec3 position(int ball) const { return from_ode(dBodyGetPosition(body(ball))); }
    Vec3 velocity(int ball) const { return from_ode(dBodyGetLinearVel(body(ball))); }
    Vec3 spin(int ball) const { return from_ode(dBodyGetAngularVel(body(ball))); }

  private:
    dBodyID body(int ball) const { return bodies_[static_cast<std::size_t>(ball)]; }
    void add_ball(const Scene& scene, int index);
    void add_surface(const Scene& scene, int index);
    void tag(dGeomID geom, const Scene& scene, int material, const Partner& self, double radius);

    OdeWorldPtr world_;       ///< owns the bodies
    OdeSpacePtr ball_space_;  ///< hashing or sweeping when balls are many
    OdeSpacePtr surface_space_;
    OdeJointGroupPtr contacts_;
    std::vector<dBodyID> bodies_;
    std::vector<GeomTag> tags_;  ///< reserved once: the geoms point into it
};

}  // namespace carom
