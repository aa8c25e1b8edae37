// The keys of a second run, of the shutter and of the background; what two scenes do differently.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "scene/difference.h"
#include "scene_testing.h"

namespace carom {
namespace {

const std::string kScene = R"(carom: 1
simulation: {duration: 2}
materials:
  rubber: {restitution: 0.8}
surfaces:
  - {name: floor, plane: {}}
balls:
  - {name: a, radius: 0.1, material: rubber, position: [0, 0, 1]}
)";

std::vector<std::string> found(const std::string& first, const std::string& second,
                               const std::vector<Override>& second_overrides = {}) {
    std::vector<std::string> texts;
    for (const SceneDifference& d : scene_differences(first, {}, second, second_overrides))
        texts.push_back(fmt::format("{}: {} | {}", d.path, d.first, d.second));
    return texts;
}

using Texts = std::vector<std::string>;

TEST(AgainstKeys, AreRead) {
    const Scene plain = scene_of(kScene);
    EXPECT_FALSE(plain.against.has_value());
    EXPECT_EQ(Background::kSky, plain.background);
    EXPECT_EQ(0, plain.film.shutter_deg);

    const Scene scene = scene_of(kScene +
                                 "against: {set: [\"simulation.method=fixed\"], view: side}\n"
                                 "background: transparent\nfilm: {shutter_deg: 180}\n");
    ASSERT_TRUE(scene.against.has_value());
    EXPECT_EQ(Texts{"simulation.method=fixed"}, scene.against->set);
    EXPECT_EQ(AgainstView::kSide, scene.against->view);
    EXPECT_EQ(Background::kTransparent, scene.background);
    EXPECT_EQ(180, scene.film.shutter_deg);
}

TEST(AgainstKeys, MistakesAreNamed) {
    EXPECT_EQ("t.yaml:9:10: error: at least one of 'scene', 'set' must stand here\n",
              errors_of(kScene + "against: {view: side}\n"));
    EXPECT_EQ(
        "t.yaml:9:17: error: 'method' is not PATH=VALUE, such as \"simulation.method=fixed\"\n",
        errors_of(kScene + "against: {set: [method]}\n"));
    EXPECT_EQ("t.yaml:9:16: error: nothing is set, so that both runs are the same\n",
              errors_of(kScene + "against: {set: []}\n"));
    EXPECT_NE("", errors_of(kScene + "against: {set: [{a: 1}]}\n"));
    EXPECT_NE("", errors_of(kScene + "film: {shutter_deg: 361}\n"));
    EXPECT_NE("", errors_of(kScene + "film: {shutter_deg: -1}\n"));
    EXPECT_NE("", errors_of(kScene + "background: blue\n"));
}

TEST(SceneDifferences, ValuesWithTheirDefaults) {
    EXPECT_EQ(Texts{}, found(kScene, kScene));
    EXPECT_EQ(Texts{"simulation.method: exact | fixed"},
              found(kScene, kScene, {{"simulation.method", "fixed"}}));
    EXPECT_EQ(Texts{"materials.rubber.restitution: 0.8 | 0.5"},
              found(kScene, kScene, {{"materials.rubber.restitution", "0.50"}}));
    EXPECT_EQ(Texts{"simulation.gravity: [0, 0, -9.81] | [0, 0, -1.62]"},
              found(kScene, kScene, {{"simulation.gravity", "[0, 0, -1.62]"}}));
    EXPECT_EQ((Texts{"balls.a.mass: 1 | 2", "balls.a.velocity: [0, 0, 0] | [1, 0, 0]"}),
              found(kScene, kScene, {{"balls.a.velocity", "[1, 0, 0]"}, {"balls.a.mass", "2"}}));
}

// The method `exact` has no step: none is shown for it.
TEST(SceneDifferences, StepsAreThoseOfTheMethodThatHasThem) {
    EXPECT_EQ((Texts{"simulation.method: exact | fixed", "simulation.step: \u2013 | 0.02"}),
              found(kScene, kScene, {{"simulation.method", "fixed"}, {"simulation.step", "0.02"}}));
    EXPECT_EQ(Texts{}, found(kScene, kScene, {{"simulation.step", "0.02"}}));
}

TEST(SceneDifferences, ANumberAgainstALaw) {
    const auto scene = [](const std::string& restitution) {
        return "carom: 1\nmaterials: {r: {restitution: " + restitution + "}}\n";
    };
    const std::string law = "{viscoelastic: {gamma: 0.1}}";
    EXPECT_EQ(Texts{"materials.r.restitution: 0.5 | {viscoelastic: {gamma: 0.1}}"},
              found(scene("0.5"), scene(law)));
    EXPECT_EQ(Texts{"materials.r.restitution.viscoelastic.gamma: 0.1 | 0.2"},
              found(scene(law), scene("{viscoelastic: {gamma: 0.2}}")));
}

// What a preset or a virtual body implies is said in numbers.
TEST(SceneDifferences, PresetsAndVirtualBodies) {
    const std::string ball =
        "carom: 1\nballs:\n  - {name: b, preset: basketball, drop_height: 1}\n";
    EXPECT_EQ(Texts{"materials.basketball.restitution: 0.8454 | 0.7"},
              found(ball, ball, {{"materials.basketball.restitution", "0.7"}}));
    EXPECT_EQ(Texts{"balls.b.mass: 0.6085 | 1"}, found(ball, ball, {{"balls.b.mass", "1"}}));
    EXPECT_EQ(Texts{"materials.basketball.friction: none | 0.5"},
              found(ball, ball, {{"materials.basketball.friction", "0.5"}}));
    const std::string body =
        "carom: 1\nmaterials: {r: {virtual_body: {distance: 0.42, velocity: 5}}}\n";
    const std::string number = "carom: 1\nmaterials: {r: {restitution: 0.5}}\n";
    EXPECT_EQ(Texts{"materials.r.restitution: 0.8454 | 0.5"}, found(body, number));
    EXPECT_EQ(Texts{"materials.r.virtual_body.distance: 0.42 | 0.7"},
              found(body, body, {{"materials.r.virtual_body.distance", "0.7"}}));
}

// The same value in other words is no difference, and neither is how things look.
TEST(SceneDifferences, LeavesOutWhatIsNotSimulated) {
    EXPECT_EQ(Texts{}, found(kScene, kScene,
                             {{"simulation.method", "exact"},
                              {"simulation.duration", "2.0"},
                              {"film.fps", "30"},
                              {"overlay.clock", "true"}}));
}

TEST(SceneDifferences, BodiesOfOneSceneOnly) {
    const std::string more = kScene + "  - {name: b, radius: 0.1, position: [1, 0, 1]}\n";
    EXPECT_EQ(Texts{"balls.b: none | there"}, found(kScene, more));
    EXPECT_EQ(Texts{"balls.b: there | none"}, found(more, kScene));
}

TEST(SceneDifferences, LongValuesAreShortened) {
    const std::string other = kScene + "pairs: [{between: [rubber, rubber], restitution: 0.123}]\n";
    const auto texts = found(kScene, other);
    ASSERT_EQ(1u, texts.size());
    EXPECT_EQ("pairs[0]: none | there", texts[0]);
    for (const SceneDifference& d : scene_differences(
             kScene, {}, kScene, {{"balls.a.position", "[0.123456789, 0.123456789, 1.123456789]"}}))
        EXPECT_LE(d.second.size(), 31u);
}

}  // namespace
}  // namespace carom
