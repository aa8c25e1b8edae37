#include "render/background/surface_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "render/blend/srgb.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

using Record = std::array<float, 4 * kSurfaceVec4s>;

void put(Record& record, int slot, const Vec3& xyz, double w) {
    for (int i = 0; i < 3; ++i)
        record[static_cast<std::size_t>(4 * slot + i)] = static_cast<float>(xyz[i]);
    record[static_cast<std::size_t>(4 * slot + 3)] = static_cast<float>(w);
}

/// As surface_patterns.glsl numbers them.
double pattern_number(LookStyle style) {
    switch (style) {
        case LookStyle::kChecker:
            return 1;
        case LookStyle::kGrid:
            return 2;
        case LookStyle::kWood:
            return 3;
        case LookStyle::kCourt:
            return 4;
        default:
            return 0;
    }
}

void put_look(Record& record, const Look& look) {
    put(record, 4, linear_light(look.color), pattern_number(look.style));
    put(record, 5, linear_light(look.second_color), look.tile_m);
}

/// Pattern axes in the plane; for a floor they are the world's x and y.
void put_pattern(Record& record, const PlaneShape& plane, const Look& look, const View& view) {
    Vec3 u = Vec3::UnitX() - plane.normal * plane.normal.x();
    if (u.norm() < 0.5) u = Vec3::UnitY() - plane.normal * plane.normal.y();
    u.normalize();
    const Vec3 v = plane.normal.cross(u);
    const bool repeats = look.style == LookStyle::kChecker || look.style == LookStyle::kGrid;
    const double period = repeats ? 2.0 * look.tile_m : std::numeric_limits<double>::infinity();
    put(record, 6, view_direction(view, u), std::fmod(view.eye().dot(u), period));
    put(record, 7, view_direction(view, v), std::fmod(view.eye().dot(v), period));
}

Record plane_record(const PlaneShape& plane, const Look& look, const View& view) {
    Record record{};
    put(record, 0, view_direction(view, plane.normal),
        plane.offset_m - plane.normal.dot(view.eye()));
    put(record, 1, Vec3(look.reflection, 0, 0), 0);
    put_pattern(record, plane, look, view);
    return record;
}

Record box_record(const BoxShape& box, const Look& look, const View& view) {
    Record record{};
    put(record, 0, view_point(view, box.center), 0.5 * box.size.norm());
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    for (int axis = 0; axis < 3; ++axis)
        put(record, 1 + axis, view_direction(view, world_from_box.col(axis)), 0.5 * box.size[axis]);
    put(record, 6, Vec3(look.reflection, 0, 0), 0);
    put(record, 7, view_direction(view, top_of(box).normal), 0);
    return record;
}

Record sphere_record(const SphereShape& sphere, const View& view) {
    Record record{};
    put(record, 0, view_point(view, sphere.center), sphere.radius);
    return record;
}

Record rod_record(const Vec3& from, const Vec3& to, double radius, OtherKind kind,
                  const View& view) {
    Record record{};
    put(record, 0, view_point(view, from), radius);
    put(record, 1, view_direction(view, to - from), static_cast<double>(kind));
    return record;
}

Record ring_record(const RingShape& ring, const View& view) {
    Record record{};
    put(record, 0, view_point(view, ring.center), ring.radius);
    put(record, 1, view_direction(view, ring.axis), static_cast<double>(OtherKind::kRing));
    put(record, 2, Vec3(ring.tube_radius, 0, 0), 0);
    return record;
}

Record bowl_record(const BowlShape& bowl, const View& view) {
    Record record{};
    put(record, 0, view_point(view, bowl.center), bowl.radius);
    put(record, 1, view_direction(view, bowl.opening), static_cast<double>(OtherKind::kBowl));
    const double rim = bowl.is_closed() ? 0 : bowl.rim_radius();
    put(record, 2, Vec3(bowl.rim_height(), rim, 0), 0);
    return record;
}

Record pipe_record(const PipeShape& pipe, const View& view) {
    Record record = rod_record(pipe.from, pipe.to, pipe.radius, OtherKind::kPipe, view);
    put(record, 2, view_direction(view, pipe.opening),
        pipe.is_tube() ? -2 : std::cos(0.5 * pipe.angle));
    return record;
}

