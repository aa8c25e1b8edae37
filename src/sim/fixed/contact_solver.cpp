#include "sim/fixed/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/contact/contact_laws.h"
#include "sim/solve/contact_joint.h"

namespace carom {

namespace {

/// Two speeds that should be equal differ by rounding: an approach below this fraction of the
/// balls' speeds is none. It matters where the threshold is 0, without gravity.
constexpr double kStepSpeedRounding = 1e-13;

/// A contact whose speed is this close to its target, relative to the correction speed, counts as
/// tied with it, and its target is lowered by twice as much: 2e-8 m/s at a step of 1 ms.
constexpr double kTie = 1e-6;

Velocities of_other(const Contact& contact, const std::vector<Velocities>& balls) {
    if (contact.other.is_surface) return {};
    return balls[static_cast<std::size_t>(contact.other.index)];
}

double largest_speed(const std::vector<Velocities>& balls) {
    double speed = 0;
    for (const Velocities& ball : balls) speed = std::max(speed, ball.linear.norm());
    return speed;
}

}  // namespace

// ---- ContactIslands
// -------------------------------------------------------------------------------------

int ContactIslands::root(int ball) {
    auto parent = [this](int i) -> int& { return parent_[static_cast<std::size_t>(i)]; };
    while (parent(ball) != ball) ball = parent(ball) = parent(parent(ball));
    return ball;
}

void ContactIslands::mark_lonely(std::vector<Contact>& contacts) {
    if (contacts.size() == 1) {
        contacts.front().alone = true;
        return;
    }
    std::iota(parent_.begin(), parent_.end(), 0);
    std::fill(contacts_.begin(), contacts_.end(), 0);
    for (const Contact& c : contacts)
        if (!c.other.is_surface)
            parent_[static_cast<std::size_t>(root(c.other.index))] = root(c.ball);
    for (const Contact& c : contacts) ++contacts_[static_cast<std::size_t>(root(c.ball))];
    for (Contact& c : contacts) c.alone = contacts_[static_cast<std::size_t>(root(c.ball))] == 1;
}

// ---- ContactSolver
// -------------------------------------------------------------------------------

ContactSolver::ContactSolver(OdeWorld& world, const StepContactRules& rules)
    : world_(world),
      rules_(rules),
      erp_(dWorldGetERP(world.world())),
      islands_(world.ball_count()) {}

void ContactSolver::add_joints(std::vector<Contact>& contacts,
                               const std::vector<Velocities>& before) {
    if (contacts.empty()) return;
    islands_.mark_lonely(contacts);
    tie_speed_ = kTie * rules_.correction_speed + kStepSpeedRounding * largest_speed(before);
    feedback_.resize(contacts.size());  // before any joint points into it
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        prepare(contacts[i], before);
        const dContact contact = joint_of(contacts[i]);
        const dJointID joint = world_.add_contact(contact, contacts[i].ball, contacts[i].other);
        dJointSetFeedback(joint, &feedback_[i]);
    }
}

void ContactSolver::prepare(Contact& contact, const std::vector<Velocities>& before) const {
    const Velocities& ball = before[static_cast<std::size_t>(contact.ball)];
    const Velocities other = of_other(contact, before);
    const Vec3 relative = relative_velocity(contact, ball, other);
    contact.approach_speed = -relative.dot(contact.normal);
    contact.slip = tangential_part(relative, contact.normal);
    const double rounding = kStepSpeedRounding * (ball.linear.norm() + other.linear.norm());
    contact.impact = contact.approach_speed > rules_.impact_threshold + rounding;
    if (contact.impact) find_restitution(contact);
}

/// Along the normal, after a step in which the contact does nothing. Two balls fall alike: gravity
/// only matters against a surface.
double ContactSolver::free_speed(const Contact& contact) const {
    const double fall = contact.other.is_surface ? rules_.gravity.dot(contact.normal) : 0;
    return -contact.approach_speed + rules_.step * fall;
}

/// The least separation speed after the step that a contact without impact must have.
double ContactSolver::target_speed(const Contact& contact) const {
    const double overlap = std::max(contact.depth, 0.0);
    const double target = std::min(erp_ * overlap / rules_.step, rules_.correction_speed);
    if (contact.alone) return target;
    // A contact that already moves at its target speed needs no force, exactly. ODE's solver
    // (Dantzig's method) breaks such ties only by luck, and otherwise gives up with "LCP internal
    // error, s <= 0". A ball at rest beside a wall is one, or one that a wall has pushed away.
    const bool tied = std::abs(free_speed(contact) - target) <= tie_speed_;
    return tied ? target - 2 * tie_speed_ : target;
}

dContact ContactSolver::joint_of(const Contact& contact) const {
    // Two balls fall alike: gravity changes only the slip on a surface.
    Vec3 free_slip = contact.slip;
    if (contact.other.is_surface)
        free_slip += rules_.step * tangential_part(rules_.gravity, contact.normal);
    dContact joint = contact_joint(contact, world_.position(contact.ball), free_slip);
    if (contact.impact) {
        let_bounce(joint, contact.restitution);
        // With others at hand it could give energy.
        if (const double b = tangential_restitution(contact); b != 0 && contact.alone)
            reverse_slip(joint, b, contact.slip);
    } else {
        keep_above(joint, target_speed(contact));
    }
    if (!contact.alone) share_island(joint);
    return joint;
}

void ContactSolver::finish(std::vector<Contact>& contacts, const std::vector<Velocities>& after) {
    if (contacts.empty()) return;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        Contact& contact = contacts[i];
        const Vec3 relative = relative_velocity(
            contact, after[static_cast<std::size_t>(contact.ball)], of_other(contact, after));
        contact.separation_speed = relative.dot(contact.normal);
        contact.slip_after = tangential_part(relative, contact.normal);
        const Vec3 impulse = push(i);
        contact.impulse = std::max(impulse.dot(contact.normal), 0.0);
        contact.tangential_impulse = tangential_part(impulse, contact.normal).norm();
    }
    world_.clear_contacts();
}

}  // namespace carom
