#include "report/layer_index.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "render/view/view_space.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json time_json(const std::optional<double>& time) { return time ? Json(*time) : Json(nullptr); }

/// Pixels of the picture = intrinsics, poses: as cameras have them whose x is to the right, y down
/// and z forward.
Json camera_json(const View& view) {
    Json camera;
    camera["projection"] = view.orthographic() ? "orthographic" : "perspective";
    const double scale = view.pixels_per_metre(1);
    if (view.orthographic()) {
        camera["pixels_per_m"] = scale;
    } else {
        camera["fx"] = scale;
        camera["fy"] = scale;
    }
    camera["cx"] = 0.5 * view.width_px();
    camera["cy"] = 0.5 * view.height_px();
    const Vec3 down = -view.up();
    camera["world_from_camera"] = Json::array();
    for (int row = 0; row < 3; ++row)
        camera["world_from_camera"].push_back(
            {view.right()[row], down[row], view.forward()[row], view.eye()[row]});
    camera["world_from_camera"].push_back({0, 0, 0, 1});
    return camera;
}

Json share_json(const BallShare& share) {
    Json json;
    json["visible_px"] = share.visible_px;
    json["whole_px"] = share.whole_px;
    json["visible_share"] =
        share.whole_px == 0
            ? Json(nullptr)
            : Json(static_cast<double>(share.visible_px) / static_cast<double>(share.whole_px));
    Json columns = Json::array();
    for (const BallShare::Run& run : share.runs) columns.push_back({run.top, run.bottom});
    json["whole"] = {{"left", share.left}, {"columns", std::move(columns)}};
    return json;
}

Json ball_json(const Scene& scene, const Motion& motion, const BallShare& share, std::size_t ball,
               double t) {
    const BallState state = motion.balls[ball].at(t);
    Json json = {{"id", ball + 1}, {"name", scene.balls[ball].name}};
    json["position"] = vector_json(state.position);
    json["orientation"] = {state.orientation.w(), state.orientation.x(), state.orientation.y(),
                           state.orientation.z()};
    json["velocity"] = vector_json(state.velocity);
    json["spin"] = vector_json(state.spin);
    json.update(share_json(share));
    return json;
}

Json kind_json(const LayerKindInfo& info) {
    Json json = {{"file", layer_path("*.png", info)}};
    json["type"] = info.channels.empty() ? "uint16" : "float32";
    if (!info.channels.empty()) {
        json["channels"] = Json::array();
        for (const std::string_view channel : info.channels) json["channels"].push_back(channel);
    }
    if (!info.unit.empty()) json["unit"] = info.unit;
    json["scale"] = 1;
    json["what"] = info.what;
    return json;
}

Json bodies_json(const Scene& scene) {
    Json bodies = Json::array();
    for (const Ball& ball : scene.balls)
        bodies.push_back({{"id", bodies.size() + 1},
                          {"kind", "ball"},
                          {"name", ball.name},
                          {"radius", ball.radius}});
    for (const Surface& surface : scene.surfaces)
        bodies.push_back({{"id", bodies.size() + 1}, {"kind", "surface"}, {"name", surface.name}});
    return bodies;
}

}  // namespace

std::string layer_index_head(const Scene& scene, const LayerSettings& settings) {
    Json head;
    head["size"] = {settings.width_px, settings.height_px};
    head["fps"] = {scene.film.fps.numerator, scene.film.fps.denominator};
    head["scene"] = fmt::format("{:016x}", scene.fingerprint);
    for (const LayerKind kind : settings.kinds) {
        const LayerKindInfo& info = layer_kind_info(kind);
        head["layers"][std::string(info.name)] = kind_json(info);
    }
    head["bodies"] = bodies_json(scene);
    return head.dump(2);
}

std::string layer_index_frame(const Scene& scene, const Motion& motion,
                              const LayerSettings& settings, const LayerPainter& painter,
                              const std::string& picture_path,
                              const std::optional<std::int64_t>& frame,
                              const LayerInstants& instants) {
    const auto name = [](const std::string& path) {
        return std::filesystem::path(path).filename().string();
    };
    Json json;
    if (frame) json["frame"] = *frame;
    json["picture"] = name(picture_path);
    for (const LayerKind kind : settings.kinds) {
        const LayerKindInfo& info = layer_kind_info(kind);
        json["files"][std::string(info.name)] = name(layer_path(picture_path, info));
    }
    json["time"] = instants.time;
    json["next"] = time_json(instants.next);
    json["previous"] = time_json(instants.previous);
    json["camera"] = camera_json(painter.view());
    json["balls"] = Json::array();
    for (std::size_t ball = 0; ball < scene.balls.size(); ++ball)
        json["balls"].push_back(
            ball_json(scene, motion, painter.shares()[ball], ball, instants.time));
    // File names need be no UTF-8, JSON has to be.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string layer_index(const std::string& head, const std::vector<std::string>& frames) {
    std::string text = head.substr(0, head.rfind('\n')) + ",\n  \"frames\": [\n";
    for (std::size_t i = 0; i < frames.size(); ++i)
        text += frames[i] + (i + 1 < frames.size() ? ",\n" : "\n");
    return text + "  ]\n}\n";
}

}  // namespace carom
