// Frames of which only what changed is drawn and converted: the pixels and the samples are those of
// frames that are made from nothing.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "media/frame_converter.h"
#include "render/painter.h"
#include "render/runs/second_run.h"
#include "scene/film_clock.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 180;

/// A film's samples in memory, as an encoder gets them.
class Samples {
  public:
    explicit Samples(PixelFormat format) : converter_(format) {
        for (std::size_t i = 0; i < bytes_.size(); ++i) {
            bytes_[i].resize(std::size_t{8} * kWidth * kHeight);
            planes_.data[i] = bytes_[i].data();
            planes_.stride[i] = std::ptrdiff_t{8} * kWidth;
        }
    }
    void convert(const Image& picture, const ChangedParts& changed) {
        converter_.convert(picture, changed, planes_);
    }
    bool operator==(const Samples& other) const { return bytes_ == other.bytes_; }

  private:
    std::array<std::vector<std::uint8_t>, 4> bytes_;
    FramePlanes planes_;
    FrameConverter converter_;
};

Scene read(const fs::path& path, const std::vector<Override>& overrides = {}) {
    const SceneResult result = read_scene_file(path.string(), overrides);
    EXPECT_TRUE(result.scene) << path;
    return result.scene.value_or(Scene{});
}

/// A second run of the same scene by coarse steps.
SecondRun coarse_run(const Scene& scene, AgainstView view) {
    SecondRun second;
    second.scene = scene;
    second.scene.simulation.method = Method::kFixed;
    second.scene.simulation.step = 0.01;
    second.motion = simulate(second.scene).motion;
    second.ended_s = second.motion.duration;
    second.view = view;
    second.first_name = "exact";
    second.second_name = "fixed";
    return second;
}

class Frames {
  public:
    Frames(const Scene& scene, const Motion& motion, const SecondRun* second)
        : scene_(scene),
          options_{.width_px = kWidth, .height_px = kHeight, .second = second},
          next_(scene, motion, options_),
          anew_(scene, motion, options_) {}

    /// Frames first ... last, one after another, against each by itself.
    void compare(std::int64_t first, std::int64_t last) {
        for (std::int64_t frame = first; frame <= last; ++frame) {
            SCOPED_TRACE(fmt::format("frame {}", frame));
            const double t = frame_time(scene_.film, frame);
            const Image before = picture_;
            const ChangedParts changed = next_.paint_next(t, picture_);
            Image fresh;
            anew_.paint(t, fresh);
            ASSERT_EQ(0, compare_images(fresh, picture_).differing);
            ASSERT_EQ(fresh, picture_);
            Image brought = before;
            copy_parts(picture_, changed, brought);
            ASSERT_EQ(picture_, brought) << "something changed that was not said";
            for (std::size_t i = 0; i < kFormats.size(); ++i) {
                parts_[i].convert(picture_, changed);
                Samples whole(kFormats[i]);
                whole.convert(picture_, {});
                ASSERT_TRUE(parts_[i] == whole) << "format " << i;
            }
            if (changed.is_nothing()) ++equal_;
            for (const PixelRect& part : changed.parts) changed_px_ += part.width() * part.height();
        }
        frames_ += last - first + 1;
    }
    int equal() const { return equal_; }
    /// Of all pixels of the frames, those that were drawn anew.
    double changed_share() const {
        return static_cast<double>(changed_px_) / (static_cast<double>(frames_) * kWidth * kHeight);
    }

  private:
    static constexpr std::array kFormats = {PixelFormat::kYuv420,    PixelFormat::kYuv444,
                                            PixelFormat::kYuv420Ten, PixelFormat::kYuva444Ten,
                                            PixelFormat::kRgb,       PixelFormat::kBgra};
    const Scene& scene_;
    PainterOptions options_;
    Painter next_, anew_;
    Image picture_;
    std::vector<Samples> parts_{kFormats.begin(), kFormats.end()};
    int equal_ = 0;
    std::int64_t frames_ = 0, changed_px_ = 0;
};

std::vector<fs::path> gallery() {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(CAROM_SOURCE_DIR "/scenes/gallery"))
        if (entry.path().extension() == ".yaml") all.push_back(entry.path());
    all.emplace_back(CAROM_SOURCE_DIR "/scenes/figure8.yaml");
    all.emplace_back(CAROM_SOURCE_DIR "/scenes/figure9.yaml");
    std::sort(all.begin(), all.end());
    return all;
}

/// What overlays there are, and what moves on its own.
const std::vector<Override> kEverything = {{"overlay.clock", "true"},    {"overlay.labels", "true"},
                                           {"overlay.trail", "true"},    {"overlay.peaks", "true"},
                                           {"overlay.plot", "true"},     {"overlay.title", "true"},
                                           {"overlay.velocity", "true"}, {"overlay.ruler", "true"}};

TEST(NextFrames, AreThoseOfTheGalleryDrawnFromNothing) {
    for (const fs::path& path : gallery()) {
        SCOPED_TRACE(path);
        const Scene scene = read(path);
        const Motion motion = simulate(scene).motion;
        std::optional<SecondRun> second;
        if (scene.against) second = coarse_run(scene, scene.against->view);
        Frames frames(scene, motion, second ? &*second : nullptr);
        const std::int64_t count = frame_count(scene.film, motion.duration);
        frames.compare(0, 3);
        frames.compare(count / 3, count / 3 + 3);
        frames.compare(count - 3, count - 1);
        frames.compare(count / 4, count / 4 + 1);  // back in time
        fmt::print("{}: {:.2f} of the pixels drawn\n", path.stem().string(),
                   frames.changed_share());
    }
}