/// The groups of records, in their order.
enum class Group { kPlanes, kBoxes, kSpheres, kOthers };

Group group_of(const SurfaceShape& shape) {
    return std::visit(PerShape{[](const PlaneShape&) { return Group::kPlanes; },
                               [](const BoxShape&) { return Group::kBoxes; },
                               [](const SphereShape&) { return Group::kSpheres; },
                               [](const CapsuleShape&) { return Group::kOthers; },
                               [](const CylinderShape&) { return Group::kOthers; },
                               [](const RingShape&) { return Group::kOthers; },
                               [](const BowlShape&) { return Group::kOthers; },
                               [](const PipeShape&) { return Group::kOthers; }},
                      shape);
}

/// Empty for what this view does not show.
std::optional<Record> record_of(const SurfaceShape& shape, const Look& look, const View& view) {
    using Made = std::optional<Record>;
    return std::visit(
        PerShape{[&](const PlaneShape& plane) {
                     return seen_from_front(plane, view) ? Made(plane_record(plane, look, view))
                                                         : std::nullopt;
                 },
                 [&](const BoxShape& box) { return Made(box_record(box, look, view)); },
                 [&](const SphereShape& sphere) { return Made(sphere_record(sphere, view)); },
                 [&](const CapsuleShape& c) {
                     return Made(rod_record(c.from, c.to, c.radius, OtherKind::kCapsule, view));
                 },
                 [&](const CylinderShape& c) {
                     return Made(rod_record(c.from, c.to, c.radius, OtherKind::kCylinder, view));
                 },
                 [&](const RingShape& ring) { return Made(ring_record(ring, view)); },
                 [&](const BowlShape& bowl) { return Made(bowl_record(bowl, view)); },
                 [&](const PipeShape& pipe) { return Made(pipe_record(pipe, view)); }},
        shape);
}

void note_kind(const SurfaceShape& shape, SurfaceTable& table) {
    std::visit(PerShape{[](const PlaneShape&) {}, [](const BoxShape&) {}, [](const SphereShape&) {},
                        [&](const CapsuleShape&) { table.capsules = true; },
                        [&](const CylinderShape&) { table.cylinders = true; },
                        [&](const RingShape&) { table.rings = true; },
                        [&](const BowlShape&) { table.shells = true; },
                        [&](const PipeShape&) { table.shells = true; }},
               shape);
}

/// Records of one group of shapes, in the scene's order; returns how many.
int append(const Scene& scene, SurfaceTable& table, Group group, const View& view) {
    int count = 0;
    for (const Surface& surface : scene.surfaces) {
        if (group_of(surface.shape) != group) continue;
        const Look& look = scene.looks.at(static_cast<std::size_t>(surface.look));
        // Also of what this view does not show: programs stay the same as the camera moves.
        const bool flat = group == Group::kPlanes || group == Group::kBoxes;
        table.reflection |= flat && look.reflection > 0;
        std::optional<Record> record = record_of(surface.shape, look, view);
        if (!record) continue;
        note_kind(surface.shape, table);
        put_look(*record, look);
        table.checker |= look.style == LookStyle::kChecker;
        table.grid |= look.style == LookStyle::kGrid;
        table.wood |= look.style == LookStyle::kWood;
        table.court |= look.style == LookStyle::kCourt;
        table.vec4s.insert(table.vec4s.end(), record->begin(), record->end());
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

PlaneShape top_of(const BoxShape& box) {
    const Mat3 axes = box.orientation.toRotationMatrix();
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(axes(2, i)) > std::abs(axes(2, axis)) + 1e-9) axis = i;
    PlaneShape top;
    top.normal = axes.col(axis) * (axes(2, axis) < 0 ? -1.0 : 1.0);
    top.offset_m = top.normal.dot(box.center) + 0.5 * box.size[axis];
    return top;
}

SurfaceTable make_surface_table(const Scene& scene, const View& view) {
    SurfaceTable table;
    table.planes = append(scene, table, Group::kPlanes, view);
    table.boxes = append(scene, table, Group::kBoxes, view);
    table.spheres = append(scene, table, Group::kSpheres, view);
    table.others = append(scene, table, Group::kOthers, view);
    return table;
}

}  // namespace carom
