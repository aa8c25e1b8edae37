#include "export/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace carom {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kAround = 28;  ///< corners of a circle: sagitta 0.6 % of the radius

/// Unit vectors across `axis`, so that (first, second, axis) is right-handed.
struct Frame {
    Vec3 first, second, axis;
    explicit Frame(const Vec3& along) : axis(along.normalized()) {
        const Vec3 other = std::abs(axis.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
        second = axis.cross(other).normalized();
        first = second.cross(axis);
    }
    Vec3 turned(double angle) const { return std::cos(angle) * first + std::sin(angle) * second; }
};

struct MeshCorner {
    Vec3 position, normal;
};

/// A sheet of rows and columns of quads; `corner` of the parts of both, 0 ... 1. Its outside is
/// where columns x rows points.
void add_sheet(Mesh& mesh, int rows, int columns,
               const std::function<MeshCorner(double row, double column)>& corner) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i <= rows; ++i)
        for (int k = 0; k <= columns; ++k) {
            const MeshCorner c =
                corner(static_cast<double>(i) / rows, static_cast<double>(k) / columns);
            mesh.positions.push_back(c.position);
            mesh.normals.push_back(c.normal);
        }
    const auto at = [&](int i, int k) {
        return base + static_cast<std::uint32_t>(i * (columns + 1) + k);
    };
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            const std::uint32_t a = at(i, k), b = at(i, k + 1), c = at(i + 1, k + 1),
                                d = at(i + 1, k);
            // At a pole two corners of a quad are one.
            const auto same = [&](std::uint32_t m, std::uint32_t n) {
                return mesh.positions[m].isApprox(mesh.positions[n], 1e-12);
            };
            if (!same(a, b))
                for (const std::uint32_t n : {a, b, c}) mesh.triangles.push_back(n);
            if (!same(c, d))
                for (const std::uint32_t n : {a, c, d}) mesh.triangles.push_back(n);
        }
}

/// Part of a sphere between two angles from the pole of the frame's axis.
void add_cap(Mesh& mesh, const Vec3& center, double radius, const Frame& frame, double from,
             double to) {
    const int rows = std::max(2, static_cast<int>(std::ceil((to - from) / (2 * kPi) * kAround)));
    add_sheet(mesh, rows, kAround, [&](double row, double column) {
        const double polar = to + row * (from - to);
        const Vec3 normal =
            std::cos(polar) * frame.axis + std::sin(polar) * frame.turned(2 * kPi * column);
        return MeshCorner{center + radius * normal, normal};
    });
}

/// The wall around a segment from angle `begin` over `turn` rad.
void add_wall(Mesh& mesh, const Vec3& from, const Vec3& to, double radius, const Frame& frame,
              double begin, double turn) {
    const int columns = std::max(2, static_cast<int>(std::ceil(turn / (2 * kPi) * kAround)));
    add_sheet(mesh, 1, columns, [&](double row, double column) {
        const Vec3 normal = frame.turned(begin + turn * column);
        return MeshCorner{from + row * (to - from) + radius * normal, normal};
    });
}

void add_disc(Mesh& mesh, const Vec3& center, double radius, const Frame& frame) {
    add_sheet(mesh, 1, kAround, [&](double row, double column) {
        return MeshCorner{center + (1 - row) * radius * frame.turned(2 * kPi * column), frame.axis};
    });
}

Mesh box_mesh(const BoxShape& box) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const Vec3 normal = side * Vec3::Unit(axis);
            const Vec3 across = Vec3::Unit((axis + 1) % 3), up = normal.cross(across);
            const Vec3 half = 0.5 * box.size;
            add_sheet(mesh, 1, 1, [&](double row, double column) {
                const Vec3 place = normal + (2 * column - 1) * across + (2 * row - 1) * up;
                return MeshCorner{box.center + box.orientation * place.cwiseProduct(half),
                                  box.orientation * normal};
            });
        }
    return mesh;
}

