// The paper's Eq. 6, 7, 10, and the pair rules.
#include "sim/contact/restitution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"

namespace carom {
namespace {

using namespace testing;

TEST(Restitution, VirtualBodiesOfTable2GiveTheComputedCoefficients) {
    struct Row {
        VirtualBody body;
        double time, restitution;
    };
    // Columns of Table 2 exchanged, K = 4; against a body that is taken as rigid (Eq. 10).
    for (const Row& row : {Row{{0.42, 5}, 0.042, 0.845354}, Row{{0.72, 6}, 0.06, 0.786628},
                           Row{{0.3, 3}, 0.05, 0.818731}, Row{{0.05, 1}, 0.025, 0.904837}}) {
        const double time = contact_time({0, 1}, row.body);
        EXPECT_DOUBLE_EQ(time, row.time);
        EXPECT_DOUBLE_EQ(time, virtual_time(row.body));
        EXPECT_NEAR(restitution_of_time(time, 4), row.restitution, 5e-7);
    }
}

TEST(Restitution, LimitsOfTheVirtualBody) {
    EXPECT_EQ(virtual_time({0, 0}), 0);  // loses nothing, whatever its speed
    EXPECT_EQ(restitution_of_time(contact_time({0, 0}, {0, 1}), 4), 1);
    EXPECT_EQ(restitution_of_time(contact_time({INFINITY, 1}, {0.1, 1}), 4), 0);
    EXPECT_EQ(restitution_of_time(contact_time({INFINITY, 1}, {INFINITY, 1}), 0), 0);
    EXPECT_EQ(restitution_of_time(contact_time({0.3, 1}, {0.1, 1}), 0), 1);
}

TEST(Restitution, OfAPairIsTheProduct) {
    for (double a : {1.0, 0.85, 0.3, 1e-6, 0.0})
        for (double b : {1.0, 0.7, 0.01, 0.0})
            EXPECT_NEAR(restitution_of_time(contact_time(virtual_body(a), virtual_body(b)), 4),
                        a * b, 1e-15);
}

TEST(PairTable, MultipliesAndOverrides) {
    Scene scene = scene_of(0.8, 0.5, kGravity, 1e-3);
    scene.materials.push_back(
        {.name = "ice", .virtual_body = virtual_body(0.5), .friction = 0.1, .mark = {}});
    scene.pairs.push_back({{3, 1}, 0.25, std::nullopt, {}});
    scene.pairs.push_back({{2, 3}, std::nullopt, 0.7, {}});
    const PairTable pairs(scene);
    EXPECT_NEAR(pairs.at(1, 1).restitution, 0.64, 1e-15);
    EXPECT_NEAR(pairs.at(1, 1).friction, 0.25, 1e-15);
    EXPECT_NEAR(pairs.at(1, 2).restitution, 0.8, 1e-15);
    EXPECT_EQ(pairs.at(0, 0).restitution, 1);  // the default material loses nothing ...
    EXPECT_EQ(pairs.at(0, 1).friction, 0);     // ... and has no friction, with any partner
    for (auto [a, b] : {std::pair(1, 3), std::pair(3, 1)}) {
        EXPECT_EQ(pairs.at(a, b).restitution, 0.25);
        EXPECT_NEAR(pairs.at(a, b).friction, 0.05, 1e-15);  // the rule does not name it
    }
    EXPECT_NEAR(pairs.at(3, 2).restitution, 0.5, 1e-15);
    EXPECT_EQ(pairs.at(3, 2).friction, 0.7);
}

TEST(PairTable, KnowsWhetherAnythingThatCanMeetHasFriction) {
    Scene scene = scene_of(0.8, 0.5, kGravity, 1e-3);
    EXPECT_FALSE(PairTable(scene).any_friction());  // nothing is there
    add_ball(scene, {0, 0, 1});
    EXPECT_FALSE(PairTable(scene).any_friction());  // one ball meets nothing
    add_ball(scene, {1, 0, 1});
    EXPECT_TRUE(PairTable(scene).any_friction());  // two of one material meet each other
    scene.pairs.push_back({{1, 1}, std::nullopt, 0.0, {}});
    EXPECT_FALSE(PairTable(scene).any_friction());
    add_plane(scene);
    EXPECT_TRUE(PairTable(scene).any_friction());
    scene.materials[2].friction.reset();
    EXPECT_FALSE(PairTable(scene).any_friction());
}

TEST(Effects, SayWhatIsModelledAndWhy) {
    Scene scene = scene_of(0.8, 0, kGravity, 1e-3);
    add_plane(scene);
    add_ball(scene, {0, 0, 1});
    auto effects = run(scene, 0.01).report.effects;
    EXPECT_TRUE(effects.at("gravity").on);
    EXPECT_TRUE(effects.at("surfaces").on);
    EXPECT_FALSE(effects.at("friction").on);
    EXPECT_NE(effects.at("friction").why.find("no friction rows"), std::string::npos);
    EXPECT_FALSE(effects.at("pairs").on);
    EXPECT_FALSE(effects.at("spin").on);

    Scene rich = scene_of(0.8, 0.5, 0, 1e-3);
    add_plane(rich);
    add_ball(rich, {0, 0, 1});
    add_ball(rich, {1, 0, 1});
    effects = run(rich, 0.01).report.effects;
    EXPECT_FALSE(effects.at("gravity").on);
    for (const char* name : {"friction", "pairs", "spin"}) EXPECT_TRUE(effects.at(name).on) << name;
    for (const auto& [name, effect] : effects) EXPECT_FALSE(effect.why.empty()) << name;
}

}  // namespace
}  // namespace carom
