#include "sim/collide/time_of_impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/feature_side.h"
#include "geometry/nearest.h"
#include "sim/collide/conservative_advancement.h"

namespace carom {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A crossing of one feature's gap counts if the whole body is as near then as that feature says.
/// The bound is the rounding of a distance in the numbers that make it up, and no more: features
/// join tangentially, so that the feature that is really met passes by far.
constexpr double kPathRounding = 64 * kEpsilon;

/// |p|^2 - d^2 as if computed with twice the digits (T. Ogita, S. M. Rump, S. Oishi, "Accurate sum
/// and dot product", SIAM J. Sci. Comput. 26, 2005, algorithm Dot2): the sign decides of grazing.
double squared_difference(const Vec3& p, double d) {
    const double minus_d = -d;
    double sum = 0, lost = 0;
    const auto add = [&sum, &lost](double x, double y) {
        const double product = x * y;
        const double next = sum + product;
        const double part = next - sum;
        lost += ((sum - (next - part)) + (product - part)) + std::fma(x, y, -product);
        sum = next;
    };
    for (int i = 0; i < 3; ++i) add(p[i], p[i]);
    add(minus_d, d);
    return sum + lost;
}

/// |p|^2 - d^2 along a path.
Polynomial squared_distance(const Path& p, double d) {
    const Vec3 half = 0.5 * p.acceleration;
    return {{squared_difference(p.position, d), 2 * p.position.dot(p.velocity),
             p.velocity.squaredNorm() + 2 * p.position.dot(half), 2 * p.velocity.dot(half),
             half.squaredNorm()}};
}

/// The crossings of one gap, and for a pair in contact whether this gap presses them together.
struct Crossings {
    Roots roots;
    bool pressed = false;
};

/// For a pair in contact: the gap is 0 at s = 0; what comes after is the gap divided by s.
/// `separation` is the rate of the gap below which they do not move apart.
Crossings crossings(Polynomial gap, bool touching, double horizon, double separation) {
    if (!touching) return {downward_crossings(gap, horizon), false};
    gap = gap.divided_by_s();
    bool pressed = false;
    if (gap.c[0] <= separation) {
        gap = gap.divided_by_s();
        pressed = gap.c[0] < 0;
    }
    return {downward_crossings(gap, horizon), pressed};
}

TimeOfImpact first(const Crossings& found) {
    if (found.pressed) return {ImpactState::kPressed, 0};
    if (found.roots.capped) return {ImpactState::kCapped, 0};
    return found.roots.count > 0 ? TimeOfImpact{ImpactState::kHit, found.roots.at[0]}
                                 : TimeOfImpact{};
}

/// Rates below this are rounding of a zero.
double still(const Path& p) { return kPathRounding * p.velocity.norm(); }

/// The earliest crossing of several features at which the whole body is really touched.
class EarliestTouch {
  public:
    /// Of what touches, the gap of now counts as 0, and so does a later one of the same size.
    EarliestTouch(const Path& ball, double radius, const SurfaceShape& shape, bool touching)
        : ball_(ball),
          radius_(radius),
          shape_(shape),
          gap_(touching ? std::max(nearest_on(shape, ball.position, radius).gap, 0.0) : 0.0) {}

    /// `holds`: the motion leads to this feature, which therefore decides whether they press.
    void offer(const Crossings& found, bool holds) {
        pressed_ |= holds && found.pressed;
        const Roots& roots = found.roots;
        if (roots.capped) result_ = {ImpactState::kCapped, 0};
        for (int i = 0; i < roots.count && result_.state != ImpactState::kCapped; ++i) {
            const double s = roots.at[static_cast<std::size_t>(i)];
            if (result_.state == ImpactState::kHit && s >= result_.s) return;
            if (!touched(s)) continue;
            result_ = {ImpactState::kHit, s};
            return;
        }
    }
    TimeOfImpact result() const {
        return pressed_ ? TimeOfImpact{ImpactState::kPressed, 0} : result_;
    }

  private:
    bool touched(double s) const {
        const Vec3 center = ball_.at(s);
        // Rounding of the centre and of the time, which the speed turns into a distance.
        const double speed = (ball_.velocity + s * ball_.acceleration).norm();
        const double scale = ball_.position.cwiseAbs().maxCoeff() + center.cwiseAbs().maxCoeff() +
                             speed * s + radius_;
        return nearest_on(shape_, center, radius_).gap <= gap_ + kPathRounding * scale;
    }

