// The method `exact` against an independent reference (free_balls.h), on random scenes of up to six
// balls that bounce between walls with friction and spin.
//   CAROM_REFERENCE_SCENES=20000 reference_tests     (default 300)
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "free_balls.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom::reference {
namespace {

constexpr double kDuration = 1.5;  // s

/// Uniform, with few digits, so that the text of the scene says exactly the same.
double draw(std::mt19937_64& random, double low, double high) {
    const double part = static_cast<double>(random() % 1'000'001) * 1e-6;
    return std::round((low + (high - low) * part) * 1e6) * 1e-6;
}

Vec draw_vector(std::mt19937_64& random, double most) {
    Vec v{};
    for (Real& x : v) x = draw(random, -most, most);
    return v;
}

bool is_clear(const World& world, const FreeBall& ball) {
    for (const Wall& wall : world.walls)
        if (dot(wall.normal, ball.position) - wall.offset < ball.radius + 0.01L) return false;
    for (const FreeBall& other : world.balls)
        if (length(ball.position - other.position) < ball.radius + other.radius + 0.01L)
            return false;
    return true;
}

/// A room without a ceiling, and one to six balls in it.
World random_world(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    World world;
    world.gravity = {0, 0, random() % 8 == 0 ? Real(0) : Real(-9.81L)};
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {1, -1}) {
            Wall wall;
            wall.normal[static_cast<std::size_t>(axis)] = side;
            wall.offset = -1;
            wall.restitution = draw(random, 0.9, 1);
            wall.friction = random() % 4 == 0 ? 0 : draw(random, 0, 1);
            world.walls.push_back(wall);
        }
    const std::size_t count = 1 + random() % 6;
    while (world.balls.size() < count) {
        FreeBall ball;
        ball.radius = draw(random, 0.02, 0.3);
        ball.mass = draw(random, 0.01, 3);
        ball.inertia = (random() % 2 == 0 ? 0.4L : 0.6L) * ball.mass * ball.radius * ball.radius;
        ball.restitution = draw(random, 0.9, 1);
        ball.friction = random() % 4 == 0 ? 0 : draw(random, 0, 1);
        ball.position = draw_vector(random, 0.9);
        ball.velocity = draw_vector(random, 4);
        ball.spin = draw_vector(random, random() % 2 == 0 ? 0 : 60);
        if (is_clear(world, ball)) world.balls.push_back(ball);
    }
    return world;
}

std::string text_of(const Vec& v) {
    return fmt::format("[{}, {}, {}]", static_cast<double>(v[0]), static_cast<double>(v[1]),
                       static_cast<double>(v[2]));
}

/// A material of its own for each wall and ball.
std::string scene_text(const World& world) {
    std::string materials, surfaces, balls;
    const auto add_material = [&](const std::string& name, Real restitution, Real friction) {
        materials += fmt::format("  {}: {{restitution: {}, friction: {}}}\n", name,
                                 static_cast<double>(restitution), static_cast<double>(friction));
    };
    for (std::size_t i = 0; i < world.walls.size(); ++i) {
        const Wall& wall = world.walls[i];
        add_material(fmt::format("w{}", i), wall.restitution, wall.friction);
        surfaces += fmt::format(
            "  - {{name: wall{0}, plane: {{normal: {1}, offset: {2}}}, "
            "material: w{0}}}\n",
            i, text_of(wall.normal), static_cast<double>(wall.offset));
    }
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
        const FreeBall& ball = world.balls[i];
        add_material(fmt::format("b{}", i), ball.restitution, ball.friction);
        const auto factor =
            static_cast<double>(ball.inertia / (ball.mass * ball.radius * ball.radius));
        balls += fmt::format(
            "  - {{name: ball{0}, material: b{0}, radius: {1}, mass: {2}, inertia: {3:.1f}, "
            "position: {4}, velocity: {5}, spin: {6}}}\n",
            i, static_cast<double>(ball.radius), static_cast<double>(ball.mass), factor,
            text_of(ball.position), text_of(ball.velocity), text_of(ball.spin));
    }
    return fmt::format(
        "carom: 1\nsimulation: {{duration: {}, gravity: {}}}\nmaterials:\n{}"
        "surfaces:\n{}balls:\n{}",
        kDuration, text_of(world.gravity), materials, surfaces, balls);
}

