// What materials and pairs say beyond two numbers: coefficients over the approach speed, rolling
// resistance, pivoting, tangential restitution.
#include <cmath>

#include "scene_testing.h"

namespace carom {
namespace {

std::string materials(const std::string& text) {
    return "carom: 1\nmaterials:\n" + text +
           "\nsurfaces: [{name: floor, plane: {}, material: floor}]\n"
           "balls: [{name: a, radius: 0.1, position: [0, 0, 1], material: ball}]\n";
}

TEST(ContactKeys, AreRead) {
    const Scene scene = scene_of(materials(
        "  ball: {restitution: {speed: [2, 7, 20], value: [0.8, 0.75, 0.6]}, friction: 0.6,"
        " rolling: 0.01, pivoting: 0.0005, tangential_restitution: 0.2}\n"
        "  floor: {friction: 1, rolling: 1, restitution: {viscoelastic: {gamma: 0.1}}}\n"
        "  clay: {restitution: {power: {value: 0.9, exponent: 0.25}}}\n"
        "  tennis: {restitution: {power: {value: 0.9, at_speed: 2, exponent: 0.25}}}\n"
        "pairs: [{between: [ball, clay], restitution: {viscoelastic: {gamma: 0.2}}, rolling: 0.03,"
        " pivoting: 0.001, tangential_restitution: -0.5}]"));
    const Material& ball = scene.materials.at(1);
    EXPECT_EQ(restitution_at(*ball.restitution_law, 7), 0.75);
    EXPECT_EQ(ball.virtual_body.distance_m, 0);
    EXPECT_EQ(ball.rolling, 0.01);
    EXPECT_EQ(ball.pivoting, 0.0005);
    EXPECT_EQ(ball.tangential_restitution, 0.2);
    EXPECT_NEAR(restitution_at(*scene.materials.at(2).restitution_law, 1), 1 - 0.1 + 0.006, 1e-15);
    EXPECT_EQ(restitution_at(*scene.materials.at(3).restitution_law, 1), 0.9);
    EXPECT_EQ(restitution_at(*scene.materials.at(3).restitution_law, 0), 1);
    // The preset's coefficient gives way.
    EXPECT_EQ(scene.materials.at(4).virtual_body.distance_m, 0);
    EXPECT_EQ(restitution_at(*scene.materials.at(4).restitution_law, 2), 0.9);
    const PairRule& rule = scene.pairs.at(0);
    EXPECT_TRUE(rule.restitution_law && !rule.restitution && !rule.friction);
    EXPECT_EQ(rule.rolling, 0.03);
    EXPECT_EQ(rule.pivoting, 0.001);
    EXPECT_EQ(rule.tangential_restitution, -0.5);
}

TEST(ContactKeys, AreSetFromTheCommandLine) {
    const std::string text =
        materials("  ball: {restitution: {viscoelastic: {gamma: 0.1}}}\n  floor: {}");
    const Scene scene = scene_of(text, {{"materials.ball.restitution.viscoelastic.gamma", "0.2"}});
    EXPECT_NEAR(restitution_at(*scene.materials.at(1).restitution_law, 1), 1 - 0.2 + 0.024, 1e-15);
    EXPECT_FALSE(
        scene_of(text, {{"materials.ball.restitution", "0.5"}}).materials.at(1).restitution_law);
}

TEST(ContactKeys, MistakesHaveTheirPlaces) {
    const auto expect = [](const std::string& body, const std::string& expected) {
        EXPECT_EQ(errors_of(materials("  ball: {" + body + "}\n  floor: {}")), expected) << body;
    };
    expect("restitution: {speed: [1, 2]}",
           "t.yaml:3:23: error: one of 'value', 'power', 'viscoelastic' must stand here\n");
    expect("restitution: {speed: [1, 2], value: [0.5, 0.4], power: {value: 1, exponent: 0}}",
           "t.yaml:3:58: error: 'speed' and 'power' cannot stand together\n"
           "t.yaml:3:58: error: 'value' and 'power' cannot stand together\n");
    expect("restitution: {speed: [1, 2, 2], value: [0.5, 0.4, 0.3]}",
           "t.yaml:3:38: error: 'speed' must increase: 2 stands after 2\n");
    expect("restitution: {speed: [1, 2], value: [0.5]}",
           "t.yaml:3:46: error: 'value' must have as many numbers as 'speed', 2, not 1\n");
    expect("restitution: {speed: [1], value: [0.5]}",
           "t.yaml:3:31: error: 'speed' must have at least 2 numbers, not 1; for one, write a "
           "number instead of the mapping\n");
    expect("restitution: {speed: [1, 2], value: [0.5, 1.5]}",
           "t.yaml:3:52: error: 'value' must be between 0 and 1, not 1.5\n");
    expect("restitution: {power: {value: 0.9, exponent: 1}}",
           "t.yaml:3:54: error: 'exponent' must be at least -10 and below 1, not 1\n");
    expect("restitution: {power: {value: 0, exponent: 0.5}}",
           "t.yaml:3:39: error: 'value' must be above 0 and at most 1, not 0\n");
    expect("tangential_restitution: 1.5",
           "t.yaml:3:34: error: 'tangential_restitution' must be between -1 and 1, not 1.5\n");
    expect("pivoting: -1", "t.yaml:3:20: error: 'pivoting' must be at least 0 m, not -1\n");
}

TEST(ContactKeys, SeparationSpeedsDoNotFall) {
    // 0.9 * 5 = 4.5 m/s against 0.4 * 6 = 2.4 m/s.
    const std::string falls = errors_of(materials(
        "  ball: {restitution: {speed: [1, 5, 6], value: [0.9, 0.9, 0.4]}}\n  floor: {}"));
    EXPECT_EQ(falls.find("t.yaml:3:49: error: the separation speed must not fall where the "
                         "approach is faster: from 5."),
              0u)
        << falls;
    EXPECT_NE(falls.find(" to 2.396 m/s\n"), std::string::npos) << falls;
    // Each by itself is right, the product is not.
    const std::string steep = "{restitution: {power: {value: 0.9, exponent: 0.6}}}";
    const std::string pair = errors_of(materials("  ball: " + steep + "\n  floor: " + steep));
    EXPECT_EQ(pair.find("t.yaml:4:10: error: materials 'ball' and 'floor' may meet, and of the "
                        "product of their coefficients the separation speed must not fall"),
              0u)
        << pair;
    EXPECT_EQ(errors_of(materials("  ball: " + steep + "\n  floor: " + steep +
                                  "\npairs: [{between: [ball, floor], restitution: 0.5}]")),
              "");
    EXPECT_EQ(errors_of(materials("  ball: " + steep + "\n  floor: {}")), "");
}

TEST(ContactKeys, WhatHasNoEffectIsWarnedOf) {
    EXPECT_EQ(
        errors_of(materials("  ball: {friction: 1, rolling: 0.1}\n  floor: {friction: 1}")),
        "t.yaml:3:32: warning: material 'ball' names rolling, but it may meet what names none "
        "('floor'), and between them there will be none; give both a rolling, or name it in "
        "'pairs'\n");
    const std::string smooth = errors_of(
        materials("  ball: {rolling: 0.1, tangential_restitution: 1}\n  floor: {rolling: 1}"));
    EXPECT_NE(smooth.find("t.yaml:3:19: warning: material 'ball' names rolling, but no friction"),
              std::string::npos)
        << smooth;
    EXPECT_NE(smooth.find("material 'ball' names tangential_restitution, but no friction"),
              std::string::npos);
    EXPECT_EQ("", errors_of(materials("  ball: {friction: 1, rolling: 0.1, pivoting: 0.1}\n"
                                      "  floor: {friction: 1, rolling: 1}\n"
                                      "simulation: {method: fixed}")));
}

}  // namespace
}  // namespace carom
