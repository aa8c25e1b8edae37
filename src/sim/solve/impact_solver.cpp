#include "sim/solve/impact_solver.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "core/failure.h"
#include "sim/contact/contact_laws.h"
#include "sim/solve/contact_joint.h"
#include "sim/solve/contact_rows.h"
#include "sim/solve/contact_sweeps.h"
#include "sim/solve/coulomb_impact.h"
#include "sim/solve/ode_bodies.h"
#include "sim/solve/ode_handles.h"
#include "sim/solve/ode_messages.h"

namespace carom {

namespace {

/// With gravity off and no correction, the length of the step cancels out; a power of two cancels
/// without rounding.
constexpr double kStep = 1.0;

/// Bodies that ODE's world keeps between impacts: every step looks at all of them.
constexpr std::size_t kBodiesKept = 4;

/// Above this many contacts at once the direct solver's cubic cost is too much.
constexpr std::size_t kMostForOde = 100;

/// What ODE leaves of Newton's law and of the energy where it fails without saying so, relative;
/// where it succeeds, these are roundings.
constexpr double kWrong = 1e-11;

/// What the velocities lose of relative speeds by their own rounding, relative to the largest.
constexpr double kImpactSpeedRounding = 64 * std::numeric_limits<double>::epsilon();

Velocities other_velocities(const SolverContact& c, const std::vector<ImpactBody>& bodies) {
    return c.on_surface() ? Velocities{}
                          : bodies[static_cast<std::size_t>(c.other_body)].velocities;
}

bool springs_back(const SolverContact& c) { return tangential_restitution(c) != 0; }

double energy(const std::vector<ImpactBody>& bodies) {
    double sum = 0;
    for (const ImpactBody& b : bodies)
        sum += b.mass * b.velocities.linear.squaredNorm() +
               b.inertia * b.velocities.spin.squaredNorm();
    return 0.5 * sum;
}

/// Whether all contacts separate as Newton's law says, and no energy came from nothing.
bool is_solved(const std::vector<ImpactBody>& before, const std::vector<ImpactBody>& after,
               const std::vector<SolverContact>& contacts) {
    double largest = 0;
    for (const SolverContact& c : contacts) largest = std::max(largest, c.approach_speed);
    const double wrong = std::max(kWrong * largest,
                                  kImpactSpeedRounding * std::max(fastest_centre(before), largest));
    for (const SolverContact& c : contacts) {
        const Vec3 relative = relative_velocity(
            c, after[static_cast<std::size_t>(c.body)].velocities, other_velocities(c, after));
        const double wanted = c.restitution * std::max(c.approach_speed, 0.0);
        if (!(relative.dot(c.normal) >= wanted - wrong)) return false;
    }
    return energy(after) <= energy(before) * (1 + kWrong);
}

}  // namespace

struct ImpactSolver::World {
    OdeWorldPtr world;
    OdeJointGroupPtr contacts;
    OdeBodies bodies;
    std::vector<dJointFeedback> feedback;
    std::vector<Vec3> impulses;  ///< per contact, on its ball, N s
};

ImpactSolver::ImpactSolver(SingleContacts single)
    : single_(single), world_(std::make_unique<World>()) {
    start_ode();
    world_->world.reset(dWorldCreate());
    world_->contacts.reset(dJointGroupCreate(0));
    dWorldSetGravity(world_->world.get(), 0, 0, 0);
    dWorldSetERP(world_->world.get(), 0);
    dWorldSetCFM(world_->world.get(), 0);
    dWorldSetAutoDisableFlag(world_->world.get(), 0);
}

ImpactSolver::~ImpactSolver() = default;

void ImpactSolver::add_joint(const SolverContact& contact, std::size_t index) {
    const dBodyID ball = world_->bodies.at(contact.body);
    const Vec3 center = from_ode(dBodyGetPosition(ball));
    dContact joint = contact_joint(contact, center, contact.slip);
    let_bounce(joint, contact.restitution);
    const dJointID id = dJointCreateContact(world_->world.get(), world_->contacts.get(), &joint);
    const dBodyID other = contact.on_surface() ? nullptr : world_->bodies.at(contact.other_body);
    dJointAttach(id, ball, other);
    dJointSetFeedback(id, &world_->feedback[index]);
}

bool ImpactSolver::solve_with_ode(std::vector<ImpactBody>& bodies,
                                  std::vector<SolverContact>& contacts, double time) {
    world_->bodies.place(world_->world.get(), bodies);
    world_->feedback.resize(contacts.size());
    world_->impulses.resize(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) add_joint(contacts[i], i);
    OdeMessages messages;
    dWorldStep(world_->world.get(), kStep);
    world_->bodies.read(bodies);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        SolverContact& c = contacts[i];
        const Vec3 impulse = kStep * from_ode(world_->feedback[i].f1);
        world_->impulses[i] = impulse;
        c.impulse = std::max(impulse.dot(c.normal), 0.0);
        c.tangential_impulse = tangential_part(impulse, c.normal).norm();
    }
    dJointGroupEmpty(world_->contacts.get());
    world_->bodies.keep(kBodiesKept);
    if (!messages.empty() && contacts.size() == 1)
        throw Failure(FailureKind::kRun,
                      fmt::format("ODE at {} s, solving an impact: {}", time, messages.text()));
    return messages.empty();
}

