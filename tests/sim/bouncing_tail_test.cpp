// The tail of a bouncing series that is summed carries its friction (method exact).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "curved_scenes.h"
#include "sim/contact/contact.h"

namespace carom::testing {
namespace {

// Whatever the coefficient, z = z0 - g t^2/2 + (sum of (t - t_i) J_i)/m, so that friction mu J
// against a slip that keeps its direction gives
//   v = v0 - mu (v_z + g t),  x = v0 t - mu (z - z0 + g t^2/2),  R w = mu (v_z + g t)/k.
struct Slip {
    double error_v, error_x, error_w;
};

Slip slip_error(double e, double mu, double k, double at_x) {
    const double v0 = 30, drop = 1, t = 3, radius = 0.1;
    Scene scene = exact_scene(e, mu, kGravity);
    add_plane(scene);
    add_ball(scene, Vec3(at_x, 0, radius + drop), Vec3(v0, 0, 0)).inertia_factor = k;
    const SimulationResult r = run(scene, t);
    EXPECT_EQ(only(r.motion, EventKind::kSlide).ball, 0);
    const BallState end = r.motion.balls[0].at(t);
    return {end.velocity.x() - (v0 - mu * kGravity * t),
            end.position.x() - at_x - (v0 * t - mu * (0.5 * kGravity * t * t - drop)),
            radius * end.spin.y() - mu * kGravity * t / k};
}

TEST(BouncingTail, CarriesItsFrictionOnTheLevel) {
    double v = 0, x = 0, w = 0;
    for (const double e : {0.0, 0.2, 0.5, 0.7})
        for (const double mu : {0.01, 0.1, 0.25})
            for (const double k : {kSolid, kShell}) {
                const Slip slip = slip_error(e, mu, k, 0);
                v = std::max(v, std::abs(slip.error_v));
                x = std::max(x, std::abs(slip.error_x));
                w = std::max(w, std::abs(slip.error_w));
            }
    std::printf("v off by %.2g m/s, x by %.2g m, R w by %.2g m/s (1e-12)\n", v, x, w);
    EXPECT_LE(v, 1e-12);
    EXPECT_LE(x, 1e-12);
    EXPECT_LE(w, 1e-12);
}

TEST(BouncingTail, CarriesItsFrictionFarFromTheOrigin) {
    for (const double at_x : {1e3, 1e6, -1e6}) {
        const Slip slip = slip_error(0.5, 0.1, kSolid, at_x);
        const double rounding = std::abs(at_x) * 2.3e-16;
        std::printf("at %g m: v off by %.2g m/s, R w by %.2g m/s (1e-12), x by %.2g m (%.2g)\n",
                    at_x, slip.error_v, slip.error_w, slip.error_x, 8 * rounding);
        EXPECT_LE(std::abs(slip.error_v), 1e-12);
        EXPECT_LE(std::abs(slip.error_w), 1e-12);
        EXPECT_LE(std::abs(slip.error_x), 8 * rounding);
    }
}

/// The series hop by hop, to its very end: tangential place, velocity and spin of a ball that
/// starts on the plane `n` with `separation` and slides on whatever the impacts leave it.
struct Series {
    BallState state;
    double seconds = 0;
};

Series to_the_end(const Vec3& gravity, const Vec3& n, const Ball& ball, double e, double mu) {
    const double R = ball.radius, k = ball.inertia_factor, g_n = -gravity.dot(n);
    const Vec3 g_t = gravity + g_n * n;
    Series s{{ball.position, tangential_part(ball.velocity, n), {}, ball.spin}};
    for (double v = ball.velocity.dot(n); v > 1e-18; v *= e) {
        const double hop = 2 * v / g_n;
        s.seconds += hop;
        s.state.position += hop * s.state.velocity + 0.5 * hop * hop * g_t;
        s.state.velocity += hop * g_t;
        const Vec3 slip = s.state.velocity - R * s.state.spin.cross(n);
        if (slip.isZero(0)) continue;
        const double size = std::min(mu * (1 + e) * v, slip.norm() / (1 + 1 / k));
        const Vec3 f = -size / slip.norm() * slip;
        s.state.velocity += f;
        s.state.spin -= n.cross(f) / (k * R);
    }
    return s;
}

/// How far the motion at the series' end is off what the hops give [m/s, m/s, m].
Vec3 off_series(const Vec3& n, const Vec3& v_t, const Vec3& spin, double e, double mu) {
    Scene scene = exact_scene(e, mu, kGravity);
    add_plane(scene, n);
    Ball& ball = add_ball(scene, 0.1 * n, v_t + 0.2 * n);
    ball.spin = spin;
    const Series hops = to_the_end(scene.simulation.gravity, n, ball, e, mu);
    const BallState end = run(scene, 2 * hops.seconds).motion.balls[0].at(hops.seconds);
    return {(end.velocity - hops.state.velocity).norm(), 0.1 * (end.spin - hops.state.spin).norm(),
            (end.position - hops.state.position).norm()};
}

TEST(BouncingTail, CarriesItsFrictionWhereTheSlipTurns) {
    Vec3 worst = Vec3::Zero();
    for (const double degrees : {5.0, 20.0, 40.0})
        for (const double e : {0.3, 0.6, 0.8})
            for (const double mu : {0.05, 0.3}) {
                const Vec3 n = incline(degrees, 20);
                const Vec3 across = n.cross(Vec3::UnitX()).normalized(), down = across.cross(n);
                worst = worst.cwiseMax(off_series(n, 3 * across + down, Vec3(5, 1, 20), e, mu));
            }
    std::printf("v off by %.2g m/s, R w by %.2g m/s, x by %.2g m (1e-12)\n", worst[0], worst[1],
                worst[2]);
    EXPECT_LE(worst.maxCoeff(), 1e-12);
}

// The slip ends while the hops go on, at some part of the last one's tail.
TEST(BouncingTail, GripThatBeginsInIt) {
    double v = 0, w = 0, x = 0;
    for (const double e : {0.3, 0.5, 0.8})
        for (const double mu : {0.1, 0.5})
            for (const double part : {0.05, 0.3, 0.5, 0.8, 0.95}) {
                // Of 0.2 m/s the hops below 1e-13 m are summed: the last microseconds.
                const double end = 0.4 / (kGravity * (1 - e));
                const double tail = part * 1.3e-6 / (kGravity * (1 - e));
                const double slip = (1 + 1 / kSolid) * mu * (kGravity * (end - tail) - 0.2);
                const Vec3 off =
                    off_series(Vec3::UnitZ(), slip * Vec3::UnitX(), Vec3::Zero(), e, mu);
                v = std::max(v, off[0]);
                w = std::max(w, off[1]);
                x = std::max(x, off[2]);
            }
    std::printf("v off by %.2g m/s, R w by %.2g m/s, x by %.2g m (1e-12)\n", v, w, x);
    EXPECT_LE(v, 1e-12);
    EXPECT_LE(w, 1e-12);
    EXPECT_LE(x, 1e-12);
}

// Rolling from the first hop on: nothing slips in the tail, and nothing is given back.
TEST(BouncingTail, GripAllAlong) {
    const Vec3 off = off_series(Vec3::UnitZ(), Vec3(0.7, 0, 0), Vec3(0, 7, 3), 0.6, 0.4);
    EXPECT_LE(off.maxCoeff(), 1e-14);
    const Vec3 slope = off_series(incline(15), Vec3::Zero(), Vec3::Zero(), 0.6, 0.6);
    std::printf("down a slope: v off by %.2g m/s, x by %.2g m (1e-12)\n", slope[0], slope[2]);
    EXPECT_LE(slope.maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace carom::testing
