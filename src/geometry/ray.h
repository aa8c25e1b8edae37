// Where a ray first meets a shape.
#pragma once

#include <optional>

#include "geometry/shape.h"

namespace carom {

struct Ray {
    Vec3 origin = Vec3::Zero();
    Vec3 direction = Vec3::UnitX();  ///< unit

    Vec3 at(double distance_m) const { return origin + distance_m * direction; }
};

struct RayHit {
    double distance = 0;          ///< m along the ray, above 0
    Vec3 normal = Vec3::UnitZ();  ///< unit, on the side that the ray comes from
};

/// Solid shapes are met where a ray enters them: one that begins inside a convex one does not meet
/// it, and a plane is met from above only. Bowls and pipes are walls, met from both sides. In
/// closed form, to some roundings of the distance and of the shape's size; a ring by steps as long
/// as its distance (J. C. Hart, "Sphere tracing", The Visual Computer 12, 1996), then by bisection,
/// to 1e-12 of these.
std::optional<RayHit> first_hit(const PlaneShape& plane, const Ray& ray);
std::optional<RayHit> first_hit(const BoxShape& box, const Ray& ray);
std::optional<RayHit> first_hit(const SphereShape& sphere, const Ray& ray);
std::optional<RayHit> first_hit(const CapsuleShape& capsule, const Ray& ray);
std::optional<RayHit> first_hit(const CylinderShape& cylinder, const Ray& ray);
std::optional<RayHit> first_hit(const RingShape& ring, const Ray& ray);
std::optional<RayHit> first_hit(const BowlShape& bowl, const Ray& ray);
std::optional<RayHit> first_hit(const PipeShape& pipe, const Ray& ray);
std::optional<RayHit> first_hit(const SurfaceShape& shape, const Ray& ray);

}  // namespace carom
