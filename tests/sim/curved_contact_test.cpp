// One ball on one contact without a closed form: slip that turns, spheres, edges (method exact).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "scenes.h"

namespace carom::testing {
namespace {

constexpr double kPlaceBound = 1e-9, kSpeedBound = 2e-9;

/// A step of one ball on one contact sees the lift-off at its end, up to two steps late.
constexpr double kCosineBound = 5e-4;

Scene exact_scene(double restitution, double friction) {
    Scene scene = scene_of(restitution, friction, kGravity, 0.00025);
    scene.simulation.method = Method::kExact;
    return scene;
}

// Slip across a slope: ds/dt = g_t - mu g_n (1 + 1/k) s/|s|, dv/dt = g_t - mu g_n s/|s|, integrated
// by the classical Runge-Kutta method with steps of 1e-5 s.
struct Slip {
    Vec3 slip, velocity, position;
};
Slip slip_reference(const Vec3& g_t, double grip, double k, Slip now, double seconds) {
    const auto rate = [&](const Slip& s) {
        const Vec3 friction = -grip * s.slip.normalized();
        return Slip{g_t + (1 + 1 / k) * friction, g_t + friction, s.velocity};
    };
    const auto ahead = [](const Slip& s, const Slip& d, double h) {
        return Slip{s.slip + h * d.slip, s.velocity + h * d.velocity, s.position + h * d.position};
    };
    const int steps = static_cast<int>(std::lround(seconds / 1e-5));
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i) {
        const Slip a = rate(now), b = rate(ahead(now, a, h / 2)), c = rate(ahead(now, b, h / 2)),
                   d = rate(ahead(now, c, h));
        now = ahead(ahead(ahead(ahead(now, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    }
    return now;
}

TEST(CurvedContact, SlipAcrossSlopeTurns) {  // H28
    for (const double k : {kSolid, kShell}) {
        Scene scene = exact_scene(0, 0.3);
        const Vec3 n = incline(10);
        add_plane(scene, n);
        add_ball(scene, 0.1 * n, Vec3(0, 3, 0)).inertia_factor = k;
        const SimulationResult r = run(scene, 0.25);
        const Vec3 g = scene.simulation.gravity, g_t = g - g.dot(n) * n;
        const Slip end =
            slip_reference(g_t, -0.3 * g.dot(n), k, {Vec3(0, 3, 0), Vec3(0, 3, 0), 0.1 * n}, 0.25);
        const BallState s = r.motion.balls[0].at(0.25);
        const double place = (s.position - end.position).norm();
        const double speed = (s.velocity - end.velocity).norm();
        std::printf("k = %.3g: position off by %.3g m, velocity by %.3g m/s\n", k, place, speed);
        EXPECT_LT(place, kPlaceBound);
        EXPECT_LT(speed, kSpeedBound);
    }
}

TEST(CurvedContact, BallLeavesSphere) {  // H29
    for (const double degrees : {10.0, 30.0}) {
        Scene scene = exact_scene(0, 0);
        Surface dome;
        dome.name = "dome";
        dome.shape = SphereShape{Vec3::Zero(), 0.9};
        dome.material = 2;
        scene.surfaces.push_back(dome);
        const double a = degrees * M_PI / 180;
        add_ball(scene, Vec3(std::sin(a), 0, std::cos(a)));
        const SimulationResult r = run(scene, 1.5);
        const std::vector<Event> leaves = events_of(r.motion, EventKind::kLeave);
        ASSERT_EQ(leaves.size(), 1u);
        const double cosine = leaves[0].normal.z();
        // The state at the departure, from the flight that follows: energy and angle.
        const BallState s = r.motion.balls[0].at(leaves[0].time);
        std::printf("%g deg: leaves at cos = %.9f, 2/3 cos0 = %.9f; v^2/(2g) + z - z0 = %.3g m\n",
                    degrees, cosine, 2.0 / 3 * std::cos(a),
                    s.velocity.squaredNorm() / (2 * kGravity) + s.position.z() - std::cos(a));
        EXPECT_NEAR(cosine, 2.0 / 3 * std::cos(a), kCosineBound);
        EXPECT_NEAR(s.velocity.squaredNorm() / (2 * kGravity) + s.position.z(), std::cos(a),
                    kPlaceBound);
    }
}

TEST(CurvedContact, BallPivotsOverEdge) {      // H30
    for (const double v : {0.3, 0.99, 1.2}) {  // sqrt(g R) = 0.99045
        Scene scene = exact_scene(0, 0);
        Surface table;
        table.name = "table";
        table.shape = BoxShape{Vec3(-1, 0, -0.5), Vec3(2, 2, 1), Quat::Identity()};
        table.material = 2;
        scene.surfaces.push_back(table);
        add_ball(scene, Vec3(-0.1, 0, 0.1), Vec3(v, 0, 0));
        const SimulationResult r = run(scene, 1);
        const std::vector<Event> leaves = events_of(r.motion, EventKind::kLeave);
        ASSERT_EQ(leaves.size(), 1u);
        const BallState s = r.motion.balls[0].at(leaves[0].time);
        // It leaves where v^2 = g R cos, with v^2 = v0^2 + 2 g R (1 - cos).
        const double R = 0.1;
        const double expected = std::min(1.0, (v * v / (kGravity * R) + 2) / 3);
        const double cosine = s.position.z() / R;
        std::printf("v = %g: leaves at cos = %.9f, expected %.9f\n", v, cosine, expected);
        EXPECT_NEAR(cosine, expected, kCosineBound);
    }
}

}  // namespace
}  // namespace carom::testing
