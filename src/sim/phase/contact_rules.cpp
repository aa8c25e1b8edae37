#include "sim/phase/contact_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/convexity.h"
#include "geometry/feature.h"
#include "sim/group/island_step.h"

namespace carom {

namespace {

/// A bouncing series ends when its next hop is lower than this fraction of the ball's radius, or
/// than so many roundings of its place: a length of the scene where that can be, so that the motion
/// does not depend on where the coordinates begin.
constexpr double kLastHop = 1e-12;
constexpr double kLastRoundings = 16 * std::numeric_limits<double>::epsilon();

/// Where the coefficient of slow impacts is 1 by its law, hops of so many times that are the last
/// ones: a ball would take millions of them a second.
constexpr double kEndlessHop = 1000;

/// Two bodies of an island that is integrated touch up to this gap, as a fraction of the smaller
/// radius: a hundred times the error of a piece.
constexpr double kFineGap = 1e-10;

/// A force of this fraction of a ball's weight is none: more than the rounding of the forces.
constexpr double kBalanced = 1e-11;

/// What a pull [m/s^2] presses with along a normal; 0 where that is none, but for rounding.
double pressing_pull(const Vec3& pull, const Vec3& normal) {
    const double g_n = -pull.dot(normal);
    return g_n > 1e-14 * pull.norm() ? g_n : 0;
}

}  // namespace

double ContactRules::hop_limit(int ball, const Vec3& position, const ContactLaws* laws) const {
    const double limit = std::max(kLastHop * world_.ball(ball).radius,
                                  kLastRoundings * position.cwiseAbs().maxCoeff());
    return laws != nullptr && laws->is_endless() ? kEndlessHop * limit : limit;
}

double ContactRules::pressing(const Contact& c, double now, const Vec3& velocity) const {
    const Vec3 g = world_.pull_on(
        c.ball, {velocity, world_.feels_air(c.ball) ? world_.velocities(c.ball, now).spin
                                                    : Vec3(Vec3::Zero())});
    if (!c.other.is_surface || is_convex(world_.surface(c.other.index).shape))
        return pressing_pull(g, c.normal);
    const Vec3 x = world_.position(c.ball, now), v = tangential_part(velocity, c.normal);
    const FeatureMotion motion =
        feature_at(world_.surface(c.other.index).shape, {x, v, g}, world_.ball(c.ball).radius)
            .motion_at(x, v);
    const double bend = -motion.turning_speed.dot(motion.normal_rate);
    const double sum = bend - g.dot(c.normal);
    return sum > 1e-14 * (g.norm() + std::abs(bend)) ? sum : 0;
}

double ContactRules::slip_tolerance(int ball, double now, const Velocities& velocities) const {
    const double time_rounding = 8 * std::numeric_limits<double>::epsilon() * now;
    return kStillFraction *
               (velocities.linear.norm() + world_.ball(ball).radius * velocities.spin.norm()) +
           time_rounding * world_.scene.simulation.gravity.norm();
}

bool ContactRules::approaches_at_start(int ball, const std::vector<Contact>& contacts) const {
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        const double v = -c.separation_speed;
        const double g_n =
            -world_.pull_on(ball, {world_.body(ball).velocity, world_.body(ball).spin})
                 .dot(c.normal);
        return v > kStillFraction * world_.body(ball).velocity.norm() &&
               !(v * v / 2 < g_n * hop_limit(ball, world_.body(ball).position, c.laws));
    });
}

bool ContactRules::lasts(const Contact& c, int ball, double now, const Vec3& velocity,
                         double speed_scale, double& bounce_time_left) const {
    if (!c.other.is_surface) return false;
    const double g_n = pressing(c, now, velocity);
    if (g_n == 0) return false;
    const double v = std::max(c.separation_speed, 0.0);
    bounce_time_left = 0;
    if (v <= kStillFraction * speed_scale) return true;
    const Vec3 x = world_.position(ball, now);
    if (v * v / (2 * g_n) >= hop_limit(ball, x, c.laws)) return false;
    // Hops that drown in rounding are a contact for any coefficient; only for 1 they have no end.
    if (c.restitution < 1) bounce_time_left = 2 * v / (g_n * (1 - c.restitution));
    return true;
}

/// One of the two is in an island that ODE steps.
bool ContactRules::is_coarse(const Contact& c) const {
    return world_.ball(c.ball).coarse || (!c.other.is_surface && world_.ball(c.other.index).coarse);
}

bool ContactRules::in_reach(const Contact& contact) const {
    double radius = world_.ball(contact.ball).radius;
    if (!contact.other.is_surface)
        radius = std::min(radius, world_.ball(contact.other.index).radius);
    if (is_coarse(contact)) return -contact.depth < kLinkGap * radius + world_.place_rounding;
    return -contact.depth < kFineGap * radius +
                                world_.touch_tolerance(contact.point, contact.point, radius) +
                                world_.place_rounding;
}

ContactRules::Together ContactRules::stays_together(const Contact& contact, double now,
                                                    const Link* link) const {
    if (notes_.landing_of(contact, now) != nullptr) return {true};
    if (!in_reach(contact)) return {};
    Vec3 v = world_.velocities(contact.ball, now).linear;
    double still = kStillFraction * v.norm() + world_.ball(contact.ball).rounding_speed;
    if (!contact.other.is_surface) {
        const Vec3 other = world_.velocities(contact.other.index, now).linear;
        v -= other;
        still += kStillFraction * other.norm() + world_.ball(contact.other.index).rounding_speed;
    }
    const double speed = v.dot(contact.normal);
    Together answer;
    if (const Separation* parting = notes_.separation_of(contact, now); parting != nullptr) {
        answer.presses_again = parting->pressed || speed < -still;
        if (!answer.presses_again) return answer;
    }
    // Where ODE steps, what gravity does in one step is the finest that a step can tell.
    answer.lasts = is_coarse(contact)
                       ? std::abs(speed) <= slow_speed(world_)
                       : std::abs(speed) <= still ||
                             (speed > 0 && link != nullptr && hops_on(contact, *link, speed, now));
    return answer;
}

/// Whether what has just separated comes back by a hop that would be summed: the force that pressed
/// the two tells how fast.
bool ContactRules::hops_on(const Contact& contact, const Link& link, double separation,
                           double now) const {
    double inverse_mass = 1 / world_.ball(contact.ball).mass;
    if (!contact.other.is_surface) inverse_mass += 1 / world_.ball(contact.other.index).mass;
    const double a = link.push.dot(contact.normal) / kIslandStep * inverse_mass;
    return a > kBalanced * world_.scene.simulation.gravity.norm() &&
           separation * separation / (2 * a) <
               hop_limit(contact.ball, world_.position(contact.ball, now), contact.laws);
}

}  // namespace carom