    const Path& ball_;
    double radius_;
    const SurfaceShape& shape_;
    double gap_;
    TimeOfImpact result_;
    bool pressed_ = false;
};

/// The part of a path across a unit axis.
Path across(const Path& p, const Vec3& axis) {
    const auto drop = [&axis](const Vec3& v) -> Vec3 { return v - axis.dot(v) * axis; };
    return {drop(p.position), drop(p.velocity), drop(p.acceleration)};
}

Path shifted(const Path& p, const Vec3& origin) {
    return {p.position - origin, p.velocity, p.acceleration};
}

/// The box with sides along the axes that a path stays in up to the horizon, rounding included.
struct Bounds {
    Vec3 low, high;

    Bounds(const Path& p, double horizon) {
        const Vec3 end = p.at(horizon);
        low = p.position.cwiseMin(end);
        high = p.position.cwiseMax(end);
        for (int i = 0; i < 3; ++i) {
            if (p.acceleration[i] == 0) continue;
            const double turn = -p.velocity[i] / p.acceleration[i];
            if (!(turn > 0 && turn < horizon)) continue;
            low[i] = std::min(low[i], p.at(turn)[i]);
            high[i] = std::max(high[i], p.at(turn)[i]);
        }
        const Vec3 rounding = 1e-9 * low.cwiseAbs().cwiseMax(high.cwiseAbs());
        low -= rounding;
        high += rounding;
    }
    /// Whether something within `radius` of the path may reach the box from a to b.
    bool reaches(const Vec3& a, const Vec3& b, double radius) const {
        const double r = radius * (1 + 1e-6);
        return ((low.array() - r) <= b.array()).all() && ((high.array() + r) >= a.array()).all();
    }
};

/// Whether a contact now belongs to a feature with this gap: then the gap is 0, not its rounding.
bool is_contact(bool touching, double gap, double scale) {
    return touching && std::abs(gap) <= 1e-9 * scale;
}

/// Along a capsule, the side of its shaft that the ball's motion leads to.
int side_along(const Path& ball, double radius, const CapsuleShape& capsule, const Vec3& axis) {
    const double half = 0.5 * (capsule.to - capsule.from).norm();
    const double border = kBorder * (ball.position.cwiseAbs().maxCoeff() + radius);
    return side_of({axis.dot(ball.position - capsule.from) - half, axis.dot(ball.velocity),
                    axis.dot(ball.acceleration)},
                   half, border, ball.velocity.norm());
}

/// Per axis of a box whose frame the path is in, the side that the motion leads to.
std::array<int, 3> sides_of(const Path& p, const Vec3& half, double border) {
    std::array<int, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        sides[i] = side_of({p.position[axis], p.velocity[axis], p.acceleration[axis]}, half[axis],
                           border, p.velocity.norm());
    }
    return sides;
}

/// An iteration may not end where the coefficients of a gap lie further apart than doubles can
/// tell, as of a ball that all but lies still: where it cannot come so far, it misses.
TimeOfImpact unless_out_of_reach(const TimeOfImpact& found, const Path& path, double gap,
                                 double horizon) {
    if (found.state != ImpactState::kCapped) return found;
    const double way = horizon * (path.velocity.norm() + 0.5 * horizon * path.acceleration.norm());
    return gap > way ? TimeOfImpact{} : found;
}

}  // namespace

TimeOfImpact impact_with_plane(const Path& ball, double radius, const PlaneShape& plane,
                               bool touching, double horizon) {
    const Polynomial gap{{plane.normal.dot(ball.position) - plane.offset_m - radius,
                          plane.normal.dot(ball.velocity),
                          0.5 * plane.normal.dot(ball.acceleration), 0, 0}};
    return first(crossings(gap, touching, horizon, still(ball)));
}

TimeOfImpact impact_with_sphere(const Path& path, double distance, bool touching, double horizon) {
    const TimeOfImpact found = first(
        crossings(squared_distance(path, distance), touching, horizon, 2 * distance * still(path)));
    return unless_out_of_reach(found, path, path.position.norm() - distance, horizon);
}

TimeOfImpact impact_with_capsule(const Path& ball, double radius, const CapsuleShape& capsule,
                                 bool touching, double horizon) {
    const SurfaceShape shape = capsule;
    const double d = radius + capsule.radius;
    const Vec3 axis = (capsule.to - capsule.from).normalized();
    const int side = touching ? side_along(ball, radius, capsule, axis) : 0;
    EarliestTouch earliest(ball, radius, shape, touching);
    const auto offer = [&](const Path& p, int at) {
        const bool here = is_contact(touching, p.position.norm() - d, d);
        earliest.offer(crossings(squared_distance(p, d), here, horizon, 2 * d * still(p)),
                       side == at);
    };
    offer(across(shifted(ball, capsule.from), axis), 0);
    offer(shifted(ball, capsule.from), -1);
    offer(shifted(ball, capsule.to), 1);
    return earliest.result();
}

