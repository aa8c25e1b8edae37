// Inelastic collapse in free space: the rule, and heaps of many balls that nothing presses
// together.
#include "sim/group/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "exact_scenes.h"

namespace carom::testing {
namespace {

constexpr double kCollapseRadius = 0.05;

// ---- The rule
// -------------------------------------------------------------------------------------

TEST(CollapseRule, ManyImpactsInAShortTimeMakeAHeap) {
    CollapseRule rule(1);
    rule.note(0, kCollapseRadius, 1, 0);
    double v = 1, t = 0;
    for (int i = 0; i < CollapseRule::kImpacts; ++i) {
        EXPECT_FALSE(rule.in_heap(0)) << i;
        v *= 0.9;
        rule.note(0, kCollapseRadius, v, t += 1e-5);
    }
    EXPECT_TRUE(rule.in_heap(0));
    rule.leave_heap(0);
    EXPECT_FALSE(rule.in_heap(0));
}

TEST(CollapseRule, ImpactsThatAreFarApartDoNot) {
    CollapseRule rule(1);
    // A radius over 100 of the way between any two, at the first one's speed: 10 are too many.
    for (int i = 0; i < 1000; ++i)
        rule.note(0, kCollapseRadius, 1 - 1e-4 * i, 0.01 * kCollapseRadius * i);
    EXPECT_FALSE(rule.in_heap(0));
}

TEST(CollapseRule, AFasterImpactBeginsAnew) {
    CollapseRule rule(1);
    for (int i = 0; i < 1000; ++i) rule.note(0, kCollapseRadius, 1 + 1e-3 * (i / 20), 1e-7 * i);
    EXPECT_FALSE(rule.in_heap(0));
}

// ---- Heaps
// ----------------------------------------------------------------------------------------

/// n x n balls in a plane between four walls, with random velocities.
Scene gas(int n, double e, double friction, unsigned seed) {
    Scene scene = exact_scene(e, friction, 0);
    use_pair(scene, e, friction);
    const double apart = 3 * kCollapseRadius, side = n * apart;
    add_plane(scene, Vec3::UnitX(), 0);
    add_plane(scene, -Vec3::UnitX(), -side);
    add_plane(scene, Vec3::UnitY(), 0);
    add_plane(scene, -Vec3::UnitY(), -side);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> speed(-1, 1);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double x = speed(random), y = speed(random);
            add_ball(scene, apart * Vec3(i + 0.5, j + 0.5, 0), Vec3(x, y, 0), kCollapseRadius);
        }
    return scene;
}

struct Kept {
    double momentum = 0;     ///< kg m/s: the largest difference from what the rows say
    double energy_rise = 0;  ///< of the energy at the start
    double overlap = 0;      ///< m
};

Kept kept(const Scene& scene, const Motion& motion, double friction) {
    Kept result;
    std::vector<Vec3> p;
    for (const Ball& b : scene.balls) p.push_back(b.mass * b.velocity);
    for (const Event& e : impacts_of(motion)) {
        p[static_cast<std::size_t>(e.ball)] += e.impulse * e.normal;
        if (!e.other.is_surface) p[static_cast<std::size_t>(e.other.index)] -= e.impulse * e.normal;
    }
    const double end = motion.duration;
    if (friction == 0)
        for (std::size_t k = 0; k < p.size(); ++k)
            result.momentum =
                std::max(result.momentum,
                         (scene.balls[k].mass * motion.balls[k].at(end).velocity - p[k]).norm());
    const double start = kinetic_energy(scene, motion, 0);
    double least = start;
    for (int i = 0; i <= 500; ++i) {
        const double t = end * i / 500;
        const double now = kinetic_energy(scene, motion, t);
        result.energy_rise = std::max(result.energy_rise, (now - least) / start);
        least = std::min(least, now);
        if (i % 50 != 0) continue;
        for (std::size_t a = 0; a < scene.balls.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                result.overlap = std::max(
                    result.overlap,
                    2 * kCollapseRadius -
                        (motion.balls[a].at(t).position - motion.balls[b].at(t).position).norm());
    }
    return result;
}

/// Without the rule the impacts of these runs grow without bound: 2,500 a ball in the first.
TEST(Collapse, ImpactsStayFewLongAfterIt) {
    struct Case {
        double e, friction, seconds;
    };
    for (const auto& [e, friction, seconds] :
         {Case{0.6, 0, 200}, Case{0.3, 0, 60}, Case{0, 0, 60}, Case{0.6, 0.3, 60}}) {
        Scene scene = gas(12, e, friction, 3);
        const SimulationResult result = run(scene, seconds);
        const double balls = static_cast<double>(scene.balls.size());
        const Kept k = kept(scene, result.motion, friction);
        std::printf(
            "e %g, mu %g, %g s: %.0f rows a ball, %lld impacts on heaps; momenta within "
            "%.2g, energy rises by %.2g, overlap %.2g m\n",
            e, friction, seconds, static_cast<double>(result.report.impacts) / balls,
            static_cast<long long>(result.report.collapses), k.momentum, k.energy_rise, k.overlap);
        EXPECT_GT(result.report.collapses, 0);
        EXPECT_TRUE(result.report.effects.at("collapse").on);
        EXPECT_LE(static_cast<double>(result.report.impacts), 800 * balls);
        EXPECT_LE(k.momentum, 1e-11);
        EXPECT_LE(k.energy_rise, 1e-12);
        EXPECT_LE(k.overlap, 1e-12);
    }
}

/// A lossless gas has no collapse, however dense.
TEST(Collapse, NoneWithoutLoss) {
    Scene scene = gas(8, 1, 0, 4);
    const SimulationResult result = run(scene, 10);
    EXPECT_EQ(result.report.collapses, 0);
    EXPECT_FALSE(result.report.effects.at("collapse").on);
}

/// Ten balls that come together on a line: after the collapse all have the mean velocity, that of
/// the centre of mass.
TEST(Collapse, ALineEndsWithOneVelocity) {
    for (const double e : {0.2, 0.4, 0.5}) {
        Scene scene = exact_scene(e, 0, 0);
        use_pair(scene, e);
        double momentum = 0, mass = 0;
        for (int i = 0; i < 24; ++i) {
            Ball& b = add_ball(scene, Vec3(0.15 * i + 0.001 * (i % 3), 0, 0),
                               Vec3(2 - 0.1 * i, 0, 0), kCollapseRadius);
            momentum += b.mass * b.velocity.x();
            mass += b.mass;
        }
        const SimulationResult result = run(scene, 60);
        double fastest = 0;
        for (const Trajectory& ball : result.motion.balls)
            fastest = std::max(fastest, std::abs(ball.at(60).velocity.x() - momentum / mass));
        std::printf("e %g: %zu rows, velocities within %.2g m/s of the mean\n", e,
                    impacts_of(result.motion).size(), fastest);
        EXPECT_LE(fastest, 1e-9);
        EXPECT_LE(impacts_of(result.motion).size(), 24u * 300u);
    }
}

}  // namespace
}  // namespace carom::testing