/// The largest difference of places [m], velocities [m/s] and spins times radius [m/s].
Real difference(const World& a, const World& b) {
    Real worst = 0;
    for (std::size_t i = 0; i < a.balls.size(); ++i) {
        const FreeBall &x = a.balls[i], &y = b.balls[i];
        worst = std::max({worst, length(x.position - y.position), length(x.velocity - y.velocity),
                          x.radius * length(x.spin - y.spin)});
    }
    return worst;
}

Vec vec(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

World state_of(const Motion& motion, double t, World world) {
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
        const BallState state = motion.balls[i].at(t);
        world.balls[i].position = vec(state.position);
        world.balls[i].velocity = vec(state.velocity);
        world.balls[i].spin = vec(state.spin);
    }
    return world;
}

/// The same with every number off by about a rounding of doubles: how far that carries is how well
/// the motion can be known.
World nudged(World world, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto nudge = [&](Real& x) { x *= 1 + (random() % 2 == 0 ? 1 : -1) * 2.2e-16L; };
    for (FreeBall& ball : world.balls)
        for (std::size_t k = 0; k < 3; ++k) {
            nudge(ball.position[k]);
            nudge(ball.velocity[k]);
        }
    return world;
}

long scenes_wanted() {
    constexpr long kScenes = 300;
    const char* text = std::getenv("CAROM_REFERENCE_SCENES");
    return text == nullptr ? kScenes : std::atol(text);
}

TEST(Reference, BouncesOfUpToSixBalls) {
    // In units of what a rounding of the start grows to: carom's own roundings are many.
    constexpr Real kFactor = 1000, kLeast = 1e-13L, kKnown = 1e-7L;
    long instants = 0, impacts = 0;
    Real worst = 0;
    for (long seed = 1; seed <= scenes_wanted(); ++seed) {
        World reference = random_world(static_cast<std::uint64_t>(seed));
        World first = nudged(reference, 1), second = nudged(reference, 2);
        const std::string text = scene_text(reference);
        const SceneResult read = read_scene(text, "reference.yaml");
        ASSERT_TRUE(read.scene) << text;
        const Motion motion = simulate(*read.scene).motion;
        constexpr int kInstants = 30;
        for (int k = 1; k <= kInstants; ++k) {
            const Real step = Real(kDuration) / kInstants;
            for (World* world : {&reference, &first, &second}) world->run(step);
            if (!reference.bounces || !first.bounces || !second.bounces) break;
            const Real spread =
                std::max({difference(reference, first), difference(reference, second), kLeast});
            if (spread > kKnown) break;  // from here on nobody knows
            const Real off =
                difference(reference, state_of(motion, kDuration * k / kInstants, reference));
            worst = std::max(worst, off / spread);
            ASSERT_LE(off, kFactor * spread)
                << "seed " << seed << ", t " << kDuration * k / kInstants << ", off "
                << static_cast<double>(off) << ", spread " << static_cast<double>(spread) << "\n"
                << text;
            ++instants;
        }
        impacts += reference.impacts;
    }
    fmt::print(
        "{} scenes, {} instants, {} impacts: at most {:.3g} times what a rounding of the "
        "start grows to (at most {})\n",
        scenes_wanted(), instants, impacts, static_cast<double>(worst),
        static_cast<double>(kFactor));
    EXPECT_GT(instants, 10 * scenes_wanted());
    EXPECT_GT(impacts, 10 * scenes_wanted());
}

}  // namespace
}  // namespace carom::reference
