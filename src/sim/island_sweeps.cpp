#include "sim/island_sweeps.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Sweeps there and back in one step. A pile passes a force on by about one layer in each, and the
/// next step continues.
constexpr int kSweeps = 10;

/// A sweep that changes no speed by more than this [m/s] ends it: far below what counts as calm.
constexpr double kConverged = 1e-9;

/// A contact with the masses that it feels.
struct Row {
    ImpactBody* ball = nullptr;
    ImpactBody* other = nullptr;  ///< null for a surface
    const Contact* contact = nullptr;
    double target = 0;               ///< m/s
    double normal_mass = 0;          ///< kg
    double tangential_mass = 0;      ///< kg, spin included
    double normal = 0;               ///< N s
    Vec3 tangential = Vec3::Zero();  ///< N s

    Vec3 speed() const {
        return relative_velocity(*contact, ball->velocities,
                                 other != nullptr ? other->velocities : Velocities{});
    }
    void push(const Vec3& impulse) const {
        ball->velocities.linear += impulse / ball->mass;
        ball->velocities.spin += contact->arm.cross(impulse) / ball->inertia;
        if (other == nullptr) return;
        other->velocities.linear -= impulse / other->mass;
        other->velocities.spin -= contact->arm_other.cross(impulse) / other->inertia;
    }
    /// The tangential impulse that friction allows of a wanted one.
    Vec3 within_cone(const Vec3& wanted) const {
        const double bound = contact->friction * normal, size = wanted.norm();
        return size > bound ? Vec3(bound / size * wanted) : wanted;
    }
};

Row row_of(std::vector<ImpactBody>& bodies, const Contact& contact, double target,
           const Vec3& last_push) {
    Row row;
    row.contact = &contact;
    row.target = target;
    row.ball = &bodies[static_cast<std::size_t>(contact.ball)];
    double normal = 1 / row.ball->mass;
    double across = normal + contact.arm.squaredNorm() / row.ball->inertia;
    if (!contact.other.is_surface) {
        row.other = &bodies[static_cast<std::size_t>(contact.other.index)];
        normal += 1 / row.other->mass;
        across += 1 / row.other->mass + contact.arm_other.squaredNorm() / row.other->inertia;
    }
    row.normal_mass = 1 / normal;
    row.tangential_mass = 1 / across;
    row.normal = std::max(last_push.dot(contact.normal), 0.0);
    if (contact.friction > 0)
        row.tangential =
            row.within_cone(last_push - last_push.dot(contact.normal) * contact.normal);
    row.push(row.normal * contact.normal + row.tangential);
    return row;
}

/// One contact set right; the largest change of speed that it needed.
double relax(Row& row) {
    const Vec3& n = row.contact->normal;
    const double wanted = row.normal + (row.target - row.speed().dot(n)) * row.normal_mass;
    const double change = std::max(wanted, 0.0) - row.normal;
    row.normal += change;
    if (change != 0) row.push(change * n);
    const double moved = std::abs(change) / row.normal_mass;
    if (!(row.contact->friction > 0)) return moved;

    const Vec3 speed = row.speed();
    const Vec3 slip = speed - speed.dot(n) * n;
    const Vec3 tangential = row.within_cone(row.tangential - row.tangential_mass * slip);
    const Vec3 step = tangential - row.tangential;
    row.tangential = tangential;
    row.push(step);
    return std::max(moved, step.norm() / row.tangential_mass);
}

}  // namespace

void solve_island_by_sweeps(std::vector<ImpactBody>& bodies, const std::vector<Contact>& contacts,
                            const std::vector<double>& targets, std::vector<Vec3>& pushes) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < contacts.size(); ++i)
        rows.push_back(row_of(bodies, contacts[i], targets[i], pushes[i]));
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        double moved = 0;
        for (Row& row : rows) moved = std::max(moved, relax(row));
        for (std::size_t i = rows.size(); i-- > 0;) moved = std::max(moved, relax(rows[i]));
        if (moved <= kConverged) break;
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        pushes[i] = rows[i].normal * contacts[i].normal + rows[i].tangential;
}

}  // namespace carom
