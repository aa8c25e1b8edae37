// Static bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/build.h"
#include "scene/looks.h"

namespace carom {

namespace {

/// Shorter directions count as 0: nobody writes them, and dividing by them loses all digits.
constexpr double kShortest = 1e-9;

/// What a shape's keys gave, and whether they are fit for a search for overlaps.
struct ReadShape {
    SurfaceShape shape;
    bool sound = true;
};

ReadShape read_plane(Build& build, const Fields& fields, const Node& node) {
    const Vec3 normal = fields.vec3("normal");
    PlaneShape plane;
    if (normal.norm() < kShortest) {
        const Node* normal_node = fields.find("normal");
        build.report.error(normal_node != nullptr ? *normal_node : node,
                           "the plane's normal has length 0");
        return {plane, false};
    }
    // normal . p = offset holds for the normal as given, so the offset shrinks with its length.
    plane.normal = normal.normalized();
    plane.offset_m = fields.number("offset") / normal.norm();
    return {plane, node.valid};
}

/// About x, then y, then z, the axes fixed: R = Rz Ry Rx.
Quat rotation(const Vec3& degrees) {
    const Vec3 angles = degrees * (std::numbers::pi / 180);
    return Quat(Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) *
                Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
                Eigen::AngleAxisd(angles.x(), Vec3::UnitX()));
}

ReadShape read_box(Build& build, const Fields& fields, const Node& node) {
    BoxShape box;
    box.center = fields.vec3("position");
    if (fields.has("size")) box.size = fields.vec3("size");
    box.orientation = rotation(fields.vec3("rotation_deg"));
    if (const Node* quaternion = fields.find("quaternion")) {
        Eigen::Vector4d wxyz;
        for (int i = 0; i < 4; ++i)
            wxyz[i] = node_number(quaternion->children[static_cast<std::size_t>(i)]);
        if (wxyz.norm() < kShortest) {
            build.report.error(*quaternion, "the box's quaternion has length 0");
            return {box, false};
        }
        wxyz.normalize();
        box.orientation = Quat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    }
    return {box, node.valid};
}

ReadShape read_sphere(const Fields& fields, const Node& node) {
    return {SphereShape{fields.vec3("position"), fields.maybe_number("radius").value_or(1)},
            node.valid};
}

ReadShape read_capsule(Build& build, const Fields& fields, const Node& node) {
    if (!fields.has("from") || !fields.has("to")) return {CapsuleShape{}, false};
    const CapsuleShape capsule{fields.vec3("from"), fields.vec3("to"),
                               fields.maybe_number("radius").value_or(1)};
    if ((capsule.to - capsule.from).norm() < kShortest) {
        build.report.error(*fields.find("to"),
                           "the capsule's 'from' and 'to' are the same point; a sphere is written "
                           "'sphere: {position: [...], radius: ...}'");
        return {capsule, false};
    }
    return {capsule, node.valid};
}

ReadShape read_cylinder(Build& build, const Fields& fields, const Node& node) {
    if (!fields.has("from") || !fields.has("to")) return {CylinderShape{}, false};
    const CylinderShape cylinder{fields.vec3("from"), fields.vec3("to"),
                                 fields.maybe_number("radius").value_or(1)};
    if ((cylinder.to - cylinder.from).norm() < kShortest) {
        build.report.error(*fields.find("to"), "the cylinder's 'from' and 'to' are the same point");
        return {cylinder, false};
    }
    return {cylinder, node.valid};
}

ReadShape read_ring(Build& build, const Fields& fields, const Node& node) {
    RingShape ring{fields.vec3("position"), fields.vec3("axis"),
                   fields.maybe_number("radius").value_or(1),
                   fields.maybe_number("tube_radius").value_or(0.1)};
    if (ring.axis.norm() < kShortest) {
        const Node* axis = fields.find("axis");
        build.report.error(axis != nullptr ? *axis : node, "the ring's axis has length 0");
        return {ring, false};
    }
    ring.axis.normalize();
    if (!node.valid) return {ring, false};
    if (ring.tube_radius >= ring.radius) {
        build.report.error(*fields.find("tube_radius"),
                           "the ring's tube_radius must be below its radius, which is that of the "
                           "tube's middle: else there is no hole");
        return {ring, false};
    }
    return {ring, true};
}

ReadShape read_bowl(Build& build, const Fields& fields, const Node& node) {
    BowlShape bowl;
    bowl.center = fields.vec3("position");
    bowl.radius = fields.maybe_number("radius").value_or(1);
    bowl.opening = fields.vec3("opening");
    bowl.depth = fields.maybe_number("depth").value_or(bowl.radius);
    if (bowl.opening.norm() < kShortest) {
        const Node* opening = fields.find("opening");
        build.report.error(opening != nullptr ? *opening : node, "the bowl's opening has length 0");
        return {bowl, false};
    }
    bowl.opening.normalize();
    if (!node.valid) return {bowl, false};
    if (bowl.depth > 2 * bowl.radius) {
        build.report.error(*fields.find("depth"),
                           "the bowl's depth must be at most twice its radius");
        return {bowl, false};
    }
    return {bowl, true};
}

ReadShape read_pipe(Build& build, const Fields& fields, const Node& node) {
    if (!fields.has("from") || !fields.has("to")) return {PipeShape{}, false};
    PipeShape pipe;
    pipe.from = fields.vec3("from");
    pipe.to = fields.vec3("to");
    pipe.radius = fields.maybe_number("radius").value_or(1);
    const double degrees = fields.number("angle_deg");
    // Any tube is all of it, whatever pi times 2 is rounded to.
    pipe.angle = degrees >= 360 ? 7 : degrees * (std::numbers::pi / 180);
    const Vec3 axis = pipe.to - pipe.from;
    if (axis.norm() < kShortest) {
        build.report.error(*fields.find("to"), "the pipe's 'from' and 'to' are the same point");
        return {pipe, false};
    }
    const Vec3 opening = fields.vec3("opening"), along = axis.normalized();
    const Vec3 across = opening - along.dot(opening) * along;
    if (across.norm() >= kShortest * std::max(1.0, opening.norm())) {
        pipe.opening = across.normalized();
    } else if (pipe.is_tube()) {
        pipe.opening = along.unitOrthogonal();
    } else {
        const Node* given = fields.find("opening");
        build.report.error(given != nullptr ? *given : node,
                           "the pipe's opening must not lie along its axis");
        return {pipe, false};
    }
    return {pipe, node.valid};
}

ReadShape read_shape(Build& build, const Node& surface) {
    const Fields fields = build.fields(Section::kSurface, &surface);
    if (const Node* node = surface.find("plane"))
        return read_plane(build, fields.child("plane"), *node);
    if (const Node* node = surface.find("box")) return read_box(build, fields.child("box"), *node);
    if (const Node* node = surface.find("sphere"))
        return read_sphere(fields.child("sphere"), *node);
    if (const Node* node = surface.find("capsule"))
        return read_capsule(build, fields.child("capsule"), *node);
    if (const Node* node = surface.find("cylinder"))
        return read_cylinder(build, fields.child("cylinder"), *node);
    if (const Node* node = surface.find("ring"))
        return read_ring(build, fields.child("ring"), *node);
    if (const Node* node = surface.find("bowl"))
        return read_bowl(build, fields.child("bowl"), *node);
    if (const Node* node = surface.find("pipe"))
        return read_pipe(build, fields.child("pipe"), *node);
    return {PlaneShape{}, false};
}

}  // namespace

void build_surfaces(Build& build) {
    for (const Node& node : build.entries("surfaces")) {
        if (node.kind != Node::Kind::kMap) continue;
        const Fields fields = build.fields(Section::kSurface, &node);
        const ReadShape read = read_shape(build, node);
        Surface surface;
        surface.name = fields.maybe_word("name").value_or("");
        surface.shape = read.shape;
        surface.mark = node.mark;
        if (const Node* material = fields.find("material"))
            surface.material = resolve_material(build, *material);
        const Node* look = fields.find("look");
        surface.look = look == nullptr ? -1 : resolve_look(build, *look);
        if (surface.look < 0)
            surface.look = is_unbounded(surface.shape)
                               ? default_look(build, "planes", default_plane_look())
                               : default_look(build, "solids", default_solid_look());
        build.scene.surfaces.push_back(std::move(surface));
        build.surface_origins.push_back({&node, read.sound});
    }
}

}  // namespace carom
