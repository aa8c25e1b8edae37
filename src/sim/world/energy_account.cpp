#include "sim/world/energy_account.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// A rise by this fraction of the energy is rounding.
constexpr double kEnergyRounding = 1e-14;

}  // namespace

void EnergyAccount::add(double mass, double inertia, double radius, const Vec3& place,
                        const Vec3& pull) {
    bodies_.push_back({mass, inertia, radius, place, pull});
}

double EnergyAccount::kinetic(std::span<const Velocities> velocities) const {
    double sum = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        sum += 0.5 * bodies_[i].mass * velocities[i].linear.squaredNorm() +
               0.5 * bodies_[i].inertia * velocities[i].spin.squaredNorm();
    return sum;
}

double EnergyAccount::total(std::span<const Vec3> places,
                            std::span<const Velocities> velocities) const {
    double sum = kinetic(velocities);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        sum -= bodies_[i].mass * bodies_[i].pull.dot(places[i] - bodies_[i].place);
    return sum;
}

double EnergyAccount::in_play(std::span<const Velocities> velocities) const {
    double sum = kinetic(velocities);
    for (const Body& b : bodies_) sum += b.mass * b.pull.norm() * b.radius;
    return sum;
}

double EnergyAccount::second_rate(std::span<const Vec3> accelerations,
                                  std::span<const Vec3> spin_rates) const {
    double sum = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        sum += bodies_[i].mass * accelerations[i].dot(accelerations[i] - bodies_[i].pull) +
               bodies_[i].inertia * spin_rates[i].squaredNorm();
    return sum;
}

double EnergyAccount::lift(std::span<const Vec3> from, std::span<const Vec3> to) const {
    double sum = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        sum -= bodies_[i].mass * bodies_[i].pull.dot(to[i] - from[i]);
    return sum;
}

bool EnergyAccount::can_pay(double excess, std::span<const Velocities> velocities) const {
    double fall = 0;
    for (const Body& b : bodies_) fall += b.mass * b.pull.norm() * b.radius;
    return excess <= kinetic(velocities) + kEnergyRounding * fall;
}

bool EnergyAccount::take_away(double excess, std::span<Velocities> velocities) const {
    Vec3 centre = Vec3::Zero();
    double total_mass = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        centre += bodies_[i].mass * velocities[i].linear;
        total_mass += bodies_[i].mass;
    }
    centre /= total_mass;
    const double all = kinetic(velocities);
    if (excess <= kEnergyRounding * all) return false;
    double relative = all - 0.5 * total_mass * centre.squaredNorm();
    if (!(relative > 2 * excess)) {
        centre.setZero();
        relative = all;
    }
    const double factor = std::sqrt(std::max(0.0, 1 - excess / relative));
    for (Velocities& v : velocities) {
        v.linear = centre + factor * (v.linear - centre);
        v.spin *= factor;
    }
    return true;
}

double rise_of_parabola(double loss, double bulge) {
    // e(u) = -loss u + 4 bulge u (1 - u), from one end to its top, or from its lowest place to the
    // other end.
    const double height = 4 * std::abs(bulge);
    return height > loss ? (height - loss) * (height - loss) / (4 * height) : 0;
}

}  // namespace carom
