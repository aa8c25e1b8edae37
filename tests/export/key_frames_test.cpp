// The .glb read back and played by an evaluator of its own, as the specification says, against the
// motion.
#include "export/key_frames.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "export/motion_glb.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {
namespace {

using Json = nlohmann::json;

/// A .glb as its specification describes it (glTF 2.0, 3.11 and appendix C).
class Played {
  public:
    explicit Played(const std::string& glb) {
        std::uint32_t size = 0;
        std::memcpy(&size, glb.data() + 12, 4);
        json = Json::parse(glb.substr(20, size));
        binary_ = glb.substr(20 + size + 8);
    }

    Json json;

    std::vector<float> floats(int accessor) const {
        const Json& a = json["accessors"][std::size_t(accessor)];
        const std::size_t width = a["type"] == "SCALAR" ? 1 : a["type"] == "VEC3" ? 3 : 4;
        std::vector<float> values(a["count"].get<std::size_t>() * width);
        const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
        const std::size_t at =
            view.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
        std::memcpy(values.data(), binary_.data() + at, values.size() * sizeof(float));
        return values;
    }

    /// A property of a node at an instant; empty where nothing animates it.
    std::vector<double> value(std::size_t node, const char* path, double t) const {
        if (!json.contains("animations")) return {};
        const Json& animation = json["animations"][0];
        for (const Json& channel : animation["channels"]) {
            if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
            const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
            return interpolated(sampler, t, std::string(path) == "rotation" ? 4 : 3);
        }
        return {};
    }

    std::size_t node(const std::string& name) const {
        for (std::size_t i = 0; i < json["nodes"].size(); ++i)
            if (json["nodes"][i].value("name", "") == name) return i;
        ADD_FAILURE() << name;
        return 0;
    }

  private:
    std::vector<double> interpolated(const Json& sampler, double t, std::size_t width) const {
        const std::vector<float> times = floats(sampler["input"]);
        const std::vector<float> values = floats(sampler["output"]);
        const bool cubic = sampler.value("interpolation", "LINEAR") == "CUBICSPLINE";
        const auto of = [&](std::size_t key, std::size_t part) {
            std::vector<double> v(width);
            for (std::size_t i = 0; i < width; ++i)
                v[i] = double{values[(cubic ? 3 * key + part : key) * width + i]};
            return v;
        };
        std::size_t k = 0;
        while (k + 2 < times.size() && double{times[k + 1]} <= t) ++k;
        if (t <= double{times[k]}) return of(k, 1);
        if (t >= double{times[k + 1]}) return of(k + 1, 1);
        const double seconds = double{times[k + 1]} - double{times[k]};
        const double u = (t - double{times[k]}) / seconds;
        const std::vector<double> a = of(k, 1), b = of(k + 1, 1);
        std::vector<double> result(width);
        if (cubic) {
            const std::vector<double> out = of(k, 2), in = of(k + 1, 0);
            for (std::size_t i = 0; i < width; ++i)
                result[i] = (2 * u * u * u - 3 * u * u + 1) * a[i] +
                            seconds * (u * u * u - 2 * u * u + u) * out[i] +
                            (3 * u * u - 2 * u * u * u) * b[i] +
                            seconds * (u * u * u - u * u) * in[i];
            return result;
        }
        double dot = 0;
        for (std::size_t i = 0; i < width; ++i) dot += a[i] * b[i];
        // Rotations only: this test's scenes have no linear place.
        const double angle = std::acos(std::min(1.0, std::abs(dot)));
        const double weight_a = angle < 1e-7 ? 1 - u : std::sin((1 - u) * angle) / std::sin(angle);
        const double weight_b =
            (angle < 1e-7 ? u : std::sin(u * angle) / std::sin(angle)) * (dot < 0 ? -1 : 1);
        for (std::size_t i = 0; i < width; ++i) result[i] = weight_a * a[i] + weight_b * b[i];
        return result;
    }

