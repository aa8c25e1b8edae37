// Several contacts at once, and contacts with curved surfaces: H11, H17, H18, H22, H29 to H31.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "case.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

constexpr double kG = 9.81, kRadius = 0.1;

/// V-groove of `degrees`; the centre of a ball that touches both walls is r / sin(half) above it.
Run groove(double degrees) {
    const double half = 0.5 * degrees * M_PI / 180, h = 0.5;
    Run run;
    run.overrides = {set("surfaces.left.plane.normal", Vec3(std::cos(half), 0, std::sin(half))),
                     set("surfaces.right.plane.normal", Vec3(-std::cos(half), 0, std::sin(half))),
                     set("balls.ball.position", Vec3(0, 0, kRadius / std::sin(half) + h))};
    run.measure = [=](const Scene&, const Motion& motion) {
        const double at = std::sqrt(2 * h / kG), t = at + 0.05;
        const BallState s = motion.balls[0].at(t);
        return Measures{relative(fmt::format("{:g}°: speed upwards, m/s", degrees),
                                 s.velocity.z() + kG * (t - at), 0.8 * std::sqrt(2 * kG * h)),
                        scaled("sideways, m", std::abs(s.position.x()), 0, 1, 1e-12)};
    };
    return run;
}

double deepest_of_samples(const Scene& scene, const Motion& motion, int samples) {
    double deepest = 0;
    for (int i = 0; i <= samples; ++i)
        deepest = std::max(deepest, deepest_overlap(scene, motion, motion.duration * i / samples));
    return deepest;
}

/// It stands: depth and speed within limits, and the uppermost ball where it was.
Run stands(double depth_limit) {
    Run run;
    run.measure = [=](const Scene& scene, const Motion& motion) {
        double speed = 0;
        for (const Trajectory& ball : motion.balls)
            speed = std::max(speed, ball.at(motion.duration).velocity.norm());
        const Vec3 top = motion.balls.back().at(motion.duration).position;
        Measure place = vector_measure("uppermost ball, off by m", top, scene.balls.back().position,
                                       1, 10 * depth_limit);
        place.how = fmt::format("falls over or sinks (top ball off by {:.2g} m)", place.value);
        return Measures{
            scaled("depth, m", deepest_of_samples(scene, motion, 100), 0, 1, depth_limit),
            scaled("speed in the end, m/s", speed, 0, 1, 1e-6), place};
    };
    return run;
}

Run pile() {
    Run run;
    run.quick = false;
    run.twice = true;
    run.measure = [](const Scene& scene, const Motion& motion) {
        // Energy above a ball that lies on the floor.
        double floor = 0, outside = 0;
        for (const Ball& b : scene.balls) floor += b.mass * kG * b.radius;
        const double start = total_energy(scene, motion, 0) - floor;
        double least = std::numeric_limits<double>::infinity(), rise = 0;
        const int samples = 1000;
        for (int i = 0; i <= samples; ++i) {
            const double energy = total_energy(scene, motion, motion.duration * i / samples);
            least = std::min(least, energy);
            rise = std::max(rise, energy - least);
        }
        for (const Trajectory& ball : motion.balls) {
            const Vec3 p = ball.at(motion.duration).position;
            outside += std::abs(p.x()) > 0.35 || std::abs(p.y()) > 0.35 || p.z() < 0;
        }
        const double radius = scene.balls[0].radius;
        Measure depth = scaled("depth, m", deepest_of_samples(scene, motion, 100), 0, radius, 0.01);
        depth.how = fmt::format("sinks in by {:.2g} of the radius", depth.value / radius);
        return Measures{scaled("energy above its running minimum, J", rise, 0, start, 1e-6),
                        scaled("balls outside", outside, 0, 1, 0), depth};
    };
    return run;
}

/// Of the angle to the vertical at which the ball's centre stands above the origin at t.
double cosine_at(const Motion& motion, double t) {
    if (!std::isfinite(t)) return t;
    const Vec3 p = motion.balls[0].at(t).position;
    return p.z() / p.norm();
}

