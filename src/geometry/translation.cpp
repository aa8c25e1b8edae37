#include "geometry/translation.h"

#include <cmath>

namespace carom {

namespace {

/// offset - normal . origin with one rounding's error (T. Ogita, S. M. Rump, S. Oishi, "Accurate
/// sum and dot product", SIAM J. Sci. Comput. 26, 2005, algorithm Dot2).
double offset_from(const PlaneShape& plane, const Vec3& origin) {
    double sum = plane.offset_m, lost = 0;
    for (int i = 0; i < 3; ++i) {
        const double product = -plane.normal[i] * origin[i];
        const double next = sum + product;
        const double part = next - sum;
        lost += ((sum - (next - part)) + (product - part)) +
                std::fma(-plane.normal[i], origin[i], -product);
        sum = next;
    }
    return sum + lost;
}

SurfaceShape moved(const PlaneShape& plane, const Vec3& origin) {
    return PlaneShape{plane.normal, offset_from(plane, origin)};
}

SurfaceShape moved(const BoxShape& box, const Vec3& origin) {
    return BoxShape{box.center - origin, box.size, box.orientation};
}

SurfaceShape moved(const SphereShape& sphere, const Vec3& origin) {
    return SphereShape{sphere.center - origin, sphere.radius};
}

SurfaceShape moved(const CapsuleShape& capsule, const Vec3& origin) {
    return CapsuleShape{capsule.from - origin, capsule.to - origin, capsule.radius};
}

SurfaceShape moved(const CylinderShape& cylinder, const Vec3& origin) {
    return CylinderShape{cylinder.from - origin, cylinder.to - origin, cylinder.radius};
}

SurfaceShape moved(const RingShape& ring, const Vec3& origin) {
    return RingShape{ring.center - origin, ring.axis, ring.radius, ring.tube_radius};
}

SurfaceShape moved(const BowlShape& bowl, const Vec3& origin) {
    return BowlShape{bowl.center - origin, bowl.radius, bowl.opening, bowl.depth};
}

SurfaceShape moved(const PipeShape& pipe, const Vec3& origin) {
    return PipeShape{pipe.from - origin, pipe.to - origin, pipe.radius, pipe.opening, pipe.angle};
}

}  // namespace

SurfaceShape seen_from(const SurfaceShape& shape, const Vec3& origin) {
    return std::visit([&](const auto& s) { return moved(s, origin); }, shape);
}

}  // namespace carom
