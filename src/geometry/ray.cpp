#include "geometry/ray.h"

#include <algorithm>

#include "core/infinity.h"

namespace carom {

namespace {

/// The part of a ray that is inside something convex; nothing where low >= high.
struct Span {
    double low = -kInfinity, high = kInfinity;  ///< m along the ray

    bool empty() const { return !(low < high); }
    Span common(const Span& other) const {
        return {std::max(low, other.low), std::min(high, other.high)};
    }
};
constexpr Span kNothing = {kInfinity, -kInfinity};

/// Inside `radius` of a centre. What lies across the ray is taken first, so that far spheres lose
/// nothing.
Span through_sphere(const Vec3& from_center, const Vec3& direction, double radius) {
    const double middle = -from_center.dot(direction);
    const double passes = (from_center + middle * direction).norm();
    if (!(passes < radius)) return kNothing;
    const double half = std::sqrt((radius - passes) * (radius + passes));
    return {middle - half, middle + half};
}

Vec3 across(const Vec3& v, const Vec3& axis) { return v - v.dot(axis) * axis; }

/// Inside `radius` of an endless axis.
Span through_tube(const Vec3& from_axis, const Vec3& axis, const Vec3& direction, double radius) {
    constexpr double kParallel = 1e-14;  // sine of an angle that rounding makes
    const Vec3 d = across(direction, axis), p = across(from_axis, axis);
    const double speed = d.norm();
    if (speed < kParallel) return p.norm() < radius ? Span{} : kNothing;
    const Span part = through_sphere(p, d / speed, radius);
    return part.empty() ? kNothing : Span{part.low / speed, part.high / speed};
}

/// Between the heights 0 and `length` along an axis.
Span through_slab(double height, double climb, double length) {
    if (climb == 0) return height > 0 && height < length ? Span{} : kNothing;
    const double one = -height / climb, two = (length - height) / climb;
    return {std::min(one, two), std::max(one, two)};
}

std::optional<RayHit> enters(double distance, const Vec3& normal) {
    if (!(distance > 0) || distance == kInfinity) return std::nullopt;
    return RayHit{distance, normal};
}

/// Of two sides of a round wall, the first one where there is wall.
template <class IsWall, class Outward>
std::optional<RayHit> meets_wall(const Span& inside, const Ray& ray, const IsWall& is_wall,
                                 const Outward& outward) {
    if (inside.empty()) return std::nullopt;
    for (const double t : {inside.low, inside.high}) {
        if (!(t > 0) || !std::isfinite(t) || !is_wall(ray.at(t))) continue;
        const Vec3 normal = outward(ray.at(t));
        return RayHit{t, normal.dot(ray.direction) > 0 ? Vec3(-normal) : normal};
    }
    return std::nullopt;
}

/// Distance of a place from a ring, seen from its middle.
class RingGap {
  public:
    RingGap(const RingShape& ring, const Ray& ray)
        : ring_(ring), ray_{ray.origin - ring.center, ray.direction} {}

    double operator()(double t) const {
        const Vec3 p = ray_.at(t);
        const double along = p.dot(ring_.axis);
        return std::hypot(std::sqrt(std::max(p.squaredNorm() - along * along, 0.0)) - ring_.radius,
                          along) -
               ring_.tube_radius;
    }
    Vec3 normal(double t) const {
        const Vec3 p = ray_.at(t), out = across(p, ring_.axis).normalized();
        return (p - ring_.radius * out).normalized();
    }

  private:
    const RingShape& ring_;
    Ray ray_;
};

/// Between `outside` and `inside`, where the gap changes its sign.
double bisect(const RingGap& gap, double outside, double inside) {
    for (int i = 0; i < 60 && outside < inside; ++i) {
        const double middle = 0.5 * (outside + inside);
        if (middle <= outside || middle >= inside) break;
        (gap(middle) > 0 ? outside : inside) = middle;
    }
    return inside;
}

}  // namespace

std::optional<RayHit> first_hit(const PlaneShape& plane, const Ray& ray) {
    const double height = plane.normal.dot(ray.origin) - plane.offset_m;
    const double climb = plane.normal.dot(ray.direction);
    if (!(height > 0 && climb < 0)) return std::nullopt;
    return enters(-height / climb, plane.normal);
}

std::optional<RayHit> first_hit(const BoxShape& box, const Ray& ray) {
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    const Vec3 p = world_from_box.transpose() * (ray.origin - box.center);
    const Vec3 d = world_from_box.transpose() * ray.direction;
    Span inside;
    int face = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Span slab = through_slab(p[axis] + 0.5 * box.size[axis], d[axis], box.size[axis]);
        if (slab.low > inside.low) face = axis;
        inside = inside.common(slab);
    }
    if (inside.empty()) return std::nullopt;
    return enters(inside.low, (d[face] > 0 ? -1 : 1) * world_from_box.col(face));
}

