// Balls poured into a box (method exact): they settle, stay inside, and come to rest (H22).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "exact_scenes.h"

namespace carom::testing {
namespace {

constexpr double kSide = 0.6;  // m, of the box within
constexpr double kHeight = 2;  // m

struct Pouring {
    int balls = 200;
    double restitution = 0.5, friction = 0.3;
    bool unequal = false;  ///< radii 0.6 to 1, masses over a factor of 100
    double seconds = 3;
};

void add_box(Scene& scene, const Vec3& center, const Vec3& size) {
    Surface box;
    box.name = "box" + std::to_string(scene.surfaces.size());
    box.shape = BoxShape{center, size, Quat::Identity()};
    box.material = 2;
    scene.surfaces.push_back(box);
}

Scene pour(const Pouring& p) {
    Scene scene = exact_scene(p.restitution, p.friction, kGravity);
    use_pair(scene, p.restitution, p.friction);
    const double thick = 0.1, at = 0.5 * (kSide + thick);
    add_box(scene, Vec3(0, 0, -0.5 * thick), Vec3(kSide + 2 * thick, kSide + 2 * thick, thick));
    for (const double to : {-1.0, 1.0}) {
        add_box(scene, Vec3(to * at, 0, 0.5 * kHeight), Vec3(thick, kSide + 2 * thick, kHeight));
        add_box(scene, Vec3(0, to * at, 0.5 * kHeight), Vec3(kSide, thick, kHeight));
    }
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < p.balls; ++i) {
        const Vec3 cell(i % 5 - 2, i / 5 % 5 - 2, i / 25 + 1);
        const double x = unit(random), y = unit(random), z = unit(random);
        const double radius = p.unequal ? 0.05 * (0.6 + 0.4 * unit(random)) : 0.05;
        add_ball(scene, 0.118 * cell + 0.005 * Vec3(x, y, z), Vec3::Zero(), radius).mass =
            p.unequal ? std::pow(10, 2 * unit(random) - 1) : 1;
    }
    return scene;
}

struct Settled {
    double rise_before = 0;  ///< of the energy over its running minimum, until the first impact
    double rise = 0;         ///< later; both in units of the start
    double deepest = 0;      ///< m
    int outside = 0;
    double end_speed = 0;  ///< m/s
    int at_rest = 0;
};

double energy(const Scene& scene, const std::vector<BallState>& balls) {
    double sum = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Ball& b = scene.balls[i];
        const double rim = b.radius * balls[i].spin.norm();
        sum += b.mass * (0.5 * balls[i].velocity.squaredNorm() +
                         0.5 * b.inertia_factor * rim * rim + kGravity * balls[i].position.z());
    }
    return sum;
}

/// The deepest overlap of two balls, or of a ball and the box [m].
double overlap(const Scene& scene, const std::vector<BallState>& balls) {
    double deepest = -INFINITY;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec3& x = balls[i].position;
        const double r = scene.balls[i].radius;
        deepest = std::max({deepest, r - x.z(), std::abs(x.x()) + r - 0.5 * kSide,
                            std::abs(x.y()) + r - 0.5 * kSide});
        for (std::size_t j = 0; j < i; ++j) {
            const double reach = r + scene.balls[j].radius;
            if ((x - balls[j].position).squaredNorm() < reach * reach)
                deepest = std::max(deepest, reach - (x - balls[j].position).norm());
        }
    }
    return deepest;
}

Settled examine(const Scene& scene, const Motion& motion, double seconds) {
    Settled s;
    const double first_impact = impacts_of(motion).at(0).time;
    std::vector<BallState> balls(scene.balls.size());
    double least = INFINITY, start = 0;
    const int samples = static_cast<int>(seconds * 500);
    for (int k = 0; k <= samples; ++k) {
        const double t = seconds * k / samples;
        for (std::size_t i = 0; i < balls.size(); ++i) balls[i] = motion.balls[i].at(t);
        const double now = energy(scene, balls);
        if (k == 0) start = least = now;
        double& rise = t < first_impact ? s.rise_before : s.rise;
        rise = std::max(rise, (now - least) / start);
        least = std::min(least, now);
        if (k % 10 == 0) s.deepest = std::max(s.deepest, overlap(scene, balls));
    }
    for (const BallState& b : balls) {
        const bool inside = b.position.z() > 0 && b.position.z() < kHeight &&
                            std::abs(b.position.x()) < 0.5 * kSide &&
                            std::abs(b.position.y()) < 0.5 * kSide;
        s.outside += inside ? 0 : 1;
        s.at_rest += b.velocity.norm() == 0 ? 1 : 0;
        s.end_speed = std::max(s.end_speed, b.velocity.norm());
    }
    return s;
}

