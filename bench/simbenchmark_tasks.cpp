#include "simbenchmark_tasks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "piece_sampling.h"

namespace carom::bench {

namespace {

constexpr double kG = 9.81, kRadius = 0.1, kMass = 10;

Scene empty_scene(double restitution, double duration) {
    Scene scene;
    scene.materials.resize(1);
    PairRule rule;
    rule.restitution = restitution;
    scene.pairs = {rule};
    scene.simulation.duration = duration;
    scene.simulation.gravity = Vec3(0, 0, -kG);
    Surface ground;
    ground.name = "ground";
    scene.surfaces = {ground};
    return scene;
}

void add_ball(Scene& scene, const Vec3& position) {
    Ball ball;
    ball.name = fmt::format("ball{}", scene.balls.size());
    ball.radius = kRadius;
    ball.mass = kMass;
    ball.position = position;
    scene.balls.push_back(ball);
}

/// 0.21 m apart, each coordinate more by U(0, 0.001) m.
void add_grid(Scene& scene, double lowest, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return 1e-3 * static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            for (int k = 0; k < 6; ++k) {
                const double x = uniform(), y = uniform(), z = uniform();
                add_ball(scene, Vec3(0.21 * i + x, 0.21 * j + y, lowest + 0.21 * k + z));
            }
}

double energy_of(const Scene& scene, const SteppedWorld& world) {
    double sum = 0;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Ball& b = scene.balls[i];
        const double inertia = b.inertia_factor * b.mass * b.radius * b.radius;
        sum += 0.5 * b.mass * world.velocity(i).squaredNorm() +
               0.5 * inertia * world.spin(i).squaredNorm() + b.mass * kG * world.position(i).z();
    }
    return sum;
}

/// Sum of overlap^2 over pairs of balls, and balls with the ground z = 0.
double overlap_of(const std::vector<Vec3>& places) {
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double depth = kRadius - places[i].z();
        if (depth > 0) sum += depth * depth;
        for (std::size_t j = 0; j < i; ++j) {
            const double square = (places[i] - places[j]).squaredNorm();
            if (square >= 4 * kRadius * kRadius) continue;
            const double overlap = 2 * kRadius - std::sqrt(square);
            sum += overlap * overlap;
        }
    }
    return sum;
}

double energy_at_start(const Task& task) {
    double sum = 0;
    for (const Ball& b : task.scene.balls) sum += b.mass * kG * b.position.z();
    return sum;
}

std::size_t sample_count(const Task& task, double step) {
    return static_cast<std::size_t>(*task.scene.simulation.duration / step);
}

double mean_square_difference(const std::vector<double>& values, double from) {
    double sum = 0;
    for (const double value : values) sum += (value - from) * (value - from);
    return sum / static_cast<double>(values.size());
}

}  // namespace

Task bouncing() {
    Task task{"Bouncing",
              TaskKind::kEnergy,
              "J²",
              empty_scene(1, 20),
              {1e-1, 4e-2, 1e-2, 4e-3, 1e-3, 4e-4, 1e-4, 4e-5, 1e-5}};
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 7; ++j) add_ball(task.scene, Vec3(2 * i, 2 * j, 5));
    return task;
}

Task elastic_666(std::uint64_t seed) {
    Task task{
        "Elastic 666", TaskKind::kEnergy, "J²", empty_scene(1, 10), {1e-2, 4e-3, 1e-3, 4e-4, 1e-4},
        true};
    add_grid(task.scene, 1.101, seed);
    return task;
}

Task inelastic_666(std::uint64_t seed) {
    Task task{"666", TaskKind::kOverlap, "m²", empty_scene(0, 10), {1e-2, 4e-3, 1e-3, 4e-4, 1e-4},
              true};
    add_grid(task.scene, 0.101, seed);
    return task;
}

double stepped_error(const Task& task, SteppedWorld& world, double step) {
    const std::size_t samples = sample_count(task, step), balls = task.scene.balls.size();
    const double start = energy_at_start(task);
    std::vector<Vec3> places(balls);
    double sum = 0;
    for (std::size_t k = 0; k < samples; ++k) {
        if (task.kind == TaskKind::kEnergy) {
            const double difference = energy_of(task.scene, world) - start;
            sum += difference * difference;
        } else {
            for (std::size_t i = 0; i < balls; ++i) places[i] = world.position(i);
            sum += overlap_of(places);
        }
        world.step();
    }
    return sum / static_cast<double>(samples);
}

double motion_error(const Task& task, const Motion& motion, double sampling) {
    const std::size_t samples = sample_count(task, sampling), balls = task.scene.balls.size();
    if (task.kind == TaskKind::kEnergy)
        return mean_square_difference(sample_energies(task.scene, motion, sampling, samples),
                                      energy_at_start(task));
    std::vector<Vec3> places(balls);
    double sum = 0;
    for (std::size_t k = 0; k < samples; ++k) {
        for (std::size_t i = 0; i < balls; ++i)
            places[i] = motion.balls[i].at(static_cast<double>(k) * sampling).position;
        sum += overlap_of(places);
    }
    return sum / static_cast<double>(samples);
}

double sample(const Task& task, const Motion& motion, double sampling) {
    const std::size_t samples = sample_count(task, sampling);
    double sum = 0;
    for (const double e : sample_energies(task.scene, motion, sampling, samples)) sum += e;
    return sum;
}

double bouncing_place_error(const Task& task, const std::vector<Vec3>& places) {
    const double height = 5 - kRadius, fall = std::sqrt(2 * height / kG);
    const double since = std::fmod(*task.scene.simulation.duration - fall, 2 * fall);
    const double z = kRadius + since * (kG * fall - 0.5 * kG * since);
    double worst = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vec3& from = task.scene.balls[i].position;
        worst = std::max(worst, (places[i] - Vec3(from.x(), from.y(), z)).norm());
    }
    return worst;
}

}  // namespace carom::bench
