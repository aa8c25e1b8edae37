// Contacts at the start that are moved into (H34), and surfaces that nothing meets (H35).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "case.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

constexpr double kG = 9.81, kRadius = 0.1;

/// Off a floor that falls by `degrees`, with the normal and tangential speeds of H13 at t = 0.
Run off_the_floor(double degrees, double mu, double vt) {
    const double a = degrees * M_PI / 180, vn = 2, e = 0.8, k = 2.0 / 5;
    const Vec3 n(std::sin(a), 0, std::cos(a)), across(0, 1, 0);
    Run run;
    run.overrides = {set("surfaces.floor.plane.normal", n), set("materials.rubber.friction", mu),
                     set("balls.ball.position", kRadius * n),
                     set("balls.ball.velocity", Vec3(vt * across - vn * n))};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const bool grips = mu >= vt / ((1 + 1 / k) * (1 + e) * vn);
        const double along = grips ? vt / (1 + k) : vt - mu * (1 + e) * vn;
        const double spin = grips ? along : mu * (1 + e) * vn / k;  // R w
        const double t = motion.duration;
        const Vec3 after = along * across + e * vn * n;
        const BallState s = motion.balls[0].at(t);
        return Measures{
            vector_measure(fmt::format("{:g}°, mu = {:g}: place, off by m", degrees, mu),
                           s.position,
                           kRadius * n + t * after + 0.5 * t * t * scene.simulation.gravity, 1),
            vector_measure("velocity, off by m/s", s.velocity, after + t * scene.simulation.gravity,
                           vn),
            vector_measure("R w, off by m/s", kRadius * s.spin, spin * n.cross(across), vn)};
    };
    return run;
}

Run out_of_the_groove() {
    Run run;
    run.measure = [](const Scene&, const Motion& motion) {
        const double t = motion.duration, v = 0.8 * 2;
        const BallState s = motion.balls[0].at(t);
        return Measures{relative("height over the start, m",
                                 s.position.z() - std::sqrt(2) * kRadius, v * t - 0.5 * kG * t * t),
                        scaled("sideways, m", std::abs(s.position.x()), 0, 1, 1e-12)};
    };
    return run;
}

/// Equal balls without loss: the upper one stops, the lower one passes the impulse to the floor
/// and back.
Run through_a_ball() {
    Run run;
    run.measure = [](const Scene&, const Motion& motion) {
        const double t = motion.duration;
        return Measures{relative("upper ball, m", motion.balls[0].at(t).position.z(),
                                 3 * kRadius + 2 * t - 0.5 * kG * t * t),
                        relative("lower ball, m", motion.balls[1].at(t).position.z(), kRadius),
                        scaled("its speed, m/s", motion.balls[1].at(t).velocity.norm(), 0, 2)};
    };
    return run;
}

/// H3 beside `surfaces` spheres, capsules and boxes in turn, from 5 m away on.
Run beside(int surfaces) {
    Run run;
    run.prepare = [=](Scene& scene) {
        const int side = static_cast<int>(std::ceil(std::sqrt(surfaces)));
        for (int i = 0; i < surfaces; ++i) {
            const Vec3 at(5 + i % side, -0.5 * side + i / side, 1);
            Surface s = scene.surfaces[0];
            s.name = fmt::format("far{}", i);
            if (i % 3 == 0) s.shape = SphereShape{at, 0.2};
            if (i % 3 == 1) s.shape = CapsuleShape{at, at + 0.5 * Vec3::UnitZ(), 0.2};
            if (i % 3 == 2) s.shape = BoxShape{at, Vec3::Constant(0.3), Quat::Identity()};
            scene.surfaces.push_back(s);
        }
    };
    run.measure = [=](const Scene&, const Motion& motion) {
        const std::vector<double> times = bounce_times(motion, 0, Vec3::UnitZ());
        const std::vector<double> tops = top_heights(motion, 0, Vec3::UnitZ());
        double peak = tops.size() >= 99 ? 1 : NAN;
        for (const double top : tops)
            if (std::abs(top - kRadius - 1) > std::abs(peak - 1)) peak = top - kRadius;
        return Measures{relative(fmt::format("{} surfaces: worst peak, m", surfaces), peak, 1),
                        relative("100th impact, s", at_or_nan(times, 99), 199 * std::sqrt(2 / kG))};
    };
    return run;
}

}  // namespace

std::vector<Case> surface_cases() {
    return {{"H34",
             "into the floor at the start",
             "h34_start",
             "H13's law at t = 0",
             {off_the_floor(0, 0, 0), off_the_floor(30, 0, 0), off_the_floor(0, 0.05, 1),
              off_the_floor(20, 0.5, 1)}},
            {"H34",
             "into a groove at the start",
             "h34_groove",
             "straight back at e v",
             {out_of_the_groove()}},
            {"H34",
             "through a ball to the floor at the start",
             "h34_through",
             "the upper ball comes back at v, the lower one rests",
             {through_a_ball()}},
            {"H35",
             "100 bounces beside 1,000 surfaces",
             "h35_far_surfaces",
             "h_n = 1 m, t_n = (2n−1)√(2h/g); cost as without",
             {beside(0), beside(10), beside(1000)}}};
}

}  // namespace carom::bench
