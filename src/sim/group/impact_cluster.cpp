#include "sim/group/impact_cluster.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "geometry/nearest.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// A gap above this part of the places is none of a contact, well above all roundings.
constexpr double kFar = 1e-6;

}  // namespace

ImpactCluster::ImpactCluster(ExactWorld& world) : world_(world), place_(world.balls.size(), -1) {}

std::size_t ImpactCluster::index_of(int ball) const {
    CAROM_CHECK(has(ball), ==, true);
    return static_cast<std::size_t>(place_[static_cast<std::size_t>(ball)]);
}

void ImpactCluster::add_ball(int ball) {
    if (has(ball)) return;
    place_[static_cast<std::size_t>(ball)] = static_cast<int>(balls_.size());
    balls_.push_back(ball);
    const ExactBall& b = world_.ball(ball);
    const Velocities now = world_.velocities(ball, time_);
    bodies_.push_back({world_.position(ball, time_), now, b.mass,
                       b.inertia_factor * b.mass * b.radius * b.radius});
    largest_speed_ = std::max(largest_speed_, now.linear.norm() + b.radius * now.spin.norm());
}

void ImpactCluster::add(const Contact& contact) {
    contacts_.push_back(contact);
    add_ball(contact.ball);
    if (!contact.other.is_surface) add_ball(contact.other.index);
}

/// Whether a contact is among those of the ball at hand already.
bool ImpactCluster::is_known(int ball, const Partner& other) const {
    for (std::size_t i = first_of_ball_; i < contacts_.size(); ++i)
        if (contacts_[i].ball == ball && contacts_[i].other == other) return true;
    return false;
}

void ImpactCluster::add_new(const Contact& contact) {
    if (!is_known(contact.ball, contact.other)) add(contact);
}

void ImpactCluster::gather(const Contact& seed, const Seeds& seeds, double time) {
    near_ = 0;
    grow(seed, seeds, time);
}

void ImpactCluster::gather_heap(const Contact& seed, const Seeds& seeds, double near, double time) {
    near_ = near;
    grow(seed, seeds, time);
}

void ImpactCluster::grow(const Contact& seed, const Seeds& seeds, double time) {
    for (const int ball : balls_) place_[static_cast<std::size_t>(ball)] = -1;
    balls_.clear();
    bodies_.clear();
    contacts_.clear();
    time_ = time;
    largest_speed_ = 0;
    add_ball(seed.ball);
    // The order of the balls follows the contacts, so that the same scene gives the same cluster.
    for (std::size_t k = 0; k < balls_.size(); ++k) {
        const int ball = balls_[k];
        first_of_ball_ = contacts_.size();
        seeds.for_each_of(ball, [&](const Contact& c) {
            // A ball-ball seed comes up twice: it is taken when the first of the two is looked at.
            const int partner = c.ball == ball ? c.other.index : c.ball;
            if (c.other.is_surface || !has(partner) || index_of(partner) > k) add(c);
        });
        touch_surfaces(ball);
        touch_balls(ball);
        merge_places(world_, bodies_[k].position, bodies_[k].velocities, contacts_, first_of_ball_,
                     [this](const Contact& gone, const Contact& kept) {
                         int& surface = world_.ball(gone.ball).surface;
                         if (surface == gone.other.index) surface = kept.other.index;
                     });
    }
}

/// `size`: of the smaller radius, m.
bool ImpactCluster::meets(const Contact& contact, double size) const {
    return -contact.depth <= near_ * size || world_.touches(contact, time_);
}

void ImpactCluster::touch_surfaces(int ball) {
    const Vec3 x = bodies_[index_of(ball)].position;
    const double radius = world_.ball(ball).radius;
    const double far =
        kFar * (radius + x.cwiseAbs().maxCoeff()) + world_.place_rounding + near_ * radius;
    world_.for_each_surface_near(ball, x, radius + far, [&](int s) {
        // Far surfaces are the common case, as far balls are below.
        if (nearest_on(world_.surface(s).shape, x, radius).gap > far) return;
        if (is_known(ball, {true, s})) return;
        const Contact contact = world_.contact_at(ball, {true, s}, time_);
        if (meets(contact, radius)) add(contact);
    });
}

void ImpactCluster::touch_balls(int ball) {
    const std::size_t place = index_of(ball);
    const Vec3 x = bodies_[place].position;
    const double radius = world_.ball(ball).radius;
    world_.for_each_near(ball, [&](int other) {
        // Far pairs are the common case: a little more than the sum of the radii excludes them.
        const Glance& glance = world_.glance(other);
        const double reach =
            1.001 * (radius + (glance.falls() ? glance.radius : world_.ball(other).radius));
        const Vec3 y =
            glance.falls() ? world_.glimpse(other, time_) : world_.position(other, time_);
        if ((x - y).squaredNorm() > reach * reach + 1e-9 * x.squaredNorm()) return;
        if (has(other) && index_of(other) < place) return;  // looked at from the other side
        if (in_pile(world_.ball(other).phase())) return;    // met by steps of its own
        const Contact contact = world_.contact_at(ball, {false, other}, time_);
        if (meets(contact, std::min(radius, world_.ball(other).radius))) add_new(contact);
    });
}

// ---- What it tells
// --------------------------------------------------------------------------------

double ImpactCluster::approach(const Contact& c) const {
    const Velocities other =
        c.other.is_surface ? Velocities{} : bodies_[index_of(c.other.index)].velocities;
    return -relative_velocity(c, bodies_[index_of(c.ball)].velocities, other).dot(c.normal);
}

void ImpactCluster::contacts_of(int ball, std::vector<Contact>& result) const {
    result.clear();
    for (const Contact& c : contacts_) {
        if (c.ball != ball && (c.other.is_surface || c.other.index != ball)) continue;
        result.push_back(c);
    }
}

}  // namespace carom