    std::string binary_;
};

struct Worst {
    double place_over_extent = 0, turn = 0, extent = 0, upright = 0;
};

/// At 10^4 instants that are floats, as the file's times are.
Worst worst_of(const Scene& scene, const Motion& motion, const Played& played) {
    Eigen::AlignedBox3d box;
    std::mt19937_64 random(1);
    std::vector<double> instants;
    for (int i = 0; i < 10'000; ++i)
        instants.push_back(double{
            static_cast<float>(motion.duration * double(random() >> 11U) / double(1ULL << 53U))});
    for (const Trajectory& ball : motion.balls)
        for (const double t : instants) box.extend(ball.at(t).position);
    Worst worst;
    worst.extent = box.diagonal().norm();
    const Json& matrix = played.json["nodes"][0]["matrix"];
    for (std::size_t b = 0; b < scene.balls.size(); ++b) {
        const std::size_t node = played.node(scene.balls[b].name);
        const Json& rest = played.json["nodes"][node];
        for (std::size_t n = b; n < instants.size(); n += scene.balls.size()) {
            const double t = instants[n];
            std::vector<double> p = played.value(node, "translation", t);
            if (p.empty()) p = rest["translation"].get<std::vector<double>>();
            // Column-major: y up in the world of glTF.
            Vec3 world;
            for (std::size_t row = 0; row < 3; ++row)
                world[Eigen::Index(row)] =
                    matrix[row].get<double>() * p[0] + matrix[4 + row].get<double>() * p[1] +
                    matrix[8 + row].get<double>() * p[2] + matrix[12 + row].get<double>();
            const BallState state = motion.balls[b].at(t);
            const Vec3 right(state.position.x(), state.position.z(), -state.position.y());
            worst.place_over_extent =
                std::max(worst.place_over_extent, (world - right).norm() / worst.extent);
            std::vector<double> q = played.value(node, "rotation", t);
            if (q.empty()) q = rest["rotation"].get<std::vector<double>>();
            const Quat shown = Quat(q[3], q[0], q[1], q[2]).normalized();
            worst.turn =
                std::max(worst.turn, 2 * (shown * state.orientation.conjugate()).vec().norm());
        }
    }
    return worst;
}

class GlbMotion : public testing::TestWithParam<const char*> {};

TEST_P(GlbMotion, IsTheMotionAtEveryFloat) {
    const std::string path = std::string(CAROM_SOURCE_DIR "/scenes/") + GetParam() + ".yaml";
    SceneResult read = read_scene_file(path, {});
    ASSERT_TRUE(read.scene);
    const SimulationResult result = simulate(*read.scene);
    ASSERT_FALSE(result.motion.events.empty());
    const Played played(motion_glb(*read.scene, result.motion, "test"));
    const Worst worst = worst_of(*read.scene, result.motion, played);
    constexpr double kPlaceBound = 2.0 / (1 << 23), kTurnBound = 1e-6;
    fmt::print("{}: place {:.3g} of the extent of {:.3g} m (bound {:.3g}), turn {:.3g} rad\n",
               GetParam(), worst.place_over_extent, worst.extent, kPlaceBound, worst.turn);
    EXPECT_LE(worst.place_over_extent, kPlaceBound);
    EXPECT_LE(worst.turn, kTurnBound);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GlbMotion,
                         testing::Values("figure8", "figure9", "gallery/friction_and_spin",
                                         "gallery/capsule_rail", "gallery/spin_in_air",
                                         "gallery/marble_run"),
                         [](const auto& scene) {
                             const std::string name = scene.param;
                             return name.substr(name.find('/') + 1);
                         });

TEST(KeyFrames, TwoKeysAFlightAndOneMoreNowhere) {
    SceneResult read = read_scene_file(CAROM_SOURCE_DIR "/scenes/figure8.yaml", {});
    ASSERT_TRUE(read.scene);
    const Motion motion = simulate(*read.scene).motion;
    const std::vector<Piece>& pieces = motion.balls[0].pieces();
    ASSERT_GT(pieces.size(), 5u);
    const auto keys = place_keys(motion.balls[0], motion.duration, Vec3::Zero(), 1e-9);
    EXPECT_EQ(2 * pieces.size(), keys.size());
    for (std::size_t i = 1; i < keys.size(); ++i) EXPECT_LT(keys[i - 1].time, keys[i].time);
}

TEST(KeyFrames, NeighboursAreLessThanHalfATurnApart) {
    Trajectory ball;
    Piece piece;
    piece.spin = Vec3(3, -40, 100);
    ball.append(piece);
    for (const TurnSplines splines : {TurnSplines::kLinear, TurnSplines::kCubic}) {
        const auto keys = turn_keys(ball, 2.5, splines, 5e-7);
        const double turned = piece.spin.norm() * 2.5;
        ASSERT_GT(keys.size(), turned / std::numbers::pi);
        if (splines == TurnSplines::kLinear) {
            EXPECT_LT(keys.size(), 1.06 * turned / std::numbers::pi + 2);
        }
        for (std::size_t i = 1; i < keys.size(); ++i) {
            EXPECT_GT(keys[i - 1].turn.dot(keys[i].turn), 0);
            EXPECT_LT(piece.spin.norm() * (double{keys[i].time} - double{keys[i - 1].time}),
                      std::numbers::pi);
        }
    }
}

TEST(KeyFrames, ABallThatLiesStillHasOneKeyAndNoAnimation) {
    const SceneResult read = read_scene(
        "carom: 1\nsimulation: {duration: 1}\nsurfaces:\n"
        "  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}}\n"
        "balls:\n  - {name: a, radius: 0.5, position: [3, 4, 0.5]}\n",
        "scene.yaml", {});
    ASSERT_TRUE(read.scene);
    const Motion motion = simulate(*read.scene).motion;
    const Played played(motion_glb(*read.scene, motion, "test"));
    EXPECT_FALSE(played.json.contains("animations"));
    EXPECT_EQ((Json{0.5f, 0.5f, 0.5f}), played.json["nodes"][played.node("a")]["scale"]);
}

}  // namespace
}  // namespace carom