TEST(NextFrames, AreThoseWithEverythingOverThem) {
    for (const char* name : {"gallery/reflection", "gallery/motion_blur", "gallery/transparent",
                             "gallery/ball_on_ball", "figure9"}) {
        SCOPED_TRACE(name);
        std::vector<Override> overrides = kEverything;
        overrides.push_back({"film.shutter_deg", "120"});
        const Scene scene = read(fs::path(CAROM_SOURCE_DIR "/scenes") / name += ".yaml", overrides);
        const Motion motion = simulate(scene).motion;
        for (const bool ghosts : {false, true}) {
            std::optional<SecondRun> second;
            if (ghosts) second = coarse_run(scene, AgainstView::kGhost);
            Frames frames(scene, motion, second ? &*second : nullptr);
            const std::int64_t count = frame_count(scene.film, motion.duration);
            frames.compare(count / 2, count / 2 + 4);
        }
    }
}

/// Some balls lie, one rolls by between them: its shadow falls on one, another hides it in part.
constexpr const char* kPassing = R"(
carom: 1
simulation: {duration: 2}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}, look: glossy}]
materials: {clay: {restitution: 0, friction: 1}}
looks: {glossy: {reflection: 0.5}, ball: {style: striped}}
balls:
  - {name: lies, radius: 0.2, material: clay, look: ball, position: [-0.3, 0.3, 0.2]}
  - {name: before, radius: 0.2, material: clay, look: ball, position: [0.3, -0.45, 0.2]}
  - {name: far, radius: 0.2, material: clay, look: ball, position: [1.6, 0.5, 0.2]}
  - {name: rolls, radius: 0.2, material: clay, look: ball, position: [-1.2, -0.14, 0.2],
     velocity: [1, 0, 0], spin: [0, 5, 0]}
camera: {from: [0, -5, 1.5], to: [0.2, 0, 0.2], fov_deg: 30}
)";

// Its background is drawn part by part by short programs, and where nobody looks closely in colours
// alone; that of a camera that stands there for one picture by one program.
TEST(NextFrames, OfACameraThatMovesAreThoseOfOneThatStands) {
    const std::vector<Override> turning = {{"camera.orbit_deg_per_s", "20"}};
    const std::pair<const char*, std::vector<Override>> cases[] = {
        {"gallery/follow", {}},
        {"gallery/camera_path", {}},
        {"figure9", turning},
        {"gallery/incline", turning},
        {"gallery/reflection", turning},
        {"gallery/wood_floor", turning},
        {"gallery/court", turning},
        {"gallery/marble_run", turning},
    };
    for (const auto& [name, overrides] : cases) {
        SCOPED_TRACE(name);
        const Scene scene =
            read(fs::path(CAROM_SOURCE_DIR "/scenes") / (std::string(name) + ".yaml"), overrides);
        const Motion motion = simulate(scene).motion;
        Painter moving(scene, motion, {.width_px = kWidth, .height_px = kHeight});
        ASSERT_TRUE(moving.draws_each_anew());
        Image frame, still;
        for (const double t : {0.3, 0.35, 1.1}) {
            moving.paint_next(t, frame);
            PainterOptions one{.width_px = kWidth, .height_px = kHeight};
            one.few_pictures = true;
            one.only_at = t;
            Painter(scene, motion, one).paint(t, still);
            EXPECT_EQ(still, frame) << t;
        }
    }
}

TEST(NextFrames, LeaveWhatLiesWhereNothingTouchesIt) {
    const SceneResult result = read_scene(kPassing, "passing");
    ASSERT_TRUE(result.scene);
    const Scene& scene = *result.scene;
    const Motion motion = simulate(scene).motion;
    Frames frames(scene, motion, nullptr);
    frames.compare(1, 60);
    fmt::print("{:.3f} of the pixels drawn\n", frames.changed_share());
    EXPECT_LT(frames.changed_share(), 0.35);
    EXPECT_EQ(0, frames.equal());
}

TEST(NextFrames, OfWhatRestsAreNothing) {
    const SceneResult result =
        read_scene(kPassing, "resting",
                   {{"balls.rolls.velocity", "[0, 0, 0]"}, {"balls.rolls.spin", "[0, 0, 0]"}});
    ASSERT_TRUE(result.scene);
    const Motion motion = simulate(*result.scene).motion;
    Frames frames(*result.scene, motion, nullptr);
    frames.compare(0, 9);
    EXPECT_EQ(9, frames.equal());
}

TEST(NextFrames, BeginAnewInAnotherPicture) {
    const SceneResult result = read_scene(kPassing, "passing");
    ASSERT_TRUE(result.scene);
    const Motion motion = simulate(*result.scene).motion;
    Painter painter(*result.scene, motion, {.width_px = kWidth, .height_px = kHeight});
    Image one, other, anew;
    EXPECT_TRUE(painter.paint_next(0.1, one).all);
    EXPECT_FALSE(painter.paint_next(0.2, one).all);
    EXPECT_TRUE(painter.paint_next(0.3, other).all);
    painter.paint(0.3, anew);
    EXPECT_EQ(anew, other);
    painter.paint_next(0.4, other);  // after another way of drawing
    painter.paint(0.4, anew);
    EXPECT_EQ(anew, other);
}

}  // namespace
}  // namespace carom