void ImpactSolver::solve_single(std::vector<ImpactBody>& bodies, SolverContact& c) const {
    if (!(c.friction > 0)) {  // spin takes no part
        const double change = std::max((1 + c.restitution) * c.approach_speed, 0.0);
        ImpactBody& ball = bodies[static_cast<std::size_t>(c.body)];
        double share = 1;
        if (!c.on_surface()) {
            ImpactBody& other = bodies[static_cast<std::size_t>(c.other_body)];
            const double both = ball.mass + other.mass;
            share = other.mass / both;
            other.velocities.linear -= ball.mass / both * change * c.normal;
        }
        ball.velocities.linear += share * change * c.normal;
        c.impulse = share * change * ball.mass;
        c.tangential_impulse = 0;
        return;
    }
    ContactRow row(bodies, c, c.restitution * std::max(c.approach_speed, 0.0));
    if (const double b = tangential_restitution(c); b != 0) row.slip_target = -b * c.slip;
    row.relax();
    c.impulse = row.normal;
    c.tangential_impulse = row.tangential.norm();
}

void ImpactSolver::solve_many(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts,
                              double time) {
    before_ = bodies;
    const bool several = contacts.size() > 1, many = contacts.size() > kMostForOde;
    const bool friction =
        several && std::any_of(contacts.begin(), contacts.end(),
                               [](const SolverContact& c) { return c.friction > 0; });
    // ODE knows of no tangential restitution.
    const bool springs = friction && std::any_of(contacts.begin(), contacts.end(), springs_back);
    if (!many && !springs && solve_with_ode(bodies, contacts, time) &&
        (!several || is_solved(before_, bodies, contacts)) &&
        (!friction || obeys_friction(before_, contacts, world_->impulses)))
        return;
    bodies = before_;
    if (friction && !many && solve_with_friction(bodies, contacts)) return;
    solve_by_gauss_seidel(bodies, contacts);
    ++sweeps_;
}

void ImpactSolver::solve(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts,
                         double time) {
    for (SolverContact& c : contacts) {
        const Vec3 relative = relative_velocity(
            c, bodies[static_cast<std::size_t>(c.body)].velocities, other_velocities(c, bodies));
        c.approach_speed = -relative.dot(c.normal);
        c.slip = tangential_part(relative, c.normal);
        find_restitution(c);
    }
    if (contacts.size() == 1 && single_ == SingleContacts::kClosedForm)
        solve_single(bodies, contacts.front());
    else
        solve_many(bodies, contacts, time);
    for (SolverContact& c : contacts) {
        const Vec3 relative = relative_velocity(
            c, bodies[static_cast<std::size_t>(c.body)].velocities, other_velocities(c, bodies));
        c.separation_speed = relative.dot(c.normal);
        c.slip_after = tangential_part(relative, c.normal);
    }
}

}  // namespace carom
