#include "gas_scene.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <random>

namespace carom::bench {

namespace {

constexpr double kRadius = 0.5;  // m
constexpr double kVolume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;

}  // namespace

double side_of(int balls, double packing) { return std::cbrt(balls * kVolume / packing); }

double compressibility(double packing) {
    const double p = packing;
    return (1 + p + p * p - p * p * p) / std::pow(1 - p, 3);
}

double free_path(double packing) {
    // Z = 1 + 4 packing x the density of pairs at contact.
    const double at_contact = (compressibility(packing) - 1) / (4 * packing);
    const double density = packing / kVolume;
    return 1 /
           (std::numbers::sqrt2 * std::numbers::pi * 4 * kRadius * kRadius * density * at_contact);
}

double seconds_between(double packing) {
    const double mean_speed = std::sqrt(8 / std::numbers::pi);
    return free_path(packing) / mean_speed;
}

Scene gas(int balls, double packing, double restitution, unsigned seed) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].name = "ball";
    scene.materials[1].virtual_body = {0, 1};
    PairRule rule;
    rule.between = {1, 1};
    rule.restitution = restitution;
    scene.pairs.push_back(rule);
    scene.simulation.gravity = Vec3::Zero();
    const double side = side_of(balls, packing);
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            Surface plane;
            plane.name = fmt::format("plane{}", scene.surfaces.size());
            plane.shape = PlaneShape{sign * Vec3::Unit(axis), sign > 0 ? 0 : -side};
            scene.surfaces.push_back(plane);
        }
    const int places = static_cast<int>(std::ceil(std::cbrt(balls) - 1e-9));
    std::mt19937 random(seed);
    std::normal_distribution<double> speed(0, 1);
    for (int i = 0; i < balls; ++i) {
        Ball ball;
        ball.name = fmt::format("ball{}", i);
        ball.radius = kRadius;
        ball.material = 1;
        const Vec3 place(i % places, i / places % places, i / places / places);
        ball.position = side / places * (place + Vec3::Constant(0.5));
        for (int axis = 0; axis < 3; ++axis) ball.velocity[axis] = speed(random);
        scene.balls.push_back(ball);
    }
    return scene;
}

}  // namespace carom::bench
