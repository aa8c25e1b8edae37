// Coefficients of restitution that depend on the approach speed, in all methods that have impacts.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "exact_scenes.h"

namespace carom {
namespace {

using namespace testing;

/// 40 digits by mpmath, gamma = 0.1 from 5 m/s on.
constexpr std::array<double, 10> kViscoelastic = {
    4.3672447874308689385, 3.8280247616366594177, 3.3666269386504320103, 2.9702788309144174416,
    2.6285446444138125788, 2.3328559214520629871, 2.0761444734399481339, 1.8525536450936476444,
    1.6572099356672627116, 1.4860414034205455218};

/// A ball that touches a floor, and comes down at `speed` at time 0.
Scene bouncing(const RestitutionLaw& law, double speed, double friction = 0) {
    Scene scene = exact_scene(1, friction, kGravity);
    scene.materials[1].restitution_law = law;
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1}, {0, 0, -speed});
    return scene;
}

TEST(SpeedRestitution, APowerOfTheSpeedGivesItsSequence) {
    const double a = 0.9, p = 0.25, v0 = 5;
    Scene scene = bouncing(PowerRestitution{a, 1, p}, v0);
    const auto impacts = impacts_of(run(scene, 3).motion);
    ASSERT_GE(impacts.size(), 8u);
    double before = v0, worst = 0;
    for (std::size_t n = 1; n <= impacts.size(); ++n) {
        const double q = std::pow(1 - p, static_cast<double>(n));
        const double expected = std::pow(a, (1 - q) / p) * std::pow(v0, q);
        const Event& impact = impacts[n - 1];
        worst = std::max({worst, relative_error(impact.separation_speed, expected),
                          relative_error(impact.approach_speed, before),
                          relative_error(impact.restitution, expected / before)});
        before = expected;
    }
    fmt::print("power: {:.1e} of 1e-12\n", worst);
    EXPECT_LT(worst, 1e-12);
}

TEST(SpeedRestitution, ViscoelasticSpheresGiveTheirs) {
    Scene scene = bouncing(ViscoelasticRestitution{0.1}, 5);
    const auto impacts = impacts_of(run(scene, 6).motion);
    ASSERT_GE(impacts.size(), kViscoelastic.size());
    double worst = 0;
    for (std::size_t n = 0; n < kViscoelastic.size(); ++n)
        worst = std::max(worst, relative_error(impacts[n].separation_speed, kViscoelastic[n]));
    fmt::print("viscoelastic: {:.1e} of 1e-12\n", worst);
    EXPECT_LT(worst, 1e-12);
    // Beyond 12.86 m/s gamma = 0.5 is at its lowest point, 7/12.
    Scene fast = bouncing(ViscoelasticRestitution{0.5}, 40);
    const auto of_fast = impacts_of(run(fast, 10).motion);
    ASSERT_GE(of_fast.size(), 4u);
    for (const auto& [n, v] : {std::pair{0, 40 * 7.0 / 12},
                               {1, 13.611111111111111111},
                               {2, 7.9398148148148148148},
                               {3, 4.6595247632904713382}})
        EXPECT_LT(relative_error(of_fast[std::size_t(n)].separation_speed, v), 1e-12) << n;
}

TEST(SpeedRestitution, ATableIsMonotoneBetweenItsPoints) {
    const MonotoneCurve table({2, 7, 20}, {0.8, 0.75, 0.6});
    // 40 digits by mpmath, Fritsch and Butland's slopes.
    for (const auto& [v, e] : {std::pair{1.0, 0.8},
                               {3.0, 0.796496335078534031},
                               {6.5, 0.755693848167539267},
                               {12.0, 0.680425711405605454},
                               {19.0, 0.601773360627414347},
                               {25.0, 0.6}}) {
        Scene scene = bouncing(table, v);
        const auto impacts = impacts_of(run(scene, 0.01).motion);
        ASSERT_FALSE(impacts.empty());
        EXPECT_LT(relative_error(impacts[0].restitution, e), 1e-14) << v;
        EXPECT_LT(relative_error(impacts[0].separation_speed, e * v), 1e-14) << v;
    }
}

TEST(SpeedRestitution, AConstantLawIsTheConstantToTheLastBit) {
    for (const Method method : {Method::kExact, Method::kFixed}) {
        std::array<std::uint64_t, 2> hashes{};
        for (const bool law : {false, true}) {
            Scene scene = exact_scene(1, 0.4, kGravity);
            scene.simulation.method = method;
            PairRule rule{{1, 2}, 0.8, 0.4, {}};
            if (law) {
                rule.restitution.reset();
                rule.restitution_law = MonotoneCurve({0, 10}, {0.8, 0.8});
            }
            scene.pairs.push_back(rule);
            add_plane(scene);
            add_ball(scene, {0, 0, 1}, {1, 0.5, 0}).spin = {0, 3, 1};
            hashes[law ? 1 : 0] = run(scene, 8).motion.hash();
        }
        EXPECT_EQ(hashes[0], hashes[1]);
    }
}

