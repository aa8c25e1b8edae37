#include "transforms.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "draw.h"

namespace carom::bench {

namespace {

SurfaceShape moved(const PlaneShape& plane, const Transform& t) {
    const Vec3 normal = t.linear * plane.normal;
    return PlaneShape{normal, plane.offset_m + normal.dot(t.shift)};
}

SurfaceShape moved(const BoxShape& box, const Transform& t) {
    if (t.linear.isIdentity(0)) return BoxShape{t.place(box.center), box.size, box.orientation};
    Mat3 axes = t.linear * box.orientation.toRotationMatrix();
    if (axes.determinant() < 0) axes.col(0) *= -1;  // which a box does not see
    return BoxShape{t.place(box.center), box.size, Quat(axes).normalized()};
}

SurfaceShape moved(const SphereShape& sphere, const Transform& t) {
    return SphereShape{t.place(sphere.center), sphere.radius};
}

SurfaceShape moved(const CapsuleShape& capsule, const Transform& t) {
    return CapsuleShape{t.place(capsule.from), t.place(capsule.to), capsule.radius};
}

SurfaceShape moved(const CylinderShape& cylinder, const Transform& t) {
    return CylinderShape{t.place(cylinder.from), t.place(cylinder.to), cylinder.radius};
}

SurfaceShape moved(const RingShape& ring, const Transform& t) {
    return RingShape{t.place(ring.center), t.linear * ring.axis, ring.radius, ring.tube_radius};
}

SurfaceShape moved(const BowlShape& bowl, const Transform& t) {
    return BowlShape{t.place(bowl.center), bowl.radius, t.linear * bowl.opening, bowl.depth};
}

SurfaceShape moved(const PipeShape& pipe, const Transform& t) {
    return PipeShape{t.place(pipe.from), t.place(pipe.to), pipe.radius, t.linear * pipe.opening,
                     pipe.angle};
}

/// Changes last digits.
class Nudge {
  public:
    Nudge(double far, std::uint64_t seed) : far_(far), draw_(seed) {}

    double number(double x, double least) {
        const double size = std::max(std::abs(x), least);
        const double unit = std::nextafter(size, INFINITY) - size;
        return size == 0 ? x : x + draw_.integer(-1, 1) * unit;
    }
    Vec3 vector(const Vec3& v) {
        const double x = number(v.x(), 0), y = number(v.y(), 0);
        return {x, y, number(v.z(), 0)};
    }
    Vec3 place(const Vec3& p) {
        const double x = number(p.x(), far_), y = number(p.y(), far_);
        return {x, y, number(p.z(), far_)};
    }

    SurfaceShape shape(const PlaneShape& plane) {
        return PlaneShape{vector(plane.normal).normalized(), number(plane.offset_m, far_)};
    }
    SurfaceShape shape(const BoxShape& box) {
        Quat q = box.orientation;
        q.coeffs().head<3>() = vector(q.vec());
        q.w() = number(q.w(), 0);
        return BoxShape{place(box.center), box.size, q.normalized()};
    }
    SurfaceShape shape(const SphereShape& sphere) {
        return SphereShape{place(sphere.center), sphere.radius};
    }
    SurfaceShape shape(const CapsuleShape& capsule) {
        const Vec3 from = place(capsule.from);
        return CapsuleShape{from, place(capsule.to), capsule.radius};
    }
    SurfaceShape shape(const CylinderShape& cylinder) {
        const Vec3 from = place(cylinder.from);
        return CylinderShape{from, place(cylinder.to), cylinder.radius};
    }
    SurfaceShape shape(const RingShape& ring) {
        const Vec3 center = place(ring.center);
        return RingShape{center, vector(ring.axis).normalized(), ring.radius, ring.tube_radius};
    }
    SurfaceShape shape(const BowlShape& bowl) {
        const Vec3 center = place(bowl.center);
        return BowlShape{center, bowl.radius, vector(bowl.opening).normalized(), bowl.depth};
    }
    SurfaceShape shape(const PipeShape& pipe) {
        const Vec3 from = place(pipe.from), to = place(pipe.to);
        return PipeShape{from, to, pipe.radius, vector(pipe.opening).normalized(), pipe.angle};
    }

  private:
    double far_;
    Draw draw_;
};

}  // namespace

std::vector<Transform> transforms(std::uint64_t seed) {
    Draw draw(seed);
    std::vector<Transform> all;
    for (const double far : {1.0, 1e3, 1e6}) {
        Transform t;
        t.name = fmt::format("moved by {:g} m", far);
        t.shift = far * draw.direction();
        all.push_back(t);
    }
    Transform turned{"turned", draw.rotation().toRotationMatrix(), Vec3::Zero(), false};
    Transform mirrored{"mirrored", Vec3(-1, 1, 1).asDiagonal(), Vec3::Zero(), false};
    Transform reordered{"reordered", Mat3::Identity(), Vec3::Zero(), true};
    all.insert(all.end(), {turned, mirrored, reordered});
    return all;
}

Scene transformed(const Scene& scene, const Transform& t) {
    Scene other = scene;
    other.simulation.gravity = t.linear * scene.simulation.gravity;
    for (Surface& s : other.surfaces)
        s.shape = std::visit([&](const auto& shape) { return moved(shape, t); }, s.shape);
    for (Ball& b : other.balls) {
        b.position = t.place(b.position);
        b.velocity = t.linear * b.velocity;
        b.spin = t.spin(b.spin);
    }
    if (t.reorder) {
        std::reverse(other.balls.begin(), other.balls.end());
        std::reverse(other.surfaces.begin(), other.surfaces.end());
    }
    return other;
}

Scene perturbed(const Scene& scene, double far, std::uint64_t seed) {
    Nudge nudge(far, seed);
    Scene other = scene;
    other.simulation.gravity = nudge.vector(scene.simulation.gravity);
    for (Surface& s : other.surfaces)
        s.shape = std::visit([&](const auto& shape) { return nudge.shape(shape); }, s.shape);
    for (Ball& b : other.balls) {
        b.position = nudge.place(b.position);
        b.velocity = nudge.vector(b.velocity);
        b.spin = nudge.vector(b.spin);
    }
    return other;
}

}  // namespace carom::bench
