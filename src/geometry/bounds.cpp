#include "geometry/bounds.h"

namespace carom {

namespace {

Box3 around(const PlaneShape&) { return {}; }

Box3 around(const BoxShape& box) {
    const Vec3 half = box.orientation.toRotationMatrix().cwiseAbs() * (0.5 * box.size);
    return {box.center - half, box.center + half};
}

Box3 around(const SphereShape& sphere) {
    const Vec3 r = Vec3::Constant(sphere.radius);
    return {sphere.center - r, sphere.center + r};
}

Box3 around(const CapsuleShape& capsule) {
    const Vec3 r = Vec3::Constant(capsule.radius);
    return {capsule.from.cwiseMin(capsule.to) - r, capsule.from.cwiseMax(capsule.to) + r};
}

}  // namespace

Box3 bounds_of(const SurfaceShape& shape) {
    return std::visit([](const auto& s) { return around(s); }, shape);
}

}  // namespace carom
