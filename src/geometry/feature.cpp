#include "geometry/feature.h"

#include "geometry/feature_side.h"

namespace carom {

namespace {

Mat3 across_axis(const Vec3& axis) { return Mat3::Identity() - axis * axis.transpose(); }

Feature feature_of(const PlaneShape& plane, const CenterMotion&, double radius) {
    Feature f;
    f.origin = plane.offset_m * plane.normal;
    f.across = plane.normal * plane.normal.transpose();
    f.distance = radius;
    return f;
}

Feature feature_of(const SphereShape& sphere, const CenterMotion&, double radius) {
    Feature f;
    f.origin = sphere.center;
    f.distance = radius + sphere.radius;
    return f;
}

Feature feature_of(const CapsuleShape& capsule, const CenterMotion& center, double radius) {
    Feature f;
    const Vec3 d = capsule.to - capsule.from;
    const Vec3 axis = d.normalized();
    const double half = 0.5 * d.norm(), along = axis.dot(center.x - capsule.from);
    const double border = kBorder * (center.x.cwiseAbs().maxCoeff() + radius);
    const int side = side_of({along - half, axis.dot(center.v), axis.dot(center.pull)}, half,
                             border, center.v.norm());
    f.distance = radius + capsule.radius;
    if (side < 0) {
        f.origin = capsule.from;
        f.add_border(-axis, -axis.dot(capsule.from));
    } else if (side > 0) {
        f.origin = capsule.to;
        f.add_border(axis, axis.dot(capsule.to));
    } else {
        f.origin = capsule.from;
        f.across = across_axis(axis);
        f.add_border(axis, axis.dot(capsule.from));
        f.add_border(-axis, -axis.dot(capsule.to));
    }
    return f;
}

Feature feature_of(const BoxShape& box, const CenterMotion& center, double radius) {
    Feature f;
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    const double border = kBorder * (center.x.cwiseAbs().maxCoeff() + radius);
    const double speed = center.v.norm();
    f.origin = box.center;
    f.across = Mat3::Zero();
    f.distance = radius;
    for (int i = 0; i < 3; ++i) {
        const Vec3 axis = world_from_box.col(i);
        const double place = axis.dot(center.x - box.center), half = 0.5 * box.size[i];
        const double middle = axis.dot(box.center);
        const int sign =
            side_of({place, axis.dot(center.v), axis.dot(center.pull)}, half, border, speed);
        if (sign != 0) {
            f.origin += (sign * half) * axis;
            f.across += axis * axis.transpose();
            f.add_border(sign * axis, sign * middle + half);
        } else {
            f.add_border(axis, middle - half);
            f.add_border(-axis, -middle - half);
        }
    }
    // Through rounding all three may look inside; then the face that is nearest is the one.
    if (f.across.isZero(0)) {
        Vec3 place = box.orientation.conjugate() * (center.x - box.center);
        int nearest = 0;
        (place.cwiseAbs() - 0.5 * box.size).maxCoeff(&nearest);
        const Vec3 normal = (place[nearest] < 0 ? -1.0 : 1.0) * world_from_box.col(nearest);
        f.origin += 0.5 * box.size[nearest] * normal;
        f.across = normal * normal.transpose();
    }
    return f;
}

bool has_flat(const PlaneShape&, const Vec3&) { return true; }
bool has_flat(const SphereShape&, const Vec3&) { return false; }
bool has_flat(const CapsuleShape&, const Vec3&) { return false; }
bool has_flat(const BoxShape& box, const Vec3& normal) {
    const Vec3 local = box.orientation.conjugate() * normal;
    return local.cwiseAbs().maxCoeff() > 1 - 1e-12;
}

}  // namespace

Feature feature_at(const SurfaceShape& shape, const CenterMotion& center, double radius) {
    return std::visit([&](const auto& s) { return feature_of(s, center, radius); }, shape);
}

bool is_flat(const SurfaceShape& shape, const Vec3& normal) {
    return std::visit([&](const auto& s) { return has_flat(s, normal); }, shape);
}

}  // namespace carom
