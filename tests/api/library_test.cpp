// The library as its users meet it: include/carom alone.
#include <carom/carom.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;

carom::SceneBuilder small() {
    carom::SceneBuilder builder;
    builder.title("a \"test\": #1").duration(1.5).material("rubber", 0.8);
    builder.plane("floor", {0, 0, 1}, 0);
    builder.ball({.name = "a", .position = {0, 0, 0.6}, .radius = 0.1, .material = "rubber"});
    builder.set("film.size", "[64, 36]").set("film.fps", "10");
    return builder;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Folder {
    fs::path path = fs::temp_directory_path() / ("carom_api_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

TEST(Library, ABuiltSceneIsWhatItsTextSays) {
    const carom::Scene scene = small().build();
    EXPECT_EQ("a \"test\": #1", scene.title());
    EXPECT_EQ(std::vector<std::string>{"a"}, scene.balls());
    EXPECT_EQ(std::vector<std::string>{"floor"}, scene.surfaces());
    EXPECT_EQ((std::pair{64, 36}), scene.size());
    EXPECT_EQ(1.5, scene.duration());
    EXPECT_TRUE(scene.warnings().empty());
    const carom::Scene read = carom::Scene::from_text(small().yaml());
    EXPECT_EQ(carom::simulate(scene).hash(), carom::simulate(read).hash());
}

// Falls h = 0.5 m to the floor; the gap after it is h - g t^2 / 2, and the first peak e^2 h.
TEST(Library, StatesAndPeaksFollowTheClosedForm) {
    const carom::Motion motion = carom::simulate(small().build());
    const double g = 9.81, h = 0.5, fall = std::sqrt(2 * h / g);
    const std::vector<carom::State> states = motion.states({0, 0.1, 0.2, 0.3});
    ASSERT_EQ(4U, states.size());
    for (int k = 0; k < 4; ++k) {
        const double t = 0.1 * k;
        EXPECT_NEAR(0.6 - 0.5 * g * t * t, states[static_cast<std::size_t>(k)].position[2], 1e-14);
        EXPECT_NEAR(-g * t, states[static_cast<std::size_t>(k)].velocity[2], 1e-14);
    }
    EXPECT_NEAR(0.64 * h, motion.peaks(0).at(0).height, 1e-14);
    const carom::Event first = motion.events().at(0);
    EXPECT_NEAR(fall, first.time, 1e-14);
    EXPECT_EQ(carom::EventKind::impact, first.kind);
    EXPECT_NEAR(g * fall, first.approach_speed, 1e-13);
    EXPECT_EQ(motion.states({0.7})[0].position, motion.state(0, 0.7).position);
    EXPECT_THROW(motion.state(0, 1.6), carom::Error);
    EXPECT_THROW(motion.state(1, 0), carom::Error);
    EXPECT_THROW(motion.states({0, std::nan("")}), carom::Error);
}

TEST(Library, MistakesComeAllAtOnceWithTheirPlaces) {
    try {
        carom::Scene::from_text("carom: 1\nbals: []\nsimulation: {duration: long}\n");
        FAIL();
    } catch (const carom::SceneError& error) {
        ASSERT_EQ(2U, error.diagnostics().size());
        const carom::Diagnostic& d = error.diagnostics().front();
        EXPECT_EQ((std::pair{2, 1}), (std::pair{d.line, d.column}));
        EXPECT_NE(std::string::npos, std::string(error.what()).find("did you mean 'balls'?"));
        EXPECT_NE(std::string::npos, d.shown.find("    2 | bals: []\n      | ^~~~\n"));
    }
    EXPECT_THROW(carom::Scene::from_file("/nowhere.yaml"), carom::Error);
    carom::SceneBuilder twice = small();
    twice.ball({.name = "a", .position = {1, 0, 1}});
    EXPECT_THROW(twice.build(), carom::SceneError);
}

TEST(Library, PicturesGoThereAndBackAndAreCompared) {
    const Folder folder;
    const carom::Scene scene = small().build();
    const carom::Motion motion = carom::simulate(scene);
    const carom::Picture a = carom::still(scene, motion, 0), b = carom::still(scene, motion, 0.2);
    ASSERT_EQ((std::pair{64, 36}), (std::pair{a.width, a.height}));
    const std::string path = (folder.path / "a.png").string();
    carom::write_png(path, a);
    EXPECT_EQ(a.rgba, carom::read_png(path).rgba);
    EXPECT_TRUE(carom::same(carom::compare(a, a), 0, 0));
    EXPECT_EQ(1, carom::compare(a, a).ssim);
    const carom::Difference d = carom::compare(a, b);
    EXPECT_FALSE(carom::same(d));
    EXPECT_TRUE(carom::same(d, 255, 1));
    EXPECT_GT(d.differing_pixels, 0);
    EXPECT_THROW(carom::still(scene, motion, -1), carom::Error);
    EXPECT_THROW(carom::compare(a, carom::Picture{3, 3, {}}), carom::Error);
}

TEST(Library, FilmsAreWholeOrNotThere) {
    const Folder folder;
    const carom::Scene scene = small().build();
    const carom::Motion motion = carom::simulate(scene);
    const std::string path = (folder.path / "f.mkv").string();
    double last = 0;
    EXPECT_EQ(15, carom::film(scene, motion, path, {.quality = "draft"},
                              {.progress = [&last](double done) { last = done; }}));
    EXPECT_EQ(15, last);
    const std::string whole = bytes_of(path);
    EXPECT_GT(whole.size(), 500U);
    EXPECT_THROW(carom::film(scene, motion, path), carom::Error);
    EXPECT_EQ(whole, bytes_of(path));
    std::stop_source stop;
    carom::Control control{stop.get_token(), [&stop](double done) {
                               if (done >= 3) stop.request_stop();
                           }};
    EXPECT_THROW(carom::film(scene, motion, path, {.overwrite = true}, control), carom::Stopped);
    EXPECT_EQ(whole, bytes_of(path));
    EXPECT_THROW(
        carom::film(scene, motion, (folder.path / "f_%05d.png").string(), {.quality = "draft"}),
        carom::Error);
    EXPECT_EQ(15, carom::film(scene, motion, (folder.path / "frames").string()));
    EXPECT_EQ(carom::still(scene, motion, 0.5).rgba,
              carom::read_png((folder.path / "frames" / "frame_00005.png").string()).rgba);
}

TEST(Library, TwoRunsAreShownWhereASceneNamesThemOrTheCallerDoes) {
    const carom::Scene plain = small().build();
    const carom::Motion motion = carom::simulate(plain);
    EXPECT_FALSE(carom::second_run(plain));
    const carom::Scene named =
        carom::Scene::from_text(small().yaml(), {{"against", "{set: [\"balls.a.radius=0.11\"]}"}});
    const carom::Scene other =
        carom::Scene::from_text(small().yaml(), {{"balls.a.radius", "0.11"}});
    const carom::Against given{other, carom::simulate(other)};
    ASSERT_TRUE(carom::second_run(named));
    EXPECT_EQ(given.motion.hash(), carom::second_run(named)->motion.hash());
    const carom::Picture alone = carom::still(plain, motion, 0.2);
    const carom::Picture ghosts = carom::still(named, motion, 0.2);
    EXPECT_NE(alone.rgba, ghosts.rgba);
    EXPECT_EQ(ghosts.rgba, carom::still(named, motion, 0.2, given).rgba);
    EXPECT_NE(ghosts.rgba,
              carom::still(named, motion, 0.2, carom::Against{other, given.motion, true}).rgba);

    carom::SceneBuilder strange;
    strange.duration(1.5).plane("floor", {0, 0, 1}, 0).ball({.name = "z", .position = {0, 0, 1}});
    const carom::Scene z = strange.build();
    EXPECT_THROW(carom::still(plain, motion, 0, carom::Against{z, carom::simulate(z)}),
                 carom::Error);
    EXPECT_THROW(carom::still(plain, motion, 0, carom::Against{z, motion}), carom::Error);
}

// The ray of the pixel right below the picture's middle is t (s, 1, -s) from the eye, 3 m before a
// ball of 0.1 m: (1 + 2 s^2) t^2 - 6 t + 9 - 0.01 = 0.
TEST(Library, LayersSayWhatPixelsShow) {
    carom::SceneBuilder builder = small();
    builder.set("camera", "{from: [0, -3, 0.6], to: [0, 0, 0.6], fov_deg: 40}");
    const carom::Scene scene = builder.build();
    const carom::Motion motion = carom::simulate(scene);
    const auto layers = carom::layers(scene, motion, 0, {"segmentation", "depth", "normals"});
    ASSERT_EQ(3U, layers.size());
    const std::size_t middle = 18 * 64 + 32;
    const double slope = std::tan(std::acos(-1) / 9) * 0.5 / 18, k = 1 + 2 * slope * slope;
    const double t = (3 - std::sqrt(9 - k * 8.99)) / k;
    EXPECT_EQ("segmentation", layers[0].name);
    EXPECT_EQ(1, layers[0].ids.at(middle));
    EXPECT_TRUE(layers[0].values.empty());
    EXPECT_NEAR(t, layers[1].values.at(middle), 1e-6);
    EXPECT_EQ(3, layers[2].channels);
    EXPECT_NEAR((t - 3) / 0.1, layers[2].values.at(3 * middle + 1), 1e-6);
    EXPECT_THROW(carom::layers(scene, motion, 0, {"deep"}), carom::Error);
    EXPECT_THROW(carom::layers(scene, motion, -1, {"depth"}), carom::Error);
    EXPECT_THROW(carom::layers(scene, motion, 0, {"depth"}, carom::Against{scene, motion, true}),
                 carom::Error);
}

TEST(Library, FilmsHaveTheSoundThatTheSceneAsksFor) {
    const Folder folder;
    for (const bool sound : {false, true}) {
        carom::SceneBuilder builder = small();
        builder.set("film.sound", sound ? "true" : "false");
        const carom::Scene scene = builder.build();
        const fs::path path = folder.path / "film.mp4";
        carom::film(scene, carom::simulate(scene), path.string(), {.overwrite = true});
        // The box of an AAC track.
        EXPECT_EQ(sound, bytes_of(path).find("mp4a") != std::string::npos);
    }
}

TEST(Library, WorkCanBeStopped) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(carom::simulate(small().build(), {stop.get_token(), {}}), carom::Stopped);
}

TEST(Library, Fits) {
    const carom::Fit fit = carom::fit_drops({1.8}, {1.8 * 0.49, 1.8 * 0.49});
    EXPECT_NEAR(0.7, fit.restitution, 1e-12);
    EXPECT_NEAR(-2 * std::log(0.7) / 4, fit.distance_per_velocity, 1e-12);
    EXPECT_NEAR(0.5, carom::fit_intervals({0.8, 0.4, 0.2}).restitution, 1e-12);
    EXPECT_THROW(carom::fit_drops({1, 2}, {0.5}), carom::Error);
    EXPECT_THROW(carom::fit_drops({1}, {2}), carom::Error);
}

TEST(Library, HeadersAndLibraryHaveOneVersion) {
    EXPECT_EQ(std::to_string(CAROM_VERSION_MAJOR) + "." + std::to_string(CAROM_VERSION_MINOR) +
                  "." + std::to_string(CAROM_VERSION_PATCH),
              carom::version());
}

}  // namespace
