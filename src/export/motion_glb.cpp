#include "export/motion_glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "export/gltf_file.h"
#include "export/key_frames.h"
#include "export/mesh.h"
#include "media/png.h"
#include "render/blend/srgb.h"
#include "render/runs/motion_extent.h"
#include "render/texture/ball_texture.h"
#include "render/view/camera.h"
#include "render/view/camera_motion.h"
#include "scene/looks.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

/// An eighth of what is promised of places and half of turns; floats round the rest away.
constexpr double kPlaceTolerance = 1.0 / (1 << 25);
constexpr double kTurnTolerance = 5e-7;  // rad

std::vector<float> as_floats(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
std::vector<float> as_floats(const Eigen::Vector4d& v) {
    std::vector<float> floats;
    for (int i = 0; i < 4; ++i) floats.push_back(static_cast<float>(v[i]));
    return floats;
}
template <class Vector>
void append(std::vector<float>& floats, const Vector& v) {
    for (Eigen::Index i = 0; i < v.size(); ++i) floats.push_back(static_cast<float>(v[i]));
}

Json linear_color(const Color& c) {
    return {static_cast<float>(linear_from_srgb(c.r)), static_cast<float>(linear_from_srgb(c.g)),
            static_cast<float>(linear_from_srgb(c.b)), 1};
}

class MotionGlb {
  public:
    MotionGlb(const Scene& scene, const Motion& motion) : scene_(scene), motion_(motion) {
        const MotionExtent reach(scene, motion);
        box_ = scene.balls.empty() ? Box3(Vec3::Constant(-1), Vec3::Constant(1)) : reach.ball_box();
        // Places count from the middle of all paths, so that floats are as fine as they can be; the
        // middle itself is a float.
        Box3 paths;
        for (const Trajectory& ball : motion.balls)
            for (std::size_t i = 0; i < ball.pieces().size(); ++i) {
                const Piece& piece = ball.pieces()[i];
                const double end =
                    i + 1 < ball.pieces().size() ? ball.pieces()[i + 1].start : motion.duration;
                for (const double t : {piece.start, 0.5 * (piece.start + end), end})
                    paths.extend(piece.position_at(t));
            }
        if (paths.isEmpty()) paths = box_;
        extent_ = std::max(paths.diagonal().norm(), reach.largest_radius());
        origin_ = paths.center().cast<float>().cast<double>();
    }

    std::string bytes(std::string_view version, const std::function<void(double)>& told) {
        Json& out = file_.document;
        out["asset"] = {{"version", "2.0"}, {"generator", fmt::format("carom {}", version)}};
        out["asset"]["extras"] = {{"scene_fingerprint", fmt::format("{:016x}", scene_.fingerprint)},
                                  {"motion_hash", fmt::format("{:016x}", motion_.hash())}};
        out["scene"] = 0;
        out["scenes"] = Json::array({Json{{"nodes", {0}}}});
        if (!scene_.title.empty()) out["scenes"][0]["name"] = scene_.title;
        // glTF has y upwards: (x, y, z) becomes (x, z, -y).
        const Vec3& c = origin_;
        nodes_.push_back(
            {{"name", "z_up"},
             {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, c.x(), c.z(), -c.y(), 1}},
             {"children", Json::array()}});
        add_camera();
        add_surfaces();
        add_balls(told);
        for (std::size_t i = 1; i < nodes_.size(); ++i) nodes_[0]["children"].push_back(i);
        out["nodes"] = nodes_;
        if (!channels_.empty())
            out["animations"] = Json::array(
                {Json{{"name", "motion"}, {"channels", channels_}, {"samplers", samplers_}}});
        return file_.glb();
    }

  private:
    void add_channel(int input, int output, const char* interpolation, const char* path) {
        channels_.push_back(
            {{"sampler", samplers_.size()}, {"target", {{"node", nodes_.size()}, {"path", path}}}});
        Json sampler = {{"input", input}, {"output", output}};
        if (std::string_view(interpolation) != "LINEAR") sampler["interpolation"] = interpolation;
        samplers_.push_back(std::move(sampler));
    }

    /// The accessor of these times; the one before where the times are those of before.
    int times(const std::vector<float>& values) {
        if (last_times_ != values || last_input_ < 0) {
            last_input_ = file_.times(values);
            last_times_ = values;
        }
        return last_input_;
    }

    int material(const Look& look, bool two_sided, bool textured) {
        const std::string key = fmt::format("{}{}{}{}", color_text(look.color),
                                            textured ? color_text(look.second_color) : "",
                                            textured ? style_word(look.style) : "", two_sided);
        const auto known = materials_.find(key);
        if (known != materials_.end()) return known->second;
        Json pbr = {{"metallicFactor", 0}, {"roughnessFactor", 0.7}};
        if (textured) {
            if (!textures_) textures_.emplace();
            const int image = file_.png(encode_png(textures_->draw(look), PngEffort::kSmall));
            file_.document["samplers"] = Json::array({Json{{"wrapT", 33071}}});
            file_.document["textures"].push_back({{"sampler", 0}, {"source", image}});
            pbr["baseColorTexture"] = {{"index", file_.document["textures"].size() - 1}};
        } else {
            pbr["baseColorFactor"] = linear_color(look.color);
        }
        Json json = {{"pbrMetallicRoughness", std::move(pbr)}};
        if (two_sided) json["doubleSided"] = true;
        file_.document["materials"].push_back(std::move(json));
        return materials_[key] = static_cast<int>(file_.document["materials"].size()) - 1;
    }

    const Look& look(int number) const { return scene_.looks[static_cast<std::size_t>(number)]; }

    int mesh(Json primitive) {
        file_.document["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
        return static_cast<int>(file_.document["meshes"].size()) - 1;
    }

    /// The ball's mesh, of radius 1; one for all of a look.
    int ball_mesh(int look_number) {
        const auto known = ball_meshes_.find(look_number);
        if (known != ball_meshes_.end()) return known->second;
        const bool textured = has_markings(look(look_number));
        if (sphere_.is_null()) {
            Mesh sphere = unit_sphere();
            if (std::none_of(scene_.balls.begin(), scene_.balls.end(),
                             [&](const Ball& ball) { return has_markings(look(ball.look)); }))
                sphere.places.clear();
            sphere_ = file_.primitive(sphere);
        }
        Json primitive = sphere_;
        if (!textured) primitive["attributes"].erase("TEXCOORD_0");
        primitive["material"] = material(look(look_number), false, textured);
        return ball_meshes_[look_number] = mesh(std::move(primitive));
    }

    void add_surfaces() {
        for (const Surface& surface : scene_.surfaces) {
            // About its own middle, so that floats are as fine there.
            Mesh shape = surface_mesh(surface.shape, box_.center(), 2 * box_.diagonal().norm() + 1);
            Box3 around;
            for (const Vec3& p : shape.positions) around.extend(p);
            const Vec3 middle = around.center();
            for (Vec3& p : shape.positions) p -= middle;
            Json primitive = file_.primitive(shape);
            primitive["material"] = material(look(surface.look), shape.two_sided, false);
            nodes_.push_back({{"name", surface.name},
                              {"mesh", mesh(std::move(primitive))},
                              {"translation", as_floats(Vec3(middle - origin_))}});
        }
    }

    void add_place(const std::vector<PlaceKey>& keys, Json& node) {
        node["translation"] = as_floats(keys.front().place);
        if (keys.size() == 1) return;
        std::vector<float> at, values;
        for (const PlaceKey& key : keys) {
            at.push_back(key.time);
            append(values, key.rate);
            append(values, key.place);
            append(values, key.rate);
        }
        add_channel(times(at), file_.vectors(values), "CUBICSPLINE", "translation");
    }

    void add_turn(const Trajectory& ball, Json& node) {
        // A linear key has four numbers, a cubic one twelve, and each a time.
        constexpr std::size_t kLinearBytes = 20, kCubicBytes = 52;
        const double duration = motion_.duration;
        std::vector<TurnKey> keys = turn_keys(ball, duration, TurnSplines::kLinear, kTurnTolerance);
        node["rotation"] = as_floats(keys.front().turn);
        if (keys.size() == 1) return;
        bool cubic = false;
        const bool varies = std::any_of(
            ball.pieces().begin(), ball.pieces().end(),
            [](const Piece& piece) { return piece.curve || !piece.spin_rate.isZero(0); });
        if (varies) {
            std::vector<TurnKey> others =
                turn_keys(ball, duration, TurnSplines::kCubic, kTurnTolerance);
            cubic = others.size() * kCubicBytes < keys.size() * kLinearBytes;
            if (cubic) keys = std::move(others);
        }
        std::vector<float> at, values;
        for (const TurnKey& key : keys) {
            at.push_back(key.time);
            if (cubic) append(values, key.rate);
            append(values, key.turn);
            if (cubic) append(values, key.rate);
        }
        add_channel(times(at), file_.quaternions(values), cubic ? "CUBICSPLINE" : "LINEAR",
                    "rotation");
    }

    void add_balls(const std::function<void(double)>& told) {
        for (std::size_t i = 0; i < motion_.balls.size(); ++i) {
            const Ball& ball = scene_.balls[i];
            const auto radius = static_cast<float>(ball.radius);
            Json node = {{"name", ball.name},
                         {"mesh", ball_mesh(ball.look)},
                         {"scale", {radius, radius, radius}}};
            const Trajectory& path = motion_.balls[i];
            add_place(place_keys(path, motion_.duration, origin_, extent_ * kPlaceTolerance), node);
            add_turn(path, node);
            nodes_.push_back(std::move(node));
            if (told) told(static_cast<double>(i + 1) / static_cast<double>(motion_.balls.size()));
        }
    }

    /// Orientation of a camera of glTF, which looks along its -z with its y upwards.
    static Eigen::Vector4d camera_turn(const View& view) {
        Mat3 axes;
        axes << view.right(), view.up(), -view.forward();
        return Quat(axes).normalized().coeffs();
    }

    void add_camera() {
        const Film& film = scene_.film;
        const double aspect = static_cast<double>(film.width_px) / film.height_px;
        const Camera camera = choose_camera(scene_, motion_, aspect);
        const Camera first = camera_at(camera, motion_, 0);
        const View view(first, film.width_px, film.height_px);
        const double far = (first.from - box_.center()).norm() + 10 * box_.diagonal().norm() + 10;
        Json json;
        if (camera.orthographic_m) {
            const double half = 0.5 * *camera.orthographic_m;
            json = {{"type", "orthographic"},
                    {"orthographic",
                     {{"xmag", half * aspect}, {"ymag", half}, {"znear", 0}, {"zfar", far}}}};
        } else {
            json = {{"type", "perspective"},
                    {"perspective",
                     {{"aspectRatio", aspect},
                      {"yfov", first.fov_deg * std::numbers::pi / 180},
                      {"znear", far / 1e5},
                      {"zfar", far}}}};
        }
        file_.document["cameras"] = Json::array({std::move(json)});
        if (camera_moves(camera)) add_camera_motion(camera);
        nodes_.push_back({{"name", "camera"},
                          {"camera", 0},
                          {"translation", as_floats(Vec3(first.from - origin_))},
                          {"rotation", as_floats(camera_turn(view))}});
    }

    /// The one motion that is sampled: a camera has no pieces. Its angle of view stays.
    void add_camera_motion(const Camera& camera) {
        constexpr double kRate = 60, kMostKeys = 20'000;  // 1/s
        const double rate = std::min(kRate, kMostKeys / std::max(1.0, motion_.duration));
        std::vector<float> at, places, turns;
        Eigen::Vector4d last = Eigen::Vector4d::Zero();
        const double last_key = std::ceil(motion_.duration * rate);
        for (double k = 0; k <= last_key; ++k) {
            const double t = std::min(k / rate, motion_.duration);
            if (!at.empty() && static_cast<float>(t) <= at.back()) continue;
            const Camera now = camera_at(camera, motion_, t);
            Eigen::Vector4d turn =
                camera_turn(View(now, scene_.film.width_px, scene_.film.height_px));
            if (turn.dot(last) < 0) turn = -turn;
            last = turn;
            at.push_back(static_cast<float>(t));
            append(places, Vec3(now.from - origin_));
            append(turns, turn);
        }
        if (at.size() < 2) return;
        add_channel(times(at), file_.vectors(places), "LINEAR", "translation");
        add_channel(times(at), file_.quaternions(turns), "LINEAR", "rotation");
    }

    const Scene& scene_;
    const Motion& motion_;
    GltfFile file_;
    Box3 box_;
    Vec3 origin_ = Vec3::Zero();  ///< of all places, m
    double extent_ = 1;           ///< m
    Json nodes_ = Json::array(), channels_ = Json::array(), samplers_ = Json::array();
    std::vector<float> last_times_;
    int last_input_ = -1;
    std::map<std::string, int> materials_;
    std::map<int, int> ball_meshes_;
    Json sphere_;  ///< the primitive of all balls, without a material
    std::optional<BallTextures> textures_;
};

}  // namespace

std::string motion_glb(const Scene& scene, const Motion& motion, std::string_view version,
                       const std::function<void(double part)>& told) {
    return MotionGlb(scene, motion).bytes(version, told);
}

}  // namespace carom
