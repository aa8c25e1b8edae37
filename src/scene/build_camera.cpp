// The camera, after the balls, one of which it may follow.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/build.h"

namespace carom {

namespace {

/// A view must have a direction, and one that is not `up`. Reports at `to` and `up`.
void check_view(Build& build, const Vec3& from, const Vec3& to, const Vec3& up_vector,
                const Node& to_node, const Node& up_node, bool up_from_file) {
    constexpr double kShortest = 1e-9;  // m; shorter counts as 0
    constexpr double kParallel = 1e-6;  // rad; below it the horizon is rounding noise
    const Vec3 view = to - from;
    const Vec3 up = up_vector.normalized();
    if (view.norm() < kShortest)
        build.report.error(to_node, "the camera's 'from' and 'to' are the same point");
    else if (up_vector.norm() < kShortest)
        build.report.error(up_node, "the camera's 'up' has length 0");
    else if (view.normalized().cross(up).norm() < kParallel)
        build.report.error(up_node, fmt::format("the camera looks along 'up' ({}); give it another "
                                                "'up', such as [0, 1, 0]",
                                                up_from_file ? "from the file" : "[0, 0, 1]"));
}

void build_path(Build& build, const Fields& fields, Camera& camera) {
    const Node& path = *fields.find("path");
    const Node* up = fields.find("up");
    if (path.children.empty()) build.report.error(path, "the camera's path has no entries");
    for (const Node& entry : path.children) {
        const Fields key = build.fields(Section::kCameraKey, &entry);
        if (!key.has("time") || !key.has("from") || !key.has("to")) continue;
        CameraKey made{key.number("time"), key.vec3("from"), key.vec3("to"),
                       key.maybe_number("fov_deg").value_or(camera.fov_deg)};
        if (!camera.path.empty() && made.time <= camera.path.back().time)
            build.report.error(*key.find("time"), "the times of a camera's path must increase");
        if (camera.orthographic_m && key.has("fov_deg"))
            build.report.error(*key.find("fov_deg"),
                               "parallel rays ('orthographic') have no field of view");
        check_view(build, made.from, made.to, camera.up, *key.find("to"), up ? *up : entry,
                   up != nullptr);
        camera.path.push_back(made);
    }
    if (camera.path.empty()) return;
    camera.from = camera.path.front().from;
    camera.to = camera.path.front().to;
    camera.fov_deg = camera.path.front().fov_deg;
}

}  // namespace

void build_camera(Build& build) {
    const Node* node = build.root.find("camera");
    if (node == nullptr || node->kind != Node::Kind::kMap) return;
    const Fields fields = build.top().child("camera");
    const bool has_path = fields.has("path");
    if (!has_path && (!fields.has("from") || !fields.has("to"))) return;  // reported already
    Camera camera;
    camera.up = fields.vec3("up");
    camera.fov_deg = fields.number("fov_deg");
    constexpr double kHalfFilm_mm = 12;  // 35 mm film is 24 mm high
    if (const auto focal_mm = fields.maybe_number("focal_mm"))
        camera.fov_deg = 360 / std::numbers::pi * std::atan(kHalfFilm_mm / *focal_mm);
    camera.orthographic_m = fields.maybe_number("orthographic");
    camera.orbit_deg_per_s = fields.number("orbit_deg_per_s");
    camera.smooth_s = fields.number("smooth_s");
    if (const Node* ball = fields.find("follow")) {
        if (const int index = resolve_ball(build, *ball); index >= 0) camera.follow = index;
    } else if (camera.smooth_s > 0) {
        build.report.error(*fields.find("smooth_s"),
                           "'smooth_s' smooths what 'follow' follows, which is not given");
    }
    if (has_path) {
        build_path(build, fields, camera);
    } else {
        camera.from = fields.vec3("from");
        camera.to = fields.vec3("to");
        const Node* up = fields.find("up");
        check_view(build, camera.from, camera.to, camera.up, *fields.find("to"), up ? *up : *node,
                   up != nullptr);
    }
    build.scene.camera = camera;
}

}  // namespace carom