Mesh plane_mesh(const PlaneShape& plane, const Vec3& middle, double reach) {
    Mesh mesh;
    const Frame frame(plane.normal);
    const Vec3 foot = middle - (plane.normal.dot(middle) - plane.offset_m) * plane.normal;
    add_sheet(mesh, 1, 1, [&](double row, double column) {
        return MeshCorner{
            foot + reach * ((2 * column - 1) * frame.first + (2 * row - 1) * frame.second),
            plane.normal};
    });
    mesh.two_sided = true;
    return mesh;
}

Mesh capsule_mesh(const CapsuleShape& capsule) {
    Mesh mesh;
    const Vec3 along = capsule.to - capsule.from;
    const Frame frame(along.isZero(0) ? Vec3(Vec3::UnitZ()) : along);
    add_wall(mesh, capsule.from, capsule.to, capsule.radius, frame, 0, 2 * kPi);
    add_cap(mesh, capsule.to, capsule.radius, frame, 0, kPi / 2);
    add_cap(mesh, capsule.from, capsule.radius, frame, kPi / 2, kPi);
    return mesh;
}

Mesh cylinder_mesh(const CylinderShape& cylinder) {
    Mesh mesh;
    const Frame frame(cylinder.to - cylinder.from);
    add_wall(mesh, cylinder.from, cylinder.to, cylinder.radius, frame, 0, 2 * kPi);
    add_disc(mesh, cylinder.to, cylinder.radius, frame);
    add_disc(mesh, cylinder.from, cylinder.radius, Frame(-frame.axis));
    return mesh;
}

Mesh ring_mesh(const RingShape& ring) {
    Mesh mesh;
    constexpr int kTube = 10;
    const Frame frame(ring.axis);
    add_sheet(mesh, kTube, 2 * kAround, [&](double row, double column) {
        const Vec3 out = frame.turned(2 * kPi * column);
        const Vec3 normal = std::cos(2 * kPi * row) * out + std::sin(2 * kPi * row) * frame.axis;
        return MeshCorner{ring.center + ring.radius * out + ring.tube_radius * normal, normal};
    });
    return mesh;
}

Mesh bowl_mesh(const BowlShape& bowl) {
    Mesh mesh;
    // From the lowest point up to the rim, seen from outside.
    const double rim = std::acos(std::clamp(-bowl.rim_height() / bowl.radius, -1.0, 1.0));
    add_cap(mesh, bowl.center, bowl.radius, Frame(-bowl.opening), 0, rim);
    mesh.two_sided = true;
    return mesh;
}

Mesh pipe_mesh(const PipeShape& pipe) {
    Mesh mesh;
    Frame frame(pipe.to - pipe.from);
    frame.first = -pipe.opening;
    frame.second = frame.axis.cross(frame.first);
    const double turn = std::min(pipe.angle, 2 * kPi);
    add_wall(mesh, pipe.from, pipe.to, pipe.radius, frame, -turn / 2, turn);
    mesh.two_sided = true;
    return mesh;
}

}  // namespace

Mesh unit_sphere() {
    Mesh mesh;
    constexpr int kRows = kAround / 2;
    add_sheet(mesh, kRows, kAround, [&](double row, double column) {
        const double latitude = kPi * (row - 0.5), longitude = kPi * (2 * column - 1);
        mesh.places.emplace_back(column, 1 - row);
        const Vec3 p(std::cos(latitude) * std::cos(longitude),
                     std::cos(latitude) * std::sin(longitude), std::sin(latitude));
        return MeshCorner{p, p};
    });
    return mesh;
}

Mesh surface_mesh(const SurfaceShape& shape, const Vec3& middle, double reach) {
    return std::visit(PerShape{[&](const PlaneShape& s) { return plane_mesh(s, middle, reach); },
                               [](const BoxShape& s) { return box_mesh(s); },
                               [](const SphereShape& s) {
                                   Mesh mesh;
                                   add_cap(mesh, s.center, s.radius, Frame(Vec3::UnitZ()), 0, kPi);
                                   return mesh;
                               },
                               [](const CapsuleShape& s) { return capsule_mesh(s); },
                               [](const CylinderShape& s) { return cylinder_mesh(s); },
                               [](const RingShape& s) { return ring_mesh(s); },
                               [](const BowlShape& s) { return bowl_mesh(s); },
                               [](const PipeShape& s) { return pipe_mesh(s); }},
                      shape);
}

}  // namespace carom
