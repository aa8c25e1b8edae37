#include "export/scene_json.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/view/camera.h"
#include "render/view/camera_motion.h"
#include "scene/looks.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

Json shape_json(const SurfaceShape& shape) {
    const auto of = [](const char* name, Json values) { return Json{{name, std::move(values)}}; };
    return std::visit(
        PerShape{
            [&](const PlaneShape& s) {
                return of("plane", {{"normal", vector_json(s.normal)}, {"offset", s.offset_m}});
            },
            [&](const BoxShape& s) {
                const Quat& q = s.orientation;
                return of("box", {{"position", vector_json(s.center)},
                                  {"size", vector_json(s.size)},
                                  {"quaternion", {q.w(), q.x(), q.y(), q.z()}}});
            },
            [&](const SphereShape& s) {
                return of("sphere", {{"position", vector_json(s.center)}, {"radius", s.radius}});
            },
            [&](const CapsuleShape& s) {
                return of("capsule", {{"from", vector_json(s.from)},
                                      {"to", vector_json(s.to)},
                                      {"radius", s.radius}});
            },
            [&](const CylinderShape& s) {
                return of("cylinder", {{"from", vector_json(s.from)},
                                       {"to", vector_json(s.to)},
                                       {"radius", s.radius}});
            },
            [&](const RingShape& s) {
                return of("ring", {{"position", vector_json(s.center)},
                                   {"axis", vector_json(s.axis)},
                                   {"radius", s.radius},
                                   {"tube_radius", s.tube_radius}});
            },
            [&](const BowlShape& s) {
                return of("bowl", {{"position", vector_json(s.center)},
                                   {"radius", s.radius},
                                   {"opening", vector_json(s.opening)},
                                   {"depth", s.depth}});
            },
            [&](const PipeShape& s) {
                return of("pipe", {{"from", vector_json(s.from)},
                                   {"to", vector_json(s.to)},
                                   {"radius", s.radius},
                                   {"opening", vector_json(s.opening)},
                                   {"angle_deg", s.angle * 180 / std::numbers::pi}});
            }},
        shape);
}

/// Rows of from, to and fov_deg: kRate a second, fewer where that makes more than kMostKeys.
void add_keys(const Camera& camera, const Motion& motion, Json& json) {
    constexpr double kRate = 60, kMostKeys = 20'000;
    const double rate = std::min(kRate, kMostKeys / std::max(motion.duration, 1.0));
    json["rate"] = rate;
    Json& keys = json["keys"] = Json::array();
    const auto last = static_cast<std::int64_t>(std::ceil(motion.duration * rate));
    for (std::int64_t k = 0; k <= last; ++k) {
        const double t = std::min(static_cast<double>(k) / rate, motion.duration);
        const Camera at = camera_at(camera, motion, t);
        keys.push_back(
            {at.from.x(), at.from.y(), at.from.z(), at.to.x(), at.to.y(), at.to.z(), at.fov_deg});
    }
}

}  // namespace

Json vector_json(const Vec3& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }

Json camera_json(const Scene& scene, const Motion& motion) {
    const double aspect = static_cast<double>(scene.film.width_px) / scene.film.height_px;
    const Camera camera = choose_camera(scene, motion, aspect);
    const Camera first = camera_at(camera, motion, 0);
    Json json = {{"from", vector_json(first.from)},
                 {"to", vector_json(first.to)},
                 {"up", vector_json(first.up)}};
    if (camera.orthographic_m)
        json["height"] = *camera.orthographic_m;
    else
        json["fov_deg"] = first.fov_deg;
    json["aspect"] = aspect;
    if (camera_moves(camera)) add_keys(camera, motion, json);
    return json;
}

Json look_json(const Look& look) {
    return {{"style", style_word(look.style)},
            {"color", color_text(look.color)},
            {"second_color", color_text(look.second_color)}};
}

Json surfaces_json(const Scene& scene) {
    Json surfaces = Json::array();
    for (const Surface& surface : scene.surfaces) {
        Json json = {{"name", surface.name}};
        json.update(shape_json(surface.shape));
        const Look& look = scene.looks[static_cast<std::size_t>(surface.look)];
        json["look"] = look_json(look);
        if (look.style >= LookStyle::kChecker) json["look"]["tile"] = look.tile_m;
        surfaces.push_back(std::move(json));
    }
    return surfaces;
}

}  // namespace carom
