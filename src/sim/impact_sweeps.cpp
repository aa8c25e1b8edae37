#include "sim/impact_sweeps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

/// Sweeps over all contacts. A chain of n balls needs about n^2 of them a digit.
constexpr int kMostSweeps = 20'000;

/// A sweep that changes no velocity by more than this, relative to the largest approach, ends it.
constexpr double kConverged = 4 * std::numeric_limits<double>::epsilon();

/// A contact and the impulse that it has given so far.
struct Row {
    ImpactBody* ball = nullptr;
    ImpactBody* other = nullptr;  ///< null for a surface
    const Contact* contact = nullptr;
    double target = 0;               ///< separation speed, m/s
    double normal_mass = 0;          ///< kg: impulse per change of the speed along the normal
    double tangential_mass = 0;      ///< kg, the same across it, spin included
    double normal_impulse = 0;       ///< N s
    Vec3 tangential = Vec3::Zero();  ///< N s

    Vec3 speed() const {
        return relative_velocity(*contact, ball->velocities,
                                 other ? other->velocities : Velocities{});
    }
    void push(const Vec3& impulse) {
        ball->velocities.linear += impulse / ball->mass;
        ball->velocities.spin += contact->arm.cross(impulse) / ball->inertia;
        if (other == nullptr) return;
        other->velocities.linear -= impulse / other->mass;
        other->velocities.spin -= contact->arm_other.cross(impulse) / other->inertia;
    }
};

Row row_of(std::vector<ImpactBody>& bodies, const Contact& contact) {
    Row row;
    row.contact = &contact;
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
    row.target = contact.restitution * std::max(contact.approach_speed, 0.0);
    return row;
}

/// One contact set right; the largest change of speed that it needed.
double relax(Row& row) {
    const Vec3& n = row.contact->normal;
    const double wanted = row.normal_impulse + (row.target - row.speed().dot(n)) * row.normal_mass;
    const double change = std::max(wanted, 0.0) - row.normal_impulse;
    row.normal_impulse += change;
    if (change != 0) row.push(change * n);
    double moved = std::abs(change) / row.normal_mass;
    if (!(row.contact->friction > 0)) return moved;

    const Vec3 speed = row.speed();
    Vec3 tangential = row.tangential - row.tangential_mass * (speed - speed.dot(n) * n);
    const double bound = row.contact->friction * row.normal_impulse;
    if (const double size = tangential.norm(); size > bound) tangential *= bound / size;
    const Vec3 step = tangential - row.tangential;
    row.tangential = tangential;
    row.push(step);
    return std::max(moved, step.norm() / row.tangential_mass);
}

}  // namespace

void solve_by_sweeps(std::vector<ImpactBody>& bodies, std::vector<Contact>& contacts) {
    std::vector<Row> rows;
    double scale = 0;
    for (const Contact& c : contacts) {
        rows.push_back(row_of(bodies, c));
        scale = std::max(scale, std::abs(c.approach_speed));
    }
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        double moved = 0;
        for (Row& row : rows) moved = std::max(moved, relax(row));
        if (moved <= kConverged * scale) break;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        contacts[i].impulse = rows[i].normal_impulse;
        contacts[i].tangential_impulse = rows[i].tangential.norm();
    }
}

}  // namespace carom
