#include "sim/world/seams.h"

#include <algorithm>
#include <cmath>

#include "geometry/feature.h"
#include "geometry/feature_side.h"
#include "geometry/nearest.h"

namespace carom {

namespace {

/// Heights of two surfaces over one another are known to a few roundings of each place.
constexpr double kPlaces = 4;

/// Normals of flat parts that differ by less [rad] are one: each went through a few roundings.
constexpr double kOnePlane = 1e-14;

/// Demands that differ by less, as a fraction of their size, are equal.
constexpr double kEqual = 1e-9;

/// Halvings of the time at which a path is looked at for whether it keeps out of a surface.
constexpr int kLooks = 40;

double place_rounding(const ExactWorld& world, const Contact& c, const Vec3& x) {
    return kPlaces * world.touch_tolerance(x, c.point, world.ball(c.ball).radius);
}

Vec3 centre(const ExactWorld& world, const Contact& c) {
    return c.point + (world.ball(c.ball).radius - c.depth) * c.normal;
}

/// 1 for a face or a plane, 2 for what is round along a line, 3 around a point.
double roundness(const SingleContact& feature) { return feature.across.trace(); }

bool is_flat(const SingleContact& feature) { return roundness(feature) < 1.5; }

SingleContact feature_at(const ExactWorld& world, const Contact& c, const Vec3& x, const Vec3& v) {
    return single_contact(world.surface(c.other.index).shape, x, v, world.ball(c.ball).radius,
                          world.pull(c.ball));
}

/// The least acceleration along the normal that keeps a centre out of a feature [m/s^2].
double demand_of(const SingleContact& feature, const Vec3& x, const Vec3& v) {
    const FeatureMotion m = feature.motion_at(x, v);
    if (feature.has_circle() || feature.hollow) return -m.turning_speed.dot(m.normal_rate);
    const Vec3& moved = m.turning_speed;
    return -(moved - m.normal.dot(moved) * m.normal).squaredNorm() / m.distance;
}

/// The part of a vector along a surface; none where it is the rounding of the normal.
Vec3 along_surface(const Vec3& vector, const Vec3& normal) {
    const Vec3 part = tangential_part(vector, normal);
    return part.norm() > kAlongBorder * vector.norm() ? part : Vec3(Vec3::Zero());
}

/// Where the motion leads to, as far away as a border may be off by rounding: a bump of that height
/// is so long.
Vec3 place_ahead(const ExactWorld& world, const Contact& c, const Vec3& x, const Vec3& v) {
    Vec3 way = v;
    if (way.isZero(0)) way = along_surface(world.pull(c.ball), c.normal);
    if (way.isZero(0)) return x;
    const double radius = world.ball(c.ball).radius;
    return x + 2 * std::sqrt(2 * radius * place_rounding(world, c, x)) * way.normalized();
}

/// Whether feature `a` holds rather than `b`: the one that bends away less, then the flatter one.
/// `size` [m/s^2]: of the accelerations at hand.
bool holds_rather(const SingleContact& a, const SingleContact& b, const Vec3& x, const Vec3& v,
                  double size) {
    const double difference = demand_of(a, x, v) - demand_of(b, x, v);
    if (std::abs(difference) > kEqual * size) return difference > 0;
    return roundness(a) < roundness(b) - 0.5;
}

double size_of_demands(const ExactWorld& world, const Contact& c, const Vec3& v) {
    return v.squaredNorm() / world.ball(c.ball).radius + world.scene.simulation.gravity.norm();
}

/// The contact with a feature instead of the nearest place of its surface.
Contact contact_with(const ExactWorld& world, Contact c, const SingleContact& feature,
                     const Vec3& x) {
    const double radius = world.ball(c.ball).radius;
    c.normal = feature.normal_at(x);
    c.depth = -feature.gap_at(x);
    c.point = x - (radius - c.depth) * c.normal;
    c.arm = -radius * c.normal;
    return c;
}

bool is_in_reach(const ExactWorld& world, const Contact& c, const Vec3& x) {
    return -c.depth <= place_rounding(world, c, x);
}

}  // namespace

bool same_place(const ExactWorld& world, const Contact& a, const Contact& b) {
    const double turned = (a.normal - b.normal).norm();
    if (turned <= kOnePlane) return true;
    const Vec3 x = centre(world, a);
    const double rounding = std::max(place_rounding(world, a, x), place_rounding(world, b, x));
    if (0.5 * world.ball(a.ball).radius * turned * turned > rounding) return false;
    // Two faces that meet at an angle, however small, are two places.
    const SingleContact of_a = feature_at(world, a, x, Vec3::Zero());
    const SingleContact of_b = feature_at(world, b, x, Vec3::Zero());
    return !(is_flat(of_a) && is_flat(of_b)) ||
           (of_a.normal_at(x) - of_b.normal_at(x)).norm() <= kOnePlane;
}

bool holds_before(const ExactWorld& world, const Contact& a, const Contact& b, const Vec3& x,
                  const Velocities& velocities) {
    const double still = kStillFraction * velocities.linear.norm();
    const bool a_comes = velocities.linear.dot(a.normal) < -still;
    const bool b_comes = velocities.linear.dot(b.normal) < -still;
    if (a_comes != b_comes) return a_comes;
    const Vec3 v = along_surface(velocities.linear, a.normal);
    const Vec3 y = place_ahead(world, a, x, v);
    const SingleContact of_a = feature_at(world, a, y, v), of_b = feature_at(world, b, y, v);
    const double size = size_of_demands(world, a, v);
    if (holds_rather(of_a, of_b, y, v, size)) return true;
    if (holds_rather(of_b, of_a, y, v, size)) return false;
    // Not by the order in the scene, as far as it makes a difference.
    const auto at_this_speed = [&velocities](Contact c) {
        c.approach_speed = -velocities.linear.dot(c.normal);
        find_restitution(c);
        return c.restitution;
    };
    const double e_a = at_this_speed(a), e_b = at_this_speed(b);
    if (e_a != e_b) return e_a < e_b;
    if (a.friction != b.friction) return a.friction > b.friction;
    return a.other.index < b.other.index;
}

void lay_flat(const ExactWorld& world, Contact& c, const Vec3& x, const Velocities& velocities) {
    const Vec3 v = along_surface(velocities.linear, c.normal);
    const SingleContact feature = feature_at(world, c, place_ahead(world, c, x, v), v);
    if (!is_flat(feature)) return;
    const double radius = world.ball(c.ball).radius;
    const Vec3 over = feature.origin + feature.distance * feature.normal_at(x);
    const Vec3 normal = nearest_on(world.surface(c.other.index).shape, over, radius).normal;
    if (normal == c.normal) return;
    c.normal = normal;
    c.depth = feature.distance - normal.dot(x - feature.origin);
    c.point = x - (radius - c.depth) * normal;
    c.arm = -radius * normal;
}

std::optional<SurfaceContact> goes_on_with(const ExactWorld& world, const Contact& held,
                                           const Vec3& x, const Velocities& velocities) {
    const Vec3 v = along_surface(velocities.linear, held.normal);
    const Vec3 y = place_ahead(world, held, x, v);
    const double size = size_of_demands(world, held, v);
    SingleContact best = feature_at(world, held, y, v);
    std::optional<SurfaceContact> found;
    const auto look = [&](int s) {
        if (s == held.other.index) return;
        const Contact c = world.surface_contact(held.ball, s, x);
        if (!is_in_reach(world, c, x) || !same_place(world, held, c)) return;
        const SingleContact feature = feature_at(world, c, y, v);
        if (!holds_rather(feature, best, y, v, size)) return;
        best = feature;
        found = SurfaceContact{contact_with(world, c, feature, x), feature};
    };
    world.for_each_surface_near(held.ball, x, world.reach(held.ball), look);
    return found;
}

bool keeps_out(const ExactWorld& world, int ball, int surface, double from, double until) {
    const Piece& piece = world.ball(ball).piece;
    const double radius = world.ball(ball).radius;
    const SurfaceShape& shape = world.surface(surface).shape;
    const auto is_out = [&](double t) {
        const Vec3 x = piece.position_at(t);
        const Nearest nearest = nearest_on(shape, x, radius);
        return nearest.gap >= -kPlaces * world.touch_tolerance(x, nearest.point, radius);
    };
    if (!is_out(from)) return false;
    double seconds = until - from;
    for (int i = 0; i < kLooks && seconds > 0; ++i, seconds *= 0.5)
        if (!is_out(from + seconds)) return false;
    return true;
}

void add_borders_of_others(const ExactWorld& world, const Contact& held, const ContactState& at,
                           SingleContact& feature) {
    // On the surface that holds it: a step of ODE may have left a gap.
    const Vec3 x = at.x + held.depth * held.normal;
    const double border = kBorder * (x.cwiseAbs().maxCoeff() + world.ball(held.ball).radius);
    const auto look = [&](int s) {
        if (s == held.other.index) return;
        const Contact c = world.surface_contact(held.ball, s, x);
        if (!is_in_reach(world, c, x) || !same_place(world, held, c)) return;
        const SingleContact other = feature_at(world, c, x, at.v);
        for (int i = 0; i < other.border_count && feature.border_count < kMostBorders; ++i) {
            const FeatureBorder& limit = other.borders[static_cast<std::size_t>(i)];
            // Where the ball is on that border already, it is a seam between the two.
            if (limit.margin(x) > border) feature.add_border(limit.direction, limit.offset);
        }
    };
    world.for_each_surface_near(held.ball, x, world.reach(held.ball), look);
    // A ball that goes along a border is not beyond it by what rounding makes of its place.
    for (int i = 0; i < feature.border_count; ++i) {
        FeatureBorder& limit = feature.borders[static_cast<std::size_t>(i)];
        if (limit.margin(x) <= border) limit.offset -= 2 * border;
    }
}

}  // namespace carom
