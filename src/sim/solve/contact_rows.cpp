#include "sim/solve/contact_rows.h"

#include <algorithm>
#include <cmath>

namespace carom {

ContactRow::ContactRow(std::vector<ImpactBody>& bodies, const SolverContact& c, double wanted)
    : ball(&bodies[static_cast<std::size_t>(c.body)]), contact(&c), target(wanted) {
    double along = 1 / ball->mass;
    double across = along + c.arm.squaredNorm() / ball->inertia;
    if (!c.on_surface()) {
        other = &bodies[static_cast<std::size_t>(c.other_body)];
        along += 1 / other->mass;
        across += 1 / other->mass + c.arm_other.squaredNorm() / other->inertia;
    }
    normal_mass = 1 / along;
    tangential_mass = 1 / across;
}

Vec3 ContactRow::speed() const {
    return relative_velocity(*contact, ball->velocities,
                             other != nullptr ? other->velocities : Velocities{});
}

void ContactRow::push_along(double impulse) const {
    ball->velocities.linear += impulse / ball->mass * contact->normal;
    if (other != nullptr) other->velocities.linear -= impulse / other->mass * contact->normal;
}

double ContactRow::speed_along() const {
    const Vec3& v = ball->velocities.linear;
    return (other != nullptr ? Vec3(v - other->velocities.linear) : v).dot(contact->normal);
}

void ContactRow::push(const Vec3& impulse) const {
    ball->velocities.linear += impulse / ball->mass;
    ball->velocities.spin += contact->arm.cross(impulse) / ball->inertia;
    if (other == nullptr) return;
    other->velocities.linear -= impulse / other->mass;
    other->velocities.spin -= contact->arm_other.cross(impulse) / other->inertia;
}

Vec3 ContactRow::within_cone(const Vec3& wanted) const {
    const double bound = contact->friction * normal, size = wanted.norm();
    return size > bound ? Vec3(bound / size * wanted) : wanted;
}

void ContactRow::start_from(const Vec3& impulse) {
    const double along = impulse.dot(contact->normal);
    normal = std::max(along, 0.0);
    if (contact->friction > 0) tangential = within_cone(impulse - along * contact->normal);
    push(normal * contact->normal + tangential);
}

double ContactRow::relax() {
    const Vec3& n = contact->normal;
    const double wanted = normal + (target - speed_along()) * normal_mass;
    const double change = std::max(wanted, 0.0) - normal;
    normal += change;
    if (change != 0) push_along(change);
    const double moved = std::abs(change) / normal_mass;
    if (!(contact->friction > 0)) return moved;

    const Vec3 relative = speed();
    const Vec3 slip = relative - relative.dot(n) * n;
    const Vec3 allowed = within_cone(tangential - tangential_mass * (slip - slip_target));
    const Vec3 step = allowed - tangential;
    tangential = allowed;
    push(step);
    return std::max(moved, step.norm() / tangential_mass);
}

}  // namespace carom