TEST(SpeedRestitution, APairIsTheProductAndARuleReplacesIt) {
    const PowerRestitution power{0.9, 1, 0.2};
    const ViscoelasticRestitution spheres{0.1};
    Scene scene = bouncing(power, 3);
    scene.materials[2].restitution_law = spheres;
    scene.materials[2].virtual_body = {};
    const double product = restitution_at(power, 3) * restitution_at(spheres, 3);
    EXPECT_LT(relative_error(impacts_of(run(scene, 0.01).motion).at(0).restitution, product),
              1e-15);
    scene.materials[2].restitution_law.reset();
    scene.materials[2].virtual_body = virtual_body(0.5);
    EXPECT_LT(relative_error(impacts_of(run(scene, 0.01).motion).at(0).restitution,
                             0.5 * restitution_at(power, 3)),
              1e-15);
    scene.pairs.push_back({{2, 1}, 0.25, {}, {}});
    EXPECT_EQ(impacts_of(run(scene, 0.01).motion).at(0).restitution, 0.25);
}

TEST(SpeedRestitution, EachContactOfACascadeHasItsOwn) {
    // Two balls that touch come down together: the floor's impact first, then the balls'.
    const PowerRestitution floor{0.8, 2, 0.1}, balls{0.7, 1, 0.15};
    Scene scene = exact_scene(1, 0, kGravity);
    scene.pairs = {{{1, 2}, {}, {}, {}, floor}, {{1, 1}, {}, {}, {}, balls}};
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1}, {0, 0, -4});
    add_ball(scene, {0, 0, 0.3}, {0, 0, -4}).mass = 0.1;
    const auto impacts = impacts_of(run(scene, 0.001).motion);
    ASSERT_EQ(impacts.size(), 2u);
    const double up = 4 * restitution_at(floor, 4), e = restitution_at(balls, 4 + up);
    EXPECT_LT(relative_error(impacts[0].restitution, up / 4), 1e-14);
    EXPECT_LT(relative_error(impacts[1].restitution, e), 1e-14);
    EXPECT_LT(relative_error(impacts[1].approach_speed, 4 + up), 1e-14);
    EXPECT_LT(relative_error(impacts[1].separation_speed, e * (4 + up)), 1e-13);
}

TEST(SpeedRestitution, ViscoelasticBouncesEnd) {
    Scene scene = bouncing(ViscoelasticRestitution{0.2}, 3, 0.3);
    scene.balls[0].velocity.x() = 1;
    scene.simulation.duration.reset();
    scene.simulation.max_duration = 20;
    const auto result = simulate(scene);
    // v' = -gamma v^(6/5) takes 5/gamma (v^(-1/5) - v_0^(-1/5)) impacts down to a speed of v, here
    // that of a hop of 1e-9 radii.
    const double last = std::sqrt(2 * kGravity * 1e-10);
    const double impacts = 5 / 0.2 * (std::pow(last, -0.2) - std::pow(3, -0.2));
    EXPECT_NEAR(static_cast<double>(result.report.impacts), impacts, 0.1 * impacts);
    EXPECT_EQ(events_of(result.motion, EventKind::kRoll).size(), 1u);
}

TEST(SpeedRestitution, TheMethodFixedTakesEachImpactsOwn) {
    const ViscoelasticRestitution law{0.15};
    Scene scene = bouncing(law, 0);
    scene.balls[0].position.z() = 2;
    scene.simulation.method = Method::kFixed;
    const auto impacts = impacts_of(run(scene, 4).motion);
    ASSERT_GT(impacts.size(), 4u);
    for (const Event& impact : impacts) {
        EXPECT_EQ(impact.restitution, restitution_at(law, impact.approach_speed));
        EXPECT_LT(
            relative_error(impact.separation_speed, impact.restitution * impact.approach_speed),
            1e-12);
    }
}

TEST(SpeedRestitution, EnergyNeverRisesAmongManyBalls) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const std::array<RestitutionLaw, 3> laws = {
        RestitutionLaw(PowerRestitution{0.7, 0.5, 0.3}),
        RestitutionLaw(ViscoelasticRestitution{0.3}),
        RestitutionLaw(MonotoneCurve({0.1, 1, 3}, {0.9, 0.7, 0.4}))};
    for (const RestitutionLaw& law : laws)
        for (const double friction : {0.0, 0.4}) {
            Scene scene = exact_scene(1, friction, kGravity);
            scene.materials[1].restitution_law = law;
            if (friction > 0) scene.pairs.push_back({{1, 1}, {}, friction, {}});
            add_plane(scene);
            for (int i = 0; i < 12; ++i)
                add_ball(scene, Vec3(0.25 * (i % 3), 0.25 * (i / 3 % 2), 0.3 + 0.25 * (i / 6)),
                         Vec3(any(random), any(random), 2 * any(random)));
            const auto result = run(scene, 1.5);
            ASSERT_GT(result.report.impacts, 20);
            double before = total_energy(scene, result.motion, 0);
            for (int i = 1; i <= 300; ++i) {
                const double now = total_energy(scene, result.motion, 0.005 * i);
                EXPECT_LE(now, before + 1e-9) << i;
                before = now;
            }
        }
}

}  // namespace
}  // namespace carom