TimeOfImpact impact_with_box(const Path& ball, double radius, const BoxShape& box, bool touching,
                             double horizon) {
    // In the box's own frame: six faces, twelve edges (cylinders of the ball's radius around them)
    // and eight corners.
    const Mat3 box_from_world = box.orientation.toRotationMatrix().transpose();
    const Path p{box_from_world * (ball.position - box.center), box_from_world * ball.velocity,
                 box_from_world * ball.acceleration};
    const Vec3 half = 0.5 * box.size;
    const Bounds bounds(p, horizon);
    if (!touching && !bounds.reaches(-half, half, radius)) return {};
    const SurfaceShape own_frame = BoxShape{Vec3::Zero(), box.size, Quat::Identity()};
    EarliestTouch earliest(p, radius, own_frame, touching);
    using Sides = std::array<int, 3>;
    const double border = kBorder * (ball.position.cwiseAbs().maxCoeff() + radius);
    const Sides sides = touching ? sides_of(p, half, border) : Sides{};

    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
            const Polynomial gap{{side * p.position[axis] - half[axis] - radius,
                                  side * p.velocity[axis], 0.5 * side * p.acceleration[axis], 0,
                                  0}};
            const bool here = is_contact(touching, gap.c[0], radius);
            Sides face{};
            face[static_cast<std::size_t>(axis)] = side;
            earliest.offer(crossings(gap, here, horizon, still(p)), sides == face);
        }
    const auto offer_round = [&](const Path& q, const Sides& at) {
        const bool here = is_contact(touching, q.position.norm() - radius, radius);
        earliest.offer(crossings(squared_distance(q, radius), here, horizon, 2 * radius * still(q)),
                       sides == at);
    };
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 c;
        Sides at{};
        for (int axis = 0; axis < 3; ++axis) {
            const bool beyond = (corner >> axis & 1) != 0;
            c[axis] = beyond ? half[axis] : -half[axis];
            at[static_cast<std::size_t>(axis)] = beyond ? 1 : -1;
        }
        if (bounds.reaches(c, c, radius)) offer_round(shifted(p, c), at);
        // The edges that start at this corner and run along +axis.
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 end = c + box.size[axis] * Vec3::Unit(axis);
            if (!(c[axis] < 0 && bounds.reaches(c, end, radius))) continue;
            Sides along = at;
            along[static_cast<std::size_t>(axis)] = 0;
            offer_round(across(shifted(p, c), Vec3::Unit(axis)), along);
        }
    }
    return earliest.result();
}

namespace {

TimeOfImpact impact_with(const PlaneShape& plane, const Path& ball, double radius, bool touching,
                         double horizon) {
    return impact_with_plane(ball, radius, plane, touching, horizon);
}
TimeOfImpact impact_with(const BoxShape& box, const Path& ball, double radius, bool touching,
                         double horizon) {
    return impact_with_box(ball, radius, box, touching, horizon);
}
TimeOfImpact impact_with(const CapsuleShape& capsule, const Path& ball, double radius,
                         bool touching, double horizon) {
    return impact_with_capsule(ball, radius, capsule, touching, horizon);
}
TimeOfImpact impact_with(const SphereShape& sphere, const Path& ball, double radius, bool touching,
                         double horizon) {
    return impact_with_sphere(shifted(ball, sphere.center), radius + sphere.radius, touching,
                              horizon);
}
TimeOfImpact impact_with(const CylinderShape& cylinder, const Path& ball, double radius,
                         bool touching, double horizon) {
    return advance_to_impact(ball, radius, cylinder, touching, horizon);
}
TimeOfImpact impact_with(const RingShape& ring, const Path& ball, double radius, bool touching,
                         double horizon) {
    return advance_to_impact(ball, radius, ring, touching, horizon);
}
TimeOfImpact impact_with(const BowlShape& bowl, const Path& ball, double radius, bool touching,
                         double horizon) {
    return advance_to_impact(ball, radius, bowl, touching, horizon);
}
TimeOfImpact impact_with(const PipeShape& pipe, const Path& ball, double radius, bool touching,
                         double horizon) {
    return advance_to_impact(ball, radius, pipe, touching, horizon);
}

}  // namespace

TimeOfImpact impact_with_surface(const Path& ball, double radius, const SurfaceShape& shape,
                                 bool touching, double horizon) {
    const TimeOfImpact found = std::visit(
        [&](const auto& s) { return impact_with(s, ball, radius, touching, horizon); }, shape);
    if (found.state != ImpactState::kCapped) return found;
    return unless_out_of_reach(found, ball, nearest_on(shape, ball.position, radius).gap, horizon);
}

}  // namespace carom