Run off_a_sphere(double degrees) {
    const double a = degrees * M_PI / 180, distance = 1;
    Run run;
    run.overrides = {set("balls.ball.position", Vec3(std::sin(a), 0, std::cos(a)))};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const double cosine = 2.0 / 3 * std::cos(a);
        const double start = last_flight_start(scene, motion, 0);
        const double speed = std::sqrt(kG * distance * cosine) * cosine;
        return Measures{relative(fmt::format("{:g}°: leaves at cos", degrees),
                                 cosine_at(motion, start), cosine),
                        relative("horizontal speed in flight, m/s",
                                 motion.balls[0].at(motion.duration).velocity.x(), speed)};
    };
    return run;
}

/// Both are free on a smooth floor: momentum along x and energy give the angle's rate, and they
/// part where that is sqrt(g cos / D).
Run off_a_ball(double degrees, double below_mass) {
    const double a = degrees * M_PI / 180, distance = 0.4, below = 0.3;
    Run run;
    run.overrides = {
        set("balls.ball.position", Vec3(distance * std::sin(a), 0, below + distance * std::cos(a))),
        set("balls.below.mass", below_mass)};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const double p = 1 / (1 + below_mass);
        double low = 0, cosine = std::cos(a);  // of p c^3 - 3 c + 2 cos(a), which falls
        for (int i = 0; i < 100; ++i) {
            const double c = 0.5 * (low + cosine);
            (p * c * c * c - 3 * c + 2 * std::cos(a) > 0 ? low : cosine) = c;
        }
        const double start = last_flight_start(scene, motion, 0);
        double found = start;
        if (std::isfinite(start)) {
            const Vec3 apart =
                motion.balls[0].at(start).position - motion.balls[1].at(start).position;
            found = apart.z() / apart.norm();
        }
        const double along = std::sqrt(kG * distance * cosine) * cosine;
        return Measures{relative(fmt::format("{:g}°, M/m = {:g}: part at cos", degrees, below_mass),
                                 found, cosine),
                        relative("speed of the lower ball, m/s",
                                 -motion.balls[1].at(motion.duration).velocity.x(), p * along)};
    };
    return run;
}

Run off_an_edge(double v) {
    Run run;
    run.overrides = {set("balls.ball.velocity", Vec3(v, 0, 0))};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const double cosine = std::min(1.0, (2 + v * v / (kG * kRadius)) / 3);
        const double start = last_flight_start(scene, motion, 0);
        const double flying = std::sqrt(v * v + 2 * kG * kRadius * (1 - cosine)) * cosine;
        return Measures{
            relative(fmt::format("{:g} m/s: leaves at cos", v), cosine_at(motion, start), cosine),
            relative("horizontal speed in flight, m/s",
                     motion.balls[0].at(motion.duration).velocity.x(), flying)};
    };
    return run;
}

}  // namespace

std::vector<Case> contact_cases() {
    return {{"H11",
             "into a V-groove of 90°, 120°",
             "h11_groove",
             "straight back at e v",
             {groove(90), groove(120)}},
            {"H17", "stack of 10 for 10 s", "h17_stack", "v = 0, depth < 1e-6 m", {stands(1e-6)}},
            {"H18",
             "1000 kg on 1 kg for 10 s",
             "h18_heavy_on_light",
             "v = 0, depth < 1e-5 m",
             {stands(1e-5)}},
            {"H22",
             "pile of 200",
             "h22_pile",
             "energy never rises, depth < 1 % r, none outside",
             {pile()}},
            {"H29",
             "slides off a sphere",
             "h29_off_a_sphere",
             "cos θ = 2/3 cos θ₀",
             {off_a_sphere(30), off_a_sphere(10)}},
            {"H30",
             "slides off an edge",
             "h30_off_an_edge",
             "cos θ = min(1, (2 + v²/gR)/3)",
             {off_an_edge(0.5), off_an_edge(0.9), off_an_edge(2)}},
            {"H31",
             "slides off a ball that gives way",
             "h31_off_a_ball",
             "p cos³θ - 3 cos θ + 2 cos θ₀ = 0, p = m/(m + M)",
             {off_a_ball(30, 1), off_a_ball(30, 5), off_a_ball(10, 0.2)}}};
}

}  // namespace carom::bench
