// The presets against the paper's numbers (corrected, see docs/scene.md).
#include "scene/catalogue.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "scene/virtual_body.h"
#include "scene_testing.h"

namespace carom {
namespace {

TEST(Catalogue, HasTheContractsVirtualBodies) {
    const auto expect = [](const char* name, double x, double v, double restitution) {
        const Preset* preset = find_preset(name);
        ASSERT_NE(preset, nullptr) << name;
        EXPECT_EQ(preset->virtual_body.distance_m, x);
        EXPECT_EQ(preset->virtual_body.velocity_m_s, v);
        const double computed = rigid_restitution(preset->virtual_body, 4);
        fmt::print("{:13} computed {:.6f} printed {}\n", name, computed,
                   preset->printed_restitution);
        EXPECT_NEAR(computed, restitution, 5e-7);
        EXPECT_NEAR(computed, preset->printed_restitution, 0.009);
    };
    EXPECT_EQ(catalogue().size(), 5U);
    expect("basketball", 0.42, 5, std::exp(-0.168));
    expect("volleyball", 0.72, 6, std::exp(-0.24));
    expect("football", 0.3, 3, std::exp(-0.2));
    expect("table_tennis", 0.05, 1, std::exp(-0.1));
    expect("tennis", 0.736, 5, 0.744978);
    EXPECT_NEAR(rigid_restitution(find_preset("basketball")->virtual_body, 4), 0.845354, 5e-7);
}

TEST(Catalogue, IsInsideTheRangesOfTable1) {
    struct Row {
        const char* name;
        double mass_low, mass_high, circumference_low, circumference_high;
    };
    const double pi = std::numbers::pi;
    for (const Row& row :
         {Row{"basketball", 0.567, 0.650, 0.749, 0.78}, Row{"volleyball", 0.260, 0.280, 0.65, 0.67},
          Row{"football", 0.420, 0.445, 0.685, 0.695},
          Row{"tennis", 0.056, 0.0594, pi * 0.06541, pi * 0.06858},
          Row{"table_tennis", 0.0027, 0.0027, pi * 0.04, pi * 0.04}}) {
        const Preset* preset = find_preset(row.name);
        ASSERT_NE(preset, nullptr);
        EXPECT_NEAR(preset->mass, (row.mass_low + row.mass_high) / 2, 1e-12) << row.name;
        EXPECT_NEAR(2 * pi * preset->radius, (row.circumference_low + row.circumference_high) / 2,
                    1e-12)
            << row.name;
        EXPECT_EQ(preset->inertia_factor, 2.0 / 3.0);
    }
}

TEST(Catalogue, KeysBesideAPresetOverrideIt) {
    const Scene scene = scene_of(
        "carom: 1\n"
        "materials: {steel: {restitution: 0.9}}\n"
        "looks: {blue: {color: \"#00f\"}}\n"
        "balls:\n"
        "  - {name: a, preset: football, radius: 0.2, mass: 2, inertia: solid, material: steel, "
        "look: blue, position: [0, 0, 5]}\n");
    const Ball& ball = scene.balls.at(0);
    EXPECT_EQ(ball.radius, 0.2);
    EXPECT_EQ(ball.mass, 2);
    EXPECT_EQ(ball.inertia_factor, 0.4);
    EXPECT_EQ(scene.materials[static_cast<std::size_t>(ball.material)].name, "steel");
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(ball.look)].name, "blue");
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(ball.look)].color.b, 1);
    EXPECT_EQ(ball.preset, "football");
}

TEST(Catalogue, APresetsNameIsAMaterialThatMayBeChanged) {
    const Scene used = scene_of(
        "carom: 1\nballs: [{name: a, radius: 0.1, position: [0, 0, 1], material: tennis}]");
    EXPECT_EQ(used.materials.at(1).name, "tennis");
    EXPECT_EQ(used.materials.at(1).virtual_body.distance_m, 0.736);

    const std::string ball = "\nballs: [{name: a, preset: tennis, drop_height: 1}]";
    const Scene rough = scene_of("carom: 1\nmaterials: {tennis: {friction: 0.6}}" + ball);
    ASSERT_EQ(rough.materials.size(), 2U);
    EXPECT_EQ(rough.materials[1].virtual_body.distance_m, 0.736) << "what is left out stays";
    EXPECT_EQ(rough.materials[1].friction, 0.6);
    EXPECT_EQ(rough.balls[0].material, 1);
    const Scene other = scene_of("carom: 1\nmaterials: {tennis: {restitution: 1}}" + ball);
    EXPECT_EQ(other.materials[1].virtual_body.distance_m, 0);
}

}  // namespace
}  // namespace carom
