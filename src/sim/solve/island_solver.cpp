#include "sim/solve/island_solver.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "sim/solve/contact_joint.h"
#include "sim/solve/contact_sweeps.h"
#include "sim/solve/ode_bodies.h"
#include "sim/solve/ode_handles.h"
#include "sim/solve/ode_messages.h"

namespace carom {

namespace {

/// From here on sweeps are cheaper than ODE's exact solver, whose cost is cubic.
constexpr std::size_t kManyContacts = 24;

/// A contact that needs no force to within this fraction of g h is tied with its target; ODE's
/// exact solver breaks ties by luck only. The target of such a contact is lowered by twice as much.
constexpr double kTie = 1e-6;

/// Speeds that differ by this fraction of the balls' speeds are equal.
constexpr double kIslandSpeedRounding = 1e-13;

Vec3 relative_of(const SolverContact& c, const std::vector<ImpactBody>& bodies) {
    const Velocities other =
        c.on_surface() ? Velocities{} : bodies[static_cast<std::size_t>(c.other_body)].velocities;
    return relative_velocity(c, bodies[static_cast<std::size_t>(c.body)].velocities, other);
}

double largest_speed(const std::vector<ImpactBody>& bodies) {
    double speed = 0;
    for (const ImpactBody& b : bodies) speed = std::max(speed, b.velocities.linear.norm());
    return speed;
}

}  // namespace

struct IslandSolver::World {
    OdeWorldPtr world;
    OdeJointGroupPtr contacts;
    OdeBodies bodies;
    std::vector<dJointFeedback> feedback;
    std::vector<double> target;  ///< per contact: least speed along the normal after the step
    std::vector<Vec3> pushes;    ///< per contact: impulse on its ball, N s
    std::vector<Vec3> axis;      ///< per contact: along its friction, as far as that is known
    std::vector<char> slides;    ///< per contact: it slides all through the step, along its axis
};

IslandSolver::IslandSolver() : world_(std::make_unique<World>()) {
    start_ode();
    world_->world.reset(dWorldCreate());
    world_->contacts.reset(dJointGroupCreate(0));
    dWorldSetERP(world_->world.get(), 0);
    dWorldSetCFM(world_->world.get(), 0);
    dWorldSetAutoDisableFlag(world_->world.get(), 0);
}

IslandSolver::~IslandSolver() = default;

void IslandSolver::add_joint(const SolverContact& contact, std::size_t index) {
    const dBodyID ball = world_->bodies.at(contact.body);
    const Vec3 center = from_ode(dBodyGetPosition(ball));
    dContact joint = contact_joint(contact, center, world_->axis[index]);
    keep_above(joint, world_->target[index]);
    if (!contact.alone) share_island(joint);
    if (world_->slides[index] != 0) resist_first_axis_only(joint);
    const dJointID id = dJointCreateContact(world_->world.get(), world_->contacts.get(), &joint);
    const dBodyID other = contact.on_surface() ? nullptr : world_->bodies.at(contact.other_body);
    dJointAttach(id, ball, other);
    dJointSetFeedback(id, &world_->feedback[index]);
}

/// Where a contact on a surface slides all through the step, friction lies along the slip of the
/// middle of the step, which makes the step second-order exact where the slip turns:
/// s + h/2 (g_t - mu g_n (1 + 1/k) s/|s|). Otherwise along the slip that is left without friction.
void IslandSolver::follow_slip(const SolverContact& c, const ImpactBody& body, const Vec3& fall,
                               std::size_t index) {
    const double k = body.inertia / (body.mass * c.arm.squaredNorm());
    const double speed = c.slip.norm();
    const double slowing = c.friction * std::max(-fall.dot(c.normal), 0.0) * (1 + 1 / k);
    if (!(speed > 2 * (slowing + fall.norm()))) return;
    world_->axis[index] =
        c.slip + 0.5 * (tangential_part(fall, c.normal) - slowing / speed * c.slip);
    world_->slides[index] = 1;
}

/// False if ODE's solver gave up; the bodies are then as they were.
bool IslandSolver::solve_with_ode(std::vector<ImpactBody>& bodies,
                                  const std::vector<SolverContact>& contacts, const Vec3& gravity,
                                  double seconds) {
    dWorldSetGravity(world_->world.get(), gravity.x(), gravity.y(), gravity.z());
    world_->bodies.place(world_->world.get(), bodies);
    for (std::size_t i = 0; i < contacts.size(); ++i) add_joint(contacts[i], i);
    const OdeMessages messages;
    dRandSetSeed(0);  // ODE shuffles rows by random numbers of its own: always the same ones
    dWorldStep(world_->world.get(), seconds);
    dJointGroupEmpty(world_->contacts.get());
    if (!messages.empty()) return false;
    world_->bodies.read(bodies);
    for (std::size_t i = 0; i < contacts.size(); ++i)
        world_->pushes[i] = seconds * from_ode(world_->feedback[i].f1);
    return true;
}

void IslandSolver::step(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts,
                        std::vector<Vec3>& pushes, const Vec3& gravity, double seconds) {
    CAROM_CHECK(pushes.size(), ==, contacts.size());
    world_->feedback.resize(contacts.size());
    world_->pushes.resize(contacts.size());
    world_->target.resize(contacts.size());
    world_->axis.resize(contacts.size());
    world_->slides.resize(contacts.size());
    const double tie =
        kTie * gravity.norm() * seconds + kIslandSpeedRounding * largest_speed(bodies);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        SolverContact& c = contacts[i];
        const Vec3 relative = relative_of(c, bodies);
        const double v_n = relative.dot(c.normal);
        // Two balls fall alike: gravity only matters against a surface.
        Vec3 pull = bodies[static_cast<std::size_t>(c.body)].air;
        if (c.on_surface())
            pull += gravity;
        else
            pull -= bodies[static_cast<std::size_t>(c.other_body)].air;
        const Vec3 fall = seconds * pull;
        c.approach_speed = -v_n;
        c.slip = tangential_part(relative, c.normal);
        c.alone = contacts.size() == 1;
        world_->axis[i] = c.slip + tangential_part(fall, c.normal);
        world_->slides[i] = 0;
        if (c.alone && c.on_surface()) follow_slip(c, bodies.front(), fall, i);
        double& target = world_->target[i];
        // The way of a step is its mean speed's: the gap may close, and no more.
        target = std::min(-v_n - 2 * std::max(-c.depth, 0.0) / seconds, 0.0);
        if (!c.alone && std::abs(v_n + fall.dot(c.normal) - target) <= tie) target -= 2 * tie;
    }
    if (contacts.size() > kManyContacts || !solve_with_ode(bodies, contacts, gravity, seconds)) {
        for (ImpactBody& b : bodies) b.velocities.linear += seconds * (gravity + b.air);
        world_->pushes = pushes;
        solve_island_by_gauss_seidel(bodies, contacts, world_->target, world_->pushes);
    }
    pushes = world_->pushes;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        SolverContact& c = contacts[i];
        const Vec3 relative = relative_of(c, bodies);
        c.separation_speed = relative.dot(c.normal);
        c.slip_after = tangential_part(relative, c.normal);
        c.impulse = std::max(pushes[i].dot(c.normal), 0.0);
        c.tangential_impulse = tangential_part(pushes[i], c.normal).norm();
    }
}

}  // namespace carom
