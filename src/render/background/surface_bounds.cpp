#include "render/background/surface_bounds.h"

#include <array>
#include <cmath>

#include "render/tile/screen_tiles.h"

namespace carom {

namespace {

/// The eight sums of +- the three edges.
std::vector<Vec3> cube_corners(const Vec3& middle, const Vec3& a, const Vec3& b, const Vec3& c) {
    std::vector<Vec3> corners;
    for (const double i : {-1.0, 1.0})
        for (const double j : {-1.0, 1.0})
            for (const double k : {-1.0, 1.0}) corners.push_back(middle + i * a + j * b + k * c);
    return corners;
}

SurfaceBound box_bound(const SurfaceTable& table, int record) {
    SurfaceBound bound;
    bound.box = true;
    bound.center = table.at(record, 0).head<3>();
    bound.radius = table.at(record, 0).w();
    std::array<double, 3> half{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Eigen::Vector4d row = table.at(record, 1 + static_cast<int>(axis));
        bound.axes[axis] = row.head<3>();
        half[axis] = row.w();
    }
    bound.cores = cube_corners(bound.center, half[0] * bound.axes[0], half[1] * bound.axes[1],
                               half[2] * bound.axes[2]);
    bound.mirrors = table.at(record, 6).x() > 0;
    return bound;
}

SurfaceBound round_bound(const Vec3& from, const Vec3& to, double radius) {
    SurfaceBound bound;
    bound.cores = {from};
    if (to != from) bound.cores.push_back(to);
    bound.axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    bound.thick = radius;
    bound.center = 0.5 * (from + to);
    bound.radius = 0.5 * (to - from).norm() + radius;
    return bound;
}

/// A cylinder within eight sides along its shaft.
SurfaceBound cylinder_bound(const Vec3& from, const Vec3& along, double radius) {
    SurfaceBound bound;
    const Vec3 u = along.unitOrthogonal() * radius, v = along.normalized().cross(u);
    for (const Vec3& end : {from, Vec3(from + along)})
        for (const Vec3& p : octagon_around(end, u, v)) bound.cores.push_back(p);
    bound.axes = {u.normalized(), v.normalized(), along.normalized()};
    bound.center = from + 0.5 * along;
    bound.radius = std::hypot(0.5 * along.norm(), radius);
    return bound;
}

/// A ring within a circle of eight sides.
SurfaceBound ring_bound(const Vec3& center, const Vec3& axis, double radius, double tube) {
    SurfaceBound bound;
    const Vec3 u = axis.unitOrthogonal() * radius, v = axis.cross(u);
    const std::array<Vec3, 8> octagon = octagon_around(center, u, v);
    bound.cores.assign(octagon.begin(), octagon.end());
    bound.axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    bound.thick = tube;
    bound.center = center;
    bound.radius = radius + tube;
    return bound;
}

/// A bowl within a box along its opening.
SurfaceBound bowl_bound(const Vec3& center, const Vec3& opening, double radius,
                        const Eigen::Vector4d& rim) {
    const double wide = rim.x() >= 0 ? radius : rim.y(), half = 0.5 * (rim.x() + radius);
    SurfaceBound bound;
    const Vec3 u = opening.unitOrthogonal(), v = opening.cross(u);
    bound.cores =
        cube_corners(center + (rim.x() - half) * opening, wide * u, wide * v, half * opening);
    bound.axes = {u, v, opening};
    bound.center = center;
    bound.radius = radius;
    bound.shades_itself = true;
    return bound;
}

SurfaceBound other_bound(const SurfaceTable& table, int record) {
    const Eigen::Vector4d end = table.at(record, 0), way = table.at(record, 1);
    const Vec3 from = end.head<3>(), along = way.head<3>();
    switch (static_cast<OtherKind>(std::lround(way.w()))) {
        case OtherKind::kCylinder:
            return cylinder_bound(from, along, end.w());
        case OtherKind::kRing:
            return ring_bound(from, along, end.w(), table.at(record, 2).x());
        case OtherKind::kBowl:
            return bowl_bound(from, along, end.w(), table.at(record, 2));
        case OtherKind::kPipe: {
            SurfaceBound bound = cylinder_bound(from, along, end.w());
            bound.shades_itself = true;
            return bound;
        }
        case OtherKind::kCapsule:
            break;
    }
    return round_bound(from, from + along, end.w());
}

}  // namespace

std::vector<Vec3> SurfaceBound::corners(double around) const {
    const double r = thick + around;
    if (!(r > 0)) return cores;
    std::vector<Vec3> points;
    for (const Vec3& core : cores)
        for (const Vec3& corner : cube_corners(core, r * axes[0], r * axes[1], r * axes[2]))
            points.push_back(corner);
    return points;
}

std::vector<SurfaceBound> surface_bounds(const SurfaceTable& table) {
    std::vector<SurfaceBound> bounds;
    int record = table.planes;
    for (int i = 0; i < table.boxes; ++i) bounds.push_back(box_bound(table, record++));
    for (int i = 0; i < table.spheres; ++i, ++record) {
        const Eigen::Vector4d sphere = table.at(record, 0);
        bounds.push_back(round_bound(sphere.head<3>(), sphere.head<3>(), sphere.w()));
    }
    for (int i = 0; i < table.others; ++i) bounds.push_back(other_bound(table, record++));
    return bounds;
}

}  // namespace carom