std::optional<RayHit> first_hit(const SphereShape& sphere, const Ray& ray) {
    const Vec3 from_center = ray.origin - sphere.center;
    const Span inside = through_sphere(from_center, ray.direction, sphere.radius);
    if (inside.empty()) return std::nullopt;
    return enters(inside.low, (from_center + inside.low * ray.direction) / sphere.radius);
}

std::optional<RayHit> first_hit(const CapsuleShape& capsule, const Ray& ray) {
    const Vec3 whole = capsule.to - capsule.from;
    const double length = whole.norm();
    const Vec3 axis = whole / length, from = ray.origin - capsule.from;
    // Entered where the first of its parts is: the shaft between the ends, and both balls.
    const Span shaft = through_tube(from, axis, ray.direction, capsule.radius)
                           .common(through_slab(from.dot(axis), ray.direction.dot(axis), length));
    double first = shaft.empty() ? kInfinity : shaft.low;
    for (const Vec3& end : {capsule.from, capsule.to}) {
        const Span ball = through_sphere(ray.origin - end, ray.direction, capsule.radius);
        if (!ball.empty()) first = std::min(first, ball.low);
    }
    if (first == kInfinity) return std::nullopt;
    const Vec3 p = from + first * ray.direction;
    return enters(first, (p - std::clamp(p.dot(axis), 0.0, length) * axis).normalized());
}

std::optional<RayHit> first_hit(const CylinderShape& cylinder, const Ray& ray) {
    const Vec3 whole = cylinder.to - cylinder.from;
    const double length = whole.norm();
    const Vec3 axis = whole / length, from = ray.origin - cylinder.from;
    const double climb = ray.direction.dot(axis);
    const Span shaft = through_tube(from, axis, ray.direction, cylinder.radius);
    const Span slab = through_slab(from.dot(axis), climb, length);
    const Span inside = shaft.common(slab);
    if (inside.empty()) return std::nullopt;
    if (slab.low > shaft.low) return enters(inside.low, (climb > 0 ? -1 : 1) * axis);
    return enters(inside.low, across(from + inside.low * ray.direction, axis).normalized());
}

std::optional<RayHit> first_hit(const RingShape& ring, const Ray& ray) {
    constexpr int kMostSteps = 1000;
    constexpr double kMet = 1e-13, kNear = 1e-3;
    const double tube = ring.tube_radius;
    const Vec3 from = ray.origin - ring.center;
    const Span flat = through_tube(from, ring.axis, ray.direction, ring.radius + tube)
                          .common(through_slab(from.dot(ring.axis) + tube,
                                               ray.direction.dot(ring.axis), 2 * tube));
    if (flat.empty() || flat.high <= 0) return std::nullopt;
    const RingGap gap(ring, ray);
    double t = std::max(flat.low, 0.0);
    if (gap(0) <= 0) return std::nullopt;  // begins inside
    for (int step = 0; step < kMostSteps && t < flat.high; ++step) {
        const double here = gap(t);
        if (here <= kMet * ring.radius) return enters(t, gap.normal(t));
        if (here < kNear * tube) {  // near enough to be nearly straight: where would it be inside?
            const double slope = (gap(t + here) - here) / here;
            const double beyond = t - 2 * here / std::min(slope, -1e-6);
            if (slope < 0 && gap(beyond) < 0) {
                const double met = bisect(gap, t, beyond);
                return enters(met, gap.normal(met));
            }
        }
        t += here;
    }
    return std::nullopt;
}

std::optional<RayHit> first_hit(const BowlShape& bowl, const Ray& ray) {
    const Vec3 from_center = ray.origin - bowl.center;
    return meets_wall(
        through_sphere(from_center, ray.direction, bowl.radius), ray,
        [&](const Vec3& p) {
            return bowl.is_closed() || bowl.opening.dot(p - bowl.center) <= bowl.rim_height();
        },
        [&](const Vec3& p) { return Vec3((p - bowl.center).normalized()); });
}

std::optional<RayHit> first_hit(const PipeShape& pipe, const Ray& ray) {
    const Vec3 whole = pipe.to - pipe.from;
    const double length = whole.norm(), least = std::cos(0.5 * pipe.angle) * pipe.radius;
    const Vec3 axis = whole / length;
    return meets_wall(
        through_tube(ray.origin - pipe.from, axis, ray.direction, pipe.radius), ray,
        [&](const Vec3& p) {
            const double along = (p - pipe.from).dot(axis);
            return along >= 0 && along <= length &&
                   (pipe.is_tube() || -pipe.opening.dot(p - pipe.from) >= least);
        },
        [&](const Vec3& p) { return Vec3(across(p - pipe.from, axis).normalized()); });
}

std::optional<RayHit> first_hit(const SurfaceShape& shape, const Ray& ray) {
    return std::visit([&](const auto& s) { return first_hit(s, ray); }, shape);
}

}  // namespace carom
