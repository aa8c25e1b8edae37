// The air of a scene and how balls fly in it, as the reader has them; curves against published
// numbers.
#include "scene/air.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "scene_testing.h"

namespace carom {
namespace {

/// A scene with these lines beside a ball of these keys.
std::string text_of(const std::string& air, const std::string& ball) {
    return "carom: 1\n" + air + "balls:\n  - {name: a, position: [0, 0, 1], " + ball + "}\n";
}

Scene scene_in(const std::string& air, const std::string& ball) {
    return scene_of(text_of(air, ball));
}

std::string message_of(const std::string& air, const std::string& ball) {
    return all_text(read_scene(text_of(air, ball), "t.yaml").diagnostics);
}

TEST(Air, ScenesHaveNoneUnlessTheyNameIt) {
    EXPECT_FALSE(scene_in("", "radius: 0.1").air.has_value());
    const Scene scene = scene_in("air: {}\n", "radius: 0.1");
    ASSERT_TRUE(scene.air.has_value());
    EXPECT_EQ(scene.air->density, 1.225);
    EXPECT_TRUE(scene.air->buoyancy);
    EXPECT_EQ(scene.balls[0].flight.drag.over, Drag::Over::kSphere);
    EXPECT_EQ(scene.balls[0].flight.spin_decay_s, std::numeric_limits<double>::infinity());
}

TEST(Air, KeysOfBalls) {
    const std::string air = "air: {wind: [1, 2, 3], buoyancy: false}\n";
    const Scene a = scene_in(air, "radius: 0.1, drag: 0.4, lift: spin_ratio, spin_decay_s: 30");
    EXPECT_EQ(a.air->wind, Vec3(1, 2, 3));
    EXPECT_FALSE(a.air->buoyancy);
    EXPECT_EQ(a.balls[0].flight.drag.constant, 0.4);
    EXPECT_EQ(a.balls[0].flight.lift.over, Lift::Over::kSpinRatio);
    EXPECT_EQ(a.balls[0].flight.spin_decay_s, 30);
    const Scene b = scene_in(air,
                             "radius: 0.1, drag: {reynolds: [1.0e5, 2.0e5], value: [0.5, 0.2]}, "
                             "lift: {spin: [0, 0.5], value: [0, 0.3]}");
    EXPECT_EQ(b.balls[0].flight.drag.over, Drag::Over::kReynolds);
    EXPECT_NEAR(b.balls[0].flight.drag.table->at(1.5e5), 0.35, 1e-15);
    EXPECT_EQ(b.balls[0].flight.drag.table->at(0), 0.5);
    EXPECT_NEAR(b.balls[0].flight.lift.table->at(0.25), 0.15, 1e-15);
}

TEST(Air, PresetsHaveTheirDrag) {
    EXPECT_EQ(scene_in("air: {}\n", "preset: tennis").balls[0].flight.drag.constant, 0.507);
    EXPECT_EQ(scene_in("air: {}\n", "preset: tennis, drag: 0.6").balls[0].flight.drag.constant,
              0.6);
    const Scene filled = scene_in("air: {}\ndefaults: {ball: {drag: 0.3}}\n", "preset: tennis");
    EXPECT_EQ(filled.balls[0].flight.drag.constant, 0.507);  // as its radius and its mass
}

TEST(Air, MistakesAreNamed) {
    EXPECT_EQ(message_of("air: {density: 1, humidity: 0.5}\n", "radius: 0.1").substr(0, 9),
              "t.yaml:2:");
    EXPECT_NE(message_of("air: {}\n", "radius: 0.1, drag: {speed: [1, 2, 2], value: [1, 1, 1]}")
                  .find("'speed' must increase, and 2 follows 2"),
              std::string::npos);
    EXPECT_NE(message_of("air: {}\n", "radius: 0.1, drag: {speed: [1, 2], value: [1]}")
                  .find("'speed' has 2 numbers and 'value' 1"),
              std::string::npos);
    EXPECT_NE(message_of("", "radius: 0.1, drag: 0.4").find("'drag' does nothing in a vacuum"),
              std::string::npos);
    EXPECT_NE(
        message_of("air: {}\n", "preset: football, velocity: [20, 0, 0]").find("known up to 9 m/s"),
        std::string::npos);
    EXPECT_NE(message_of("air: {}\n", "radius: 1, mass: 1").find("lighter than the air"),
              std::string::npos);
    EXPECT_NE(message_of("air: {}\n", "radius: 0.1, lift: spinratio").find("spin_ratio"),
              std::string::npos);
}

/// The formula's own numbers.
TEST(Air, DragOfASmoothSphere) {
    EXPECT_NEAR(smooth_sphere_drag(1), 24.673, 5e-4);
    EXPECT_NEAR(smooth_sphere_drag(100), 1.0381, 5e-5);
    EXPECT_NEAR(smooth_sphere_drag(1e4), 0.3926, 5e-5);
    EXPECT_NEAR(smooth_sphere_drag(2e5), 0.4159, 5e-5);
    EXPECT_NEAR(smooth_sphere_drag(4e5), 0.0930, 5e-5);
    EXPECT_NEAR(smooth_sphere_drag(1e6), 0.1296, 5e-5);
    EXPECT_NEAR(smooth_sphere_drag(1e-6) * 1e-6, 24, 1e-4);
}

/// The standard atmosphere at sea level, and moist air after the CIPM's tables: 1.1992 kg/m^3 at
/// 20 degrees, 101325 Pa and 50 %.
TEST(Air, DensityAndViscosity) {
    EXPECT_NEAR(air_density(15, 101'325, 0), 1.225, 2e-4);
    EXPECT_NEAR(air_density(20, 101'325, 0.5), 1.1992, 1e-3);
    EXPECT_NEAR(air_viscosity(15), 1.789e-5, 1e-8);
    EXPECT_NEAR(scene_in("air: {temperature_c: 15}\n", "radius: 0.1").air->viscosity, 1.789e-5,
                1e-8);
}

}  // namespace
}  // namespace carom
