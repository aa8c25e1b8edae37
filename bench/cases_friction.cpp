// Coulomb friction: H13 - H16, H28.
#include <fmt/core.h>

#include <cmath>

#include "../tests/sim/slip_reference.h"
#include "case.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

constexpr double kG = 9.81, kRadius = 0.1;
constexpr double kSolid = 2.0 / 5, kShell = 2.0 / 3;

/// A bounce at 5 m/s along the normal and 3 m/s across, at `azimuth`.
Run bounce(double mu, double k, double azimuth) {
    const double vn = 5, vt = 3, e = 0.8;
    const Vec3 along(std::cos(azimuth), std::sin(azimuth), 0);
    Run run;
    run.overrides = {set("materials.rubber.friction", mu), set("balls.ball.inertia", k),
                     set("balls.ball.velocity", Vec3(vt * along - vn * Vec3::UnitZ()))};
    run.measure = [=](const Scene&, const Motion& motion) {
        const bool grips = mu >= vt / ((1 + 1 / k) * (1 + e) * vn);
        const double slip = grips ? vt / (1 + k) : vt - mu * (1 + e) * vn;
        const double spin = grips ? slip : mu * (1 + e) * vn / k;  // R w
        const BallState s = motion.balls[0].at(motion.duration);
        const std::string at =
            fmt::format("mu = {}, k = {:.3g}, {:.0f}°: ", mu, k, azimuth * 180 / M_PI);
        return Measures{vector_measure(at + "velocity, off by m/s", s.velocity,
                                       slip * along + e * vn * Vec3::UnitZ(), vt),
                        vector_measure(at + "R w, off by m/s", kRadius * s.spin,
                                       spin * Vec3::UnitZ().cross(along), vt)};
    };
    return run;
}

Case every_azimuth() {
    Case c{"H15", "H13 at 24 azimuths", "h13_friction", "the same at each", {}};
    for (int i = 0; i < 24; ++i) c.runs.push_back(bounce(0.05, kSolid, (15 * i + 7) * M_PI / 180));
    return c;
}

Run slide_to_roll() {
    Run run;
    run.measure = [](const Scene&, const Motion& motion) {
        const double v0 = 7, mu = 0.2, v = 5.0 / 7 * v0, t = 2 * v0 / (7 * mu * kG);
        const BallState begin = motion.balls[0].at(t), end = motion.balls[0].at(2);
        return Measures{
            relative("place where it rolls, m", begin.position.x(), v0 * t - 0.5 * mu * kG * t * t),
            relative("speed there, m/s", begin.velocity.x(), v),
            relative("speed at 2 s, m/s", end.velocity.x(), v),
            relative("R w at 2 s, m/s", kRadius * end.spin.y(), v)};
    };
    return run;
}

Run down_a_slope(double mu, double k) {
    const double a = M_PI / 6;
    Run run;
    run.overrides = {set("materials.rubber.friction", mu), set("balls.ball.inertia", k)};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const bool rolls = mu >= std::tan(a) / (1 + 1 / k);
        const double acceleration =
            rolls ? kG * std::sin(a) / (1 + k) : kG * (std::sin(a) - mu * std::cos(a));
        const Vec3 along(std::cos(a), 0, -std::sin(a));
        const BallState s = motion.balls[0].at(1);
        return Measures{
            relative(fmt::format("mu = {}, k = {:.3g}: way in 1 s, m", mu, k),
                     (s.position - scene.balls[0].position).dot(along), 0.5 * acceleration),
            relative("speed, m/s", s.velocity.dot(along), acceleration)};
    };
    return run;
}

Run slip_across(double k) {
    Run run;
    run.overrides = {set("balls.ball.inertia", k)};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const double a = M_PI / 18, mu = 0.3, t = 0.25;
        const Vec3 normal(std::sin(a), 0, std::cos(a)), g = scene.simulation.gravity;
        const Ball& ball = scene.balls[0];
        const testing::Slip end =
            testing::slip_reference(g - g.dot(normal) * normal, -mu * g.dot(normal), k,
                                    {ball.velocity, ball.velocity, ball.position}, t);
        const BallState s = motion.balls[0].at(t);
        return Measures{
            vector_measure(fmt::format("k = {:.3g}: place at 0.25 s, off by m", k), s.position,
                           end.position, (end.position - ball.position).norm()),
            vector_measure("velocity, off by m/s", s.velocity, end.velocity, 3)};
    };
    return run;
}

}  // namespace

std::vector<Case> friction_cases() {
    return {{"H13",
             "bounce with friction",
             "h13_friction",
             "grips: v_t/(1+k); slips: v_t − μ(1+e)v_n",
             {bounce(0.3, kSolid, 0), bounce(0.05, kSolid, 0), bounce(0.3, kShell, 0),
              bounce(0.05, kShell, 0)}},
            {"H14",
             "slide to roll",
             "h14_slide_to_roll",
             "rolls at 2v₀/(7μg) with 5/7 v₀",
             {slide_to_roll()}},
            every_azimuth(),
            {"H16",
             "rolls or slides down 30°",
             "h16_roll_down",
             "g sin α/(1+k), g(sin α − μ cos α)",
             {down_a_slope(0.6, kSolid), down_a_slope(0.6, kShell), down_a_slope(0.1, kSolid)}},
            {"H28",
             "slip across a slope",
             "h28_slip_across",
             "ds/dt = g_t − μ g_n(1+1/k) ŝ",
             {slip_across(kSolid), slip_across(kShell)}}};
}

}  // namespace carom::bench
