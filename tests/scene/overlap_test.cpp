// Bodies that touch, and bodies that overlap, at the start.
#include "scene/overlap.h"

#include <fmt/core.h>

#include <random>

#include "geometry/nearest.h"
#include "scene_testing.h"

namespace carom {
namespace {

std::string errors_between(const std::string& surface, const std::string& ball) {
    return errors_of("carom: 1\nsurfaces: [{name: s, " + surface + "}]\nballs:\n  - {name: b, " +
                     ball + "}");
}

std::string overlap_text(const std::string& depth) {
    return "t.yaml:4:5: error: the ball 'b' and the surface 's' overlap by " + depth +
           " m at the start\n";
}

/// What a ball gets to read whose centre is inside of a body.
std::string inside_text(const std::string& depth) {
    return "t.yaml:4:5: error: the ball 'b' and the surface 's' overlap by " + depth +
           " m at the start; surfaces are solid: for a container take a bowl, a pipe, or a room of "
           "planes\n";
}

TEST(Overlap, BallsMayTouch) {
    const auto errors = [](double gap) {
        return errors_of(
            fmt::format("carom: 1\nballs:\n  - {{name: a, radius: 1, position: [0, 0, "
                        "0]}}\n  - {{name: b, radius: 0.5, position: [0, 0, {}]}}",
                        1.5 + gap));
    };
    EXPECT_EQ(errors(0), "");
    EXPECT_EQ(errors(-0.4e-9), "") << "1e-9 of the smaller radius, 0.5 m";
    EXPECT_EQ(errors(-0.6e-9),
              "t.yaml:4:5: error: the balls 'a' and 'b' overlap by 6e-10 m at the start\n");
    EXPECT_EQ(errors(-1.5),
              "t.yaml:4:5: error: the balls 'a' and 'b' overlap by 1.5 m at the start\n");
}

TEST(Overlap, EveryKindOfSurface) {
    const std::string plane = "plane: {normal: [0, 0, 2], offset: 2}";
    EXPECT_EQ(errors_between(plane, "radius: 0.5, position: [7, 7, 1.5]"), "");
    EXPECT_EQ(errors_between(plane, "radius: 0.5, position: [7, 7, 1.25]"), overlap_text("0.25"));
    EXPECT_EQ(errors_between(plane, "radius: 0.5, position: [7, 7, 0.5]"),
              "t.yaml:4:5: error: the ball 'b' is behind the plane 's': its centre is 0.5 m on the "
              "far side\n");
    const std::string sphere = "sphere: {position: [0, 0, 0], radius: 1}";
    EXPECT_EQ(errors_between(sphere, "radius: 0.5, position: [0, 1.5, 0]"), "");
    EXPECT_EQ(errors_between(sphere, "radius: 0.5, position: [0, 1, 0]"), overlap_text("0.5"));
    EXPECT_EQ(errors_between(sphere, "radius: 0.5, position: [0, 0, 0]"), inside_text("1.5"));
    const std::string capsule = "capsule: {from: [0, 0, 0], to: [2, 0, 0], radius: 0.5}";
    EXPECT_EQ(errors_between(capsule, "radius: 0.5, position: [1, 0, 1]"), "");
    EXPECT_EQ(errors_between(capsule, "radius: 0.5, position: [3, 0, 0]"), "");
    EXPECT_EQ(errors_between(capsule, "radius: 0.5, position: [2.5, 0, 0]"), overlap_text("0.5"));
    EXPECT_EQ(errors_between(capsule, "radius: 0.5, position: [1, 0.5, 0]"), overlap_text("0.5"));
    const std::string drum = "cylinder: {from: [0, 0, 0], to: [0, 0, 2], radius: 1}";
    EXPECT_EQ(errors_between(drum, "radius: 0.5, position: [0.5, 0, 2.5]"), "");
    EXPECT_EQ(errors_between(drum, "radius: 0.5, position: [0, 1.25, 1]"), overlap_text("0.25"));
    EXPECT_EQ(errors_between(drum, "radius: 0.5, position: [0, 0, 0.75]"), inside_text("1.25"));
    // 3-4-5 from the rim: 0.5 m away.
    EXPECT_EQ(errors_between(drum, "radius: 0.5, position: [1.3, 0, 2.4]"), "");
    EXPECT_EQ(errors_between(drum, "radius: 0.6, position: [1.3, 0, 2.4]"), overlap_text("0.1"));
    const std::string hoop = "ring: {position: [0, 0, 1], radius: 1, tube_radius: 0.25}";
    EXPECT_EQ(errors_between(hoop, "radius: 0.75, position: [0, 0, 1]"), "");
    EXPECT_EQ(errors_between(hoop, "radius: 0.5, position: [0, 0.5, 1]"), overlap_text("0.25"));
    EXPECT_EQ(errors_between(hoop, "radius: 0.25, position: [1.3, 0, 1.4]"), "");
    const std::string bowl = "bowl: {position: [0, 0, 0], radius: 1}";
    EXPECT_EQ(errors_between(bowl, "radius: 0.5, position: [0, 0.5, 0]"), "");
    EXPECT_EQ(errors_between(bowl, "radius: 0.5, position: [0, 0, -0.75]"), overlap_text("0.25"));
    EXPECT_EQ(errors_between(bowl, "radius: 0.5, position: [0, 0, -1.5]"), "");
    EXPECT_EQ(errors_between(bowl, "radius: 0.5, position: [1.3, 0, 0.4]"), "");
    const std::string tube = "pipe: {from: [0, 0, 0], to: [4, 0, 0], radius: 1, angle_deg: 360}";
    EXPECT_EQ(errors_between(tube, "radius: 0.5, position: [1, 0.5, 0]"), "");
    EXPECT_EQ(errors_between(tube, "radius: 0.5, position: [1, 0, 1.25]"), overlap_text("0.25"));
    const std::string box = "box: {position: [0, 0, 0], size: [2, 4, 6]}";
    EXPECT_EQ(errors_between(box, "radius: 0.5, position: [1.5, 0, 0]"), "");
    EXPECT_EQ(errors_between(box, "radius: 0.5, position: [1.25, 0, 0]"), overlap_text("0.25"));
    EXPECT_EQ(errors_between(box, "radius: 0.5, position: [0, 0, 0]"), inside_text("1.5"));
    // 3-4-5 from the edge at x = 1, y = 2: 0.5 m away.
    EXPECT_EQ(errors_between(box, "radius: 0.5, position: [1.3, 2.4, 0]"), "");
    EXPECT_EQ(errors_between(box, "radius: 0.6, position: [1.3, 2.4, 0]"), overlap_text("0.1"));
    const std::string turned = "box: {size: [2, 4, 6], rotation_deg: [0, 0, 90]}";
    EXPECT_EQ(errors_between(turned, "radius: 0.5, position: [1.5, 0, 0]"), inside_text("1"));
    EXPECT_EQ(errors_between(turned, "radius: 0.5, position: [2.5, 0, 0]"), "");
}

TEST(Overlap, DistancesAgreeWithSampledSurfaces) {
    // A capsule is all spheres along its axis; the nearest of many bounds the distance.
    const CapsuleShape capsule{Vec3(0.3, -0.2, 0.1), Vec3(1, 2, -1), 0.25};
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(-3, 3);
    double worst = 0;
    for (int n = 0; n < 100; ++n) {
        const Vec3 p(uniform(generator), uniform(generator), uniform(generator));
        double nearest = 1e9;
        for (int i = 0; i <= 10000; ++i)
            nearest = std::min(nearest,
                               (p - capsule.from - i / 1e4 * (capsule.to - capsule.from)).norm());
        worst = std::max(worst, std::abs(signed_distance(capsule, p) - (nearest - 0.25)));
    }
    fmt::print("worst difference {} against 1e-6\n", worst);
    EXPECT_LT(worst, 1e-6);
}

/// Balls of radii over six decades, some of them overlapping: the grid against all pairs.
TEST(Overlap, FindsWhatAllPairsFind) {
    std::mt19937_64 generator(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    Scene scene;
    for (int n = 0; n < 1500; ++n) {
        Ball ball;
        ball.radius = std::pow(10, -6 * uniform(generator)) * 0.2;
        ball.position =
            Vec3(uniform(generator), uniform(generator), uniform(generator)) * 2 - Vec3::Ones();
        scene.balls.push_back(ball);
    }
    std::vector<std::pair<int, int>> expected, found;
    for (int i = 0; i < 1500; ++i)
        for (int j = i + 1; j < 1500; ++j) {
            const Ball& a = scene.balls[static_cast<std::size_t>(i)];
            const Ball& b = scene.balls[static_cast<std::size_t>(j)];
            const double depth = a.radius + b.radius - (a.position - b.position).norm();
            if (depth > kTouchingDepth * std::min(a.radius, b.radius)) expected.emplace_back(i, j);
        }
    const OverlapList list =
        find_overlaps(scene, std::vector<bool>(scene.balls.size(), true), std::vector<bool>());
    for (const BallOverlap& overlap : list.balls) found.emplace_back(overlap.first, overlap.second);
    fmt::print("{} overlapping pairs\n", expected.size());
    ASSERT_GT(expected.size(), 50U);
    EXPECT_EQ(found, expected);
}

TEST(Overlap, SurfacesFindWhatAllPairsFind) {
    std::mt19937_64 generator(12);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto point = [&] {
        return Vec3(uniform(generator), uniform(generator), uniform(generator));
    };
    Scene scene;
    for (int n = 0; n < 500; ++n) {
        Ball ball;
        ball.radius = n % 100 == 0 ? 0.3 : 0.05;
        ball.position = 1.5 * point();
        scene.balls.push_back(ball);
    }
    for (int n = 0; n < 30; ++n) {
        Surface surface;
        if (n % 3 == 0) surface.shape = SphereShape{point(), 0.1};
        if (n % 3 == 1) surface.shape = CapsuleShape{point(), point(), 0.1};
        if (n % 3 == 2) surface.shape = BoxShape{point(), Vec3(0.3, 0.1, 0.5), Quat::UnitRandom()};
        scene.surfaces.push_back(surface);
    }
    std::vector<std::pair<int, int>> expected, found;
    for (int b = 0; b < 500; ++b)
        for (int s = 0; s < 30; ++s) {
            const Ball& ball = scene.balls[static_cast<std::size_t>(b)];
            const SurfaceShape& shape = scene.surfaces[static_cast<std::size_t>(s)].shape;
            if (signed_distance(shape, ball.position) < ball.radius - 1e-6)
                expected.emplace_back(b, s);
        }
    const OverlapList list =
        find_overlaps(scene, std::vector<bool>(500, true), std::vector<bool>(30, true));
    for (const SurfaceOverlap& overlap : list.surfaces)
        found.emplace_back(overlap.ball, overlap.surface);
    fmt::print("{} overlapping pairs\n", expected.size());
    ASSERT_GT(expected.size(), 20U);
    EXPECT_EQ(found, expected);
}

TEST(Overlap, AFullCubeOfTouchingBallsIsFine) {
    const Scene scene = scene_of(
        "carom: 1\nballs: [{name: c, radius: 0.5, position: [0, 0, 0], repeat: {count: [22, 22, "
        "22], spacing: 1}}]");
    EXPECT_EQ(scene.balls.size(), 10648U);
}

TEST(Overlap, EndlessOverlapsEnd) {
    // 10,000 balls in one place are 50 million pairs.
    const std::string errors = errors_of(
        "carom: 1\nballs:\n  - {name: c, radius: 0.5, position: [0, 0, 0], repeat: {count: [100, "
        "100, 1], spacing: 0}}");
    EXPECT_EQ(errors.find("t.yaml:3:5: error: the balls 'c_"), 0U) << errors;
}

}  // namespace
}  // namespace carom
