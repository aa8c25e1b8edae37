#include "render/surface_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/lights.h"

namespace carom {

namespace {

using Record = std::array<float, 4 * kSurfaceVec4s>;

void put(Record& record, int slot, const Vec3& xyz, double w) {
    for (int i = 0; i < 3; ++i)
        record[static_cast<std::size_t>(4 * slot + i)] = static_cast<float>(xyz[i]);
    record[static_cast<std::size_t>(4 * slot + 3)] = static_cast<float>(w);
}

Vec3 linear(const Color& c) {
    return {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
}

void put_look(Record& record, const Look& look) {
    const double style =
        look.style == LookStyle::kChecker ? 1.0 : (look.style == LookStyle::kGrid ? 2.0 : 0.0);
    put(record, 4, linear(look.color), style);
    put(record, 5, linear(look.second_color), look.tile_m);
}

/// Pattern axes in the plane; for a floor they are the world's x and y.
void put_pattern(Record& record, const PlaneShape& plane, double tile, const View& view) {
    Vec3 u = Vec3::UnitX() - plane.normal * plane.normal.x();
    if (u.norm() < 0.5) u = Vec3::UnitY() - plane.normal * plane.normal.y();
    u.normalize();
    const Vec3 v = plane.normal.cross(u);
    const double period = 2.0 * tile;
    put(record, 6, view_direction(view, u), std::fmod(view.eye().dot(u), period));
    put(record, 7, view_direction(view, v), std::fmod(view.eye().dot(v), period));
}

Record plane_record(const PlaneShape& plane, const Look& look, const View& view) {
    Record record{};
    put(record, 0, view_direction(view, plane.normal),
        plane.offset_m - plane.normal.dot(view.eye()));
    put_pattern(record, plane, look.tile_m, view);
    return record;
}

Record box_record(const BoxShape& box, const View& view) {
    Record record{};
    put(record, 0, view_point(view, box.center), 0.5 * box.size.norm());
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    for (int axis = 0; axis < 3; ++axis)
        put(record, 1 + axis, view_direction(view, world_from_box.col(axis)), 0.5 * box.size[axis]);
    return record;
}

/// Records of one kind of shape, in the scene's order; returns how many.
template <class Shape, class Make>
int append(const Scene& scene, std::vector<float>& out, const Make& make) {
    int count = 0;
    for (const Surface& surface : scene.surfaces) {
        const Shape* shape = std::get_if<Shape>(&surface.shape);
        if (shape == nullptr) continue;
        const Look& look = scene.looks.at(static_cast<std::size_t>(surface.look));
        Record record{};
        if (!make(*shape, look, record)) continue;
        put_look(record, look);
        out.insert(out.end(), record.begin(), record.end());
        ++count;
    }
    return count;
}

}  // namespace

bool seen_from_front(const PlaneShape& plane, const View& view) {
    // Parallel rays see a plane from the side that they come from; edge-on, the ground that it
    // cuts.
    constexpr double kEdgeOn = 1e-7;  // cosine; surfaces.glsl has the same
    if (view.orthographic()) return plane.normal.dot(view.forward()) < kEdgeOn;
    return plane.normal.dot(view.eye()) > plane.offset_m;
}

SurfaceTable make_surface_table(const Scene& scene, const View& view) {
    SurfaceTable table;
    table.planes = append<PlaneShape>(
        scene, table.vec4s, [&](const PlaneShape& plane, const Look& look, Record& record) {
            if (!seen_from_front(plane, view)) return false;
            record = plane_record(plane, look, view);
            return true;
        });
    table.boxes =
        append<BoxShape>(scene, table.vec4s, [&](const BoxShape& box, const Look&, Record& record) {
            record = box_record(box, view);
            return true;
        });
    table.spheres = append<SphereShape>(
        scene, table.vec4s, [&](const SphereShape& sphere, const Look&, Record& record) {
            put(record, 0, view_point(view, sphere.center), sphere.radius);
            return true;
        });
    table.capsules = append<CapsuleShape>(
        scene, table.vec4s, [&](const CapsuleShape& capsule, const Look&, Record& record) {
            put(record, 0, view_point(view, capsule.from), capsule.radius);
            put(record, 1, view_direction(view, capsule.to - capsule.from), 0);
            return true;
        });
    return table;
}

}  // namespace carom