Settled settle(const Pouring& p) {
    Scene scene = pour(p);
    const SimulationResult r = run(scene, p.seconds);
    const Settled s = examine(scene, r.motion, p.seconds);
    std::printf(
        "%d balls, e %g, mu %g%s: energy rise %.2g before, %.2g after the first impact (1e-12, "
        "1e-6), overlap %.2g of R (0.01), %d outside, %d at rest, others up to %.2g m/s, %lld "
        "impacts\n",
        p.balls, p.restitution, p.friction, p.unequal ? ", unequal" : "", s.rise_before, s.rise,
        s.deepest / (p.unequal ? 0.03 : 0.05), s.outside, s.at_rest, s.end_speed,
        static_cast<long long>(r.report.impacts));
    EXPECT_LE(s.rise_before, 1e-12);
    EXPECT_LE(s.rise, 1e-6);
    EXPECT_LE(s.deepest, 0.01 * (p.unequal ? 0.03 : 0.05));
    EXPECT_EQ(s.outside, 0);
    EXPECT_GT(r.report.impacts, p.balls);
    return s;
}

TEST(Pile, TwoHundredComeToRest) {  // H22
    Pouring longer;
    longer.seconds = 5;  // the last ones that rearrange wake others until about 4 s
    const Settled s = settle(longer);
    EXPECT_GE(s.at_rest, 185);
    EXPECT_LT(s.end_speed, 0.02);
}

TEST(Pile, LittleRebound) {
    settle({60, 0.0, 0.3, false, 1.2});
    settle({60, 0.2, 0.6, false, 1.2});
}

TEST(Pile, MuchRebound) {
    settle({60, 0.8, 0.3, false, 1.2});
    settle({60, 0.8, 0.0, false, 1.2});
}

TEST(Pile, NoFriction) { settle({60, 0.5, 0.0, false, 1.5}); }

TEST(Pile, UnequalBalls) {
    settle({75, 0.5, 0.3, true, 1.5});
    settle({75, 0.5, 0.0, true, 1.5});
}

TEST(Pile, RepeatsExactly) {
    Scene scene = pour({60, 0.5, 0.3, false, 1});
    EXPECT_EQ(run(scene, 1).motion.hash(), run(scene, 1).motion.hash());
}

/// A sleeping pile stays as it is; what falls onto it wakes those that it moves.
TEST(Pile, WakesUnderAHammer) {
    Scene scene = pour({50, 0.5, 0.5, false, 4});
    Ball& hammer = add_ball(scene, Vec3(0, 0, 30), Vec3::Zero(), 0.1);
    hammer.mass = 50;
    const double falls = std::sqrt(2 * 29.5 / kGravity);
    const SimulationResult r = run(scene, 3.5);
    int still = 0, moved = 0;
    for (std::size_t i = 0; i < 50; ++i) {
        const BallState before = r.motion.balls[i].at(falls - 0.1),
                        after = r.motion.balls[i].at(3.5);
        still += before.velocity.norm() < 0.02 ? 1 : 0;
        moved += (before.position - after.position).norm() > 0.01 ? 1 : 0;
    }
    const BallState end = r.motion.balls[50].at(3.5);
    std::printf("%d of 50 still before, %d moved; hammer at %.3g m with %.3g m/s\n", still, moved,
                end.position.z(), end.velocity.norm());
    EXPECT_GE(still, 40);
    EXPECT_GE(moved, 10);
    EXPECT_LT(end.position.z(), 0.5);
    EXPECT_GT(end.position.z(), 0.1 - 1e-3);
}

/// Balls of three materials in any order: each impact rebounds by the coefficient of its own pair.
TEST(Pile, EachPairHasItsOwnNumbers) {
    Scene scene = pour({60, 0.5, 0.2, false, 1});
    const auto coefficient = [](int a, int b) { return a == b ? 0.7 : 0.3 + 0.1 * (a + b); };
    scene.materials.resize(5);
    scene.pairs.clear();
    for (int a = 2; a < 5; ++a)
        for (int b = a; b < 5; ++b) scene.pairs.push_back({{a, b}, coefficient(a, b), 0.2, {}});
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        scene.balls[i].material = 2 + static_cast<int>(i * 7 % 3);
    const SimulationResult r = run(scene, 1);
    int between_balls = 0;
    for (const Event& e : impacts_of(r.motion)) {
        const auto ball = static_cast<std::size_t>(e.ball);
        const auto other = static_cast<std::size_t>(e.other.index);
        const int material = e.other.is_surface ? 2 : scene.balls[other].material;
        between_balls += e.other.is_surface ? 0 : 1;
        ASSERT_EQ(e.restitution, coefficient(std::min(scene.balls[ball].material, material),
                                             std::max(scene.balls[ball].material, material)));
    }
    EXPECT_GT(between_balls, 100);
}

}  // namespace
}  // namespace carom::testing
