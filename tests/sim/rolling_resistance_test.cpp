// Rolling resistance and pivoting: closed forms on flat surfaces, independent integrations of the
// equations of motion elsewhere, and that everything comes to rest.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "curved_scenes.h"

namespace carom {
namespace {

using namespace testing;

constexpr double kRollerRadius = 0.1;

/// Materials that meet with these numbers.
Scene resisted_scene(double friction, double rolling, double pivoting) {
    Scene scene = exact_scene(0.5, friction, kGravity);
    if (rolling > 0) scene.materials[1].rolling = rolling;
    if (rolling > 0) scene.materials[2].rolling = 1;
    if (pivoting > 0) scene.materials[1].pivoting = pivoting;
    return scene;
}

/// A ball on the plane through the origin with this normal, that rolls along it with `v`.
Ball& add_rolling(Scene& scene, const Vec3& normal, const Vec3& v) {
    add_plane(scene, normal);
    Ball& ball = add_ball(scene, kRollerRadius * normal, v);
    ball.spin = normal.cross(v) / kRollerRadius;
    return ball;
}

void expect_falling_energy(const Scene& scene, const Motion& motion, int samples = 400) {
    double before = total_energy(scene, motion, 0);
    for (int i = 1; i <= samples; ++i) {
        const double now = total_energy(scene, motion, motion.duration * i / samples);
        EXPECT_LE(now, before + 1e-12 * (1 + std::abs(before))) << i;
        before = now;
    }
}

Motion until_rest(Scene& scene) {
    scene.simulation.duration.reset();
    scene.simulation.max_duration = 60;
    SimulationResult result = simulate(scene);
    EXPECT_EQ(result.report.unrest, "");
    return std::move(result.motion);
}

TEST(RollingResistance, ARollOnALevelFloorStops) {
    // t = v / (mu_r g), d = v^2 / (2 mu_r g), whatever the ball's inertia.
    double worst = 0;
    for (const double k : {kSolid, kShell})
        for (const double rolling : {0.01, 0.08}) {
            const double v = 2;
            Scene scene = resisted_scene(0.5, rolling, 0);
            const double azimuth = 0.3;
            const Vec3 along(std::cos(azimuth), std::sin(azimuth), 0);
            add_rolling(scene, Vec3::UnitZ(), v * along).inertia_factor = k;
            const Motion motion = until_rest(scene);
            const double t = v / (rolling * kGravity), d = v * v / (2 * rolling * kGravity);
            const Event rest = only(motion, EventKind::kRest);
            const BallState end = motion.balls[0].at(motion.duration);
            worst =
                std::max({worst, relative_error(rest.time, t), relative_error(motion.duration, t),
                          (end.position - Vec3(d * along + Vec3(0, 0, kRollerRadius))).norm() / d});
            EXPECT_TRUE(end.velocity.isZero(0) && end.spin.isZero(0));
            expect_falling_energy(scene, motion);
        }
    fmt::print("stops: {:.1e} of 1e-12\n", worst);
    EXPECT_LT(worst, 1e-12);
}

TEST(RollingResistance, ABallThatSlidesIsResistedOnceItRolls) {
    const double mu = 0.2, rolling = 0.03, v0 = 3, k = kSolid;
    Scene scene = resisted_scene(mu, rolling, 0);
    add_plane(scene);
    add_ball(scene, {0, 0, kRollerRadius}, {v0, 0, 0});
    const Motion motion = until_rest(scene);
    // Slides until v = v0 / (1 + k), as without resistance.
    const double v1 = v0 / (1 + k), t1 = (v0 - v1) / (mu * kGravity);
    const double d1 = 0.5 * (v0 + v1) * t1;
    EXPECT_LT(relative_error(only(motion, EventKind::kRoll).time, t1), 1e-12);
    EXPECT_LT(relative_error(motion.duration, t1 + v1 / (rolling * kGravity)), 1e-12);
    EXPECT_LT(relative_error(motion.balls[0].at(motion.duration).position.x(),
                             d1 + v1 * v1 / (2 * rolling * kGravity)),
              1e-12);
    expect_falling_energy(scene, motion);
}

TEST(RollingResistance, UpASlopeItStaysOrComesBack) {
    for (const double degrees : {4.0, 15.0}) {
        const double rolling = 0.08, v = 1.5, k = kSolid, a = degrees * M_PI / 180;
        Scene scene = resisted_scene(0.9, rolling, 0);
        const Vec3 n = incline(degrees), down = Vec3(std::cos(a), 0, -std::sin(a));
        add_rolling(scene, n, -v * down);
        const double slows = kGravity * (std::sin(a) / (1 + k) + rolling * std::cos(a));
        const double top = v / slows, way = 0.5 * v * top;
        const bool stays = std::tan(a) <= (1 + k) * rolling;
        EXPECT_EQ(stays, degrees < 5);
        const Motion motion = stays ? until_rest(scene) : run(scene, 2).motion;
        Vec3 expected = kRollerRadius * n - way * down;
        if (stays) {
            EXPECT_LT(relative_error(motion.duration, top), 1e-12);
        } else {
            const double s = 2 - top;
            expected +=
                0.5 * kGravity * (std::sin(a) / (1 + k) - rolling * std::cos(a)) * s * s * down;
        }
        EXPECT_LT((motion.balls[0].at(motion.duration).position - expected).norm(), 1e-12);
        expect_falling_energy(scene, motion);
    }
}

TEST(RollingResistance, DownASlopeTooSmallItStops) {
    const double rolling = 0.08, v = 1.5, a = 4 * M_PI / 180;
    Scene scene = resisted_scene(0.9, rolling, 0);
    add_rolling(scene, incline(4), v * Vec3(std::cos(a), 0, -std::sin(a)));
    const Motion motion = until_rest(scene);
    const double slows = kGravity * (rolling * std::cos(a) - std::sin(a) / (1 + kSolid));
    EXPECT_LT(relative_error(motion.duration, v / slows), 1e-12);
    expect_falling_energy(scene, motion);
}

TEST(RollingResistance, TakesNoMoreThanFrictionLeaves) {
    Scene scene = resisted_scene(0.2, 0.7, 0);
    add_rolling(scene, Vec3::UnitZ(), {2, 0, 0});
    const Motion motion = until_rest(scene);
    EXPECT_LT(relative_error(motion.duration, 2 / (0.2 * kGravity)), 1e-12);
}

TEST(RollingResistance, ATurningRollIsThatOfItsEquation) {
    // Across a slope: v' = g_t/(1 + k) - mu_r g_n v/|v|, by 20,000 steps of Runge-Kutta.
    const double rolling = 0.05, degrees = 12;
    Scene scene = resisted_scene(0.9, rolling, 0);
    const Vec3 n = incline(degrees), across(0, 1, 0);
    add_rolling(scene, n, 1.2 * across);
    const double g_n = kGravity * n.z();
    const Vec3 g_t = Vec3(0, 0, -kGravity) + g_n * n;
    const auto rate = [&](const Vec3& v) {
        return Vec3(g_t / (1 + kSolid) - rolling * g_n * v.normalized());
    };
    Vec3 x = kRollerRadius * n, v = 1.2 * across;
    const int steps = 20000;
    const double h = 1.0 / steps;
    for (int i = 0; i < steps; ++i) {
        const Vec3 k1 = rate(v), k2 = rate(v + 0.5 * h * k1), k3 = rate(v + 0.5 * h * k2),
                   k4 = rate(v + h * k3);
        x += h * v + h * h / 6 * (k1 + k2 + k3);
        v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    const Motion motion = run(scene, 1).motion;
    const BallState end = motion.balls[0].at(1);
    fmt::print("turning roll: {:.1e}, {:.1e} of 1e-12\n", (end.position - x).norm(),
               (end.velocity - v).norm());
    EXPECT_LT((end.position - x).norm(), 1e-12);
    EXPECT_LT((end.velocity - v).norm(), 1e-12);
    expect_falling_energy(scene, motion);
}

TEST(RollingResistance, AcrossASlopeThatHoldsItTheRollEnds) {
    Scene scene = resisted_scene(0.9, 0.1, 0.001);
    add_rolling(scene, incline(6), {0, 1, 0}).spin += 20 * incline(6);
    const Motion motion = until_rest(scene);
    expect_falling_energy(scene, motion);
    EXPECT_EQ(events_of(motion, EventKind::kRest).size(), 1u);
}

TEST(RollingResistance, InABowlItSwingsLessAndStops) {
    // u = v^2/2 over the angle t: u' + 2 mu_r u = -g L (sin t/(1 + k) + mu_r cos t) on the way up,
    // with N = m (g cos t + v^2/L). A swing from rest at t0 ends where u is 0 again.
    const double rolling = 0.02, L = 0.9, t0 = 0.8, k = kSolid;
    Scene scene = resisted_scene(0.9, rolling, 0);
    add_surface(scene, "bowl",
                BowlShape{Vec3(0, 0, 0), L + kRollerRadius, Vec3::UnitZ(), L + kRollerRadius});
    add_ball(scene, {-L * std::sin(t0), 0, -L * std::cos(t0)});
    // With A sin t + B cos t as the particular solution.
    const double c = kGravity * L, m = 2 * rolling;
    const double A = (-c / (1 + k) * m - c * rolling) / (m * m + 1);
    const double B = (-c * rolling * m + c / (1 + k)) / (m * m + 1);
    const auto particular = [&](double t) { return A * std::sin(t) + B * std::cos(t); };
    const auto u = [&](double t) {
        return particular(t) - particular(-t0) * std::exp(-m * (t + t0));
    };
    double lo = 0, hi = t0;
    for (int i = 0; i < 100; ++i) (u(0.5 * (lo + hi)) > 0 ? lo : hi) = 0.5 * (lo + hi);
    const Motion motion = until_rest(scene);
    double highest = 0;  // on the other side, in the first second
    for (int i = 0; i <= 1'000'000; ++i) {
        const double x = motion.balls[0].at(2e-6 * i).position.x();
        highest = std::max(highest, std::asin(x / L));
    }
    fmt::print("bowl: {:.1e} of 1e-11\n", std::abs(highest - lo));
    EXPECT_NEAR(highest, lo, 1e-11);
    expect_falling_energy(scene, motion, 2000);
    const Vec3 end = motion.balls[0].at(motion.duration).position;
    EXPECT_LE(std::abs(std::asin(end.x() / L)), std::atan((1 + k) * rolling) + 1e-12);
    EXPECT_GT(motion.duration, 3);
}

TEST(RollingResistance, OnAllShapesTheEnergyFallsAndItEnds) {
    for (const double rolling : {0.0, 0.05})
        for (const double pivoting : {0.0, 0.002}) {
            Scene scene = resisted_scene(0.6, rolling, pivoting);
            add_surface(scene, "bowl", BowlShape{Vec3(0, 0, 1), 1, Vec3::UnitZ(), 1});
            add_ball(scene, {0.5, 0, 0.3}, {0, 1.3, 0}).spin = {3, 1, 30};
            scene.materials[1].virtual_body = virtual_body(0);
            const Motion motion = run(scene, 6).motion;
            expect_falling_energy(scene, motion, 3000);
            if (rolling == 0) continue;
            const Motion ended = until_rest(scene);
            EXPECT_TRUE(ended.balls[0].at(ended.duration).velocity.isZero(0));
            if (pivoting > 0) {
                EXPECT_TRUE(ended.balls[0].at(ended.duration).spin.isZero(1e-12));
            }
        }
}

TEST(Pivoting, ATopStops) {
    // I w / (p N) = k R^2 w / (p g)
    double worst = 0;
    for (const double friction : {0.0, 0.5})
        for (const double w : {30.0, -7.0}) {
            const double p = 0.002;
            Scene scene = resisted_scene(friction, 0, p);
            add_plane(scene);
            add_ball(scene, {0, 0, kRollerRadius}).spin = {0, 0, w};
            const Motion motion = until_rest(scene);
            const double t = kSolid * kRollerRadius * kRollerRadius * std::abs(w) / (p * kGravity);
            worst = std::max(worst, relative_error(motion.duration, t));
            EXPECT_NEAR(motion.balls[0].at(0.25 * t).spin.z(), 0.75 * w, 1e-13 * std::abs(w));
            EXPECT_TRUE(motion.balls[0].at(t).spin.isZero(1e-12));
            EXPECT_TRUE(motion.events.empty());  // it rests from the start on, spinning
        }
    fmt::print("tops: {:.1e} of 1e-12\n", worst);
    EXPECT_LT(worst, 1e-12);
}

TEST(Pivoting, AddsAndGoesOnWhateverElseTheBallDoes) {
    const double rolling = 0.05, v = 1;
    Scene scene = resisted_scene(0.5, rolling, 0.001);
    scene.materials[2].pivoting = 0.002;
    add_rolling(scene, Vec3::UnitZ(), {v, 0, 0}).spin.z() = 50;
    const Motion motion = until_rest(scene);
    const double stops = v / (rolling * kGravity);
    const double slows = 0.003 * kGravity / (kSolid * kRollerRadius * kRollerRadius);
    EXPECT_LT(relative_error(only(motion, EventKind::kRest).time, stops), 1e-12);
    EXPECT_LT(relative_error(motion.duration, std::max(stops, 50 / slows)), 1e-12);
    EXPECT_NEAR(motion.balls[0].at(1).spin.z(), 50 - slows, 1e-11);
}

TEST(Pivoting, OnASphereItIsThatOfItsEquations) {
    // Inside a bowl, rolling with spin about the normal: x' = v, v' and w' from Newton and Euler,
    // by Runge-Kutta.
    const double rolling = 0.03, pivoting = 0.004, L = 0.9, mu = 2, k = kSolid;
    Scene scene = resisted_scene(mu, rolling, pivoting);
    add_surface(scene, "bowl",
                BowlShape{Vec3(0, 0, 0), L + kRollerRadius, Vec3::UnitZ(), L + kRollerRadius});
    const Vec3 n0(0.6, 0, 0.8);
    Vec3 x = -L * n0, v(0, 1.5, 0), w = n0.cross(v) / kRollerRadius + 25 * n0;
    Ball& ball = add_ball(scene, x, v);
    ball.spin = w;
    struct Rates {
        Vec3 x, v, w;
    };
    const auto rates = [&](const Vec3& at, const Vec3& vel, const Vec3& spin) {
        const Vec3 n = -at.normalized(), g(0, 0, -kGravity);
        const double N = -g.dot(n) + vel.squaredNorm() / L;
        const Vec3 turn = -vel / L;  // n'
        const Vec3 b = g - g.dot(n) * n - kRollerRadius * spin.dot(n) * n.cross(turn);
        const Vec3 r = rolling * N * vel.normalized();
        const Vec3 f = -k / (1 + k) * b - r;
        const Vec3 moment = -kRollerRadius * n.cross(f) - kRollerRadius * (1 + k) * n.cross(r) -
                            pivoting * N * (spin.dot(n) > 0 ? 1 : -1) * n;
        return Rates{vel, g + N * n + f, moment / (k * kRollerRadius * kRollerRadius)};
    };
    const int steps = 40000;
    const double seconds = 0.2, h = seconds / steps;
    for (int i = 0; i < steps; ++i) {
        const Rates a = rates(x, v, w);
        const Rates b = rates(x + 0.5 * h * a.x, v + 0.5 * h * a.v, w + 0.5 * h * a.w);
        const Rates c = rates(x + 0.5 * h * b.x, v + 0.5 * h * b.v, w + 0.5 * h * b.w);
        const Rates d = rates(x + h * c.x, v + h * c.v, w + h * c.w);
        x += h / 6 * (a.x + 2 * b.x + 2 * c.x + d.x);
        v += h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v);
        w += h / 6 * (a.w + 2 * b.w + 2 * c.w + d.w);
    }
    ASSERT_GT(w.dot(-x.normalized()), 1);  // it spins still
    const Motion motion = run(scene, seconds).motion;
    const BallState end = motion.balls[0].at(seconds);
    fmt::print("in a bowl: {:.1e} {:.1e} {:.1e}\n", (end.position - x).norm(),
               (end.velocity - v).norm(), (end.spin - w).norm());
    EXPECT_LT((end.position - x).norm(), 1e-11);
    EXPECT_LT((end.velocity - v).norm(), 1e-11);
    EXPECT_LT((end.spin - w).norm(), 1e-9);
}

TEST(RollingResistance, ABallInAGrooveStops) {
    Scene scene = resisted_scene(0.6, 0.05, 0.001);
    add_plane(scene, Vec3(1, 0, 1));
    add_plane(scene, Vec3(-1, 0, 1));
    const double height = kRollerRadius * std::sqrt(2.0);
    add_ball(scene, {0, 0, height}, {0, 1, 0}).spin = {-height, 0, 0};
    scene.balls[0].spin = {-1 / (kRollerRadius / std::sqrt(2.0)), 0, 0};
    const Motion motion = until_rest(scene);
    expect_falling_energy(scene, motion);
    // Each wall presses with m g / sqrt(2), or less where friction carries a part, which the step
    // leaves open: not sooner than by all of both, not later than by half.
    EXPECT_GT(motion.duration, 1 / (2 * 0.051 * kGravity));
    EXPECT_LT(motion.duration, 4);
}

TEST(RollingResistance, BallsThatTouchComeToRestOnASlope) {
    Scene scene = resisted_scene(0.6, 0.1, 0.001);
    scene.pairs.push_back({{1, 1}, 0.5, 0.3, {}, {}, 0.05});
    const Vec3 n = incline(4);
    add_plane(scene, n);
    const Vec3 along = Vec3::UnitY();
    for (int i = 0; i < 3; ++i)
        add_ball(scene, kRollerRadius * n + 0.2 * i * along,
                 {0.3, 0, -0.3 * std::tan(4 * M_PI / 180)});
    const Motion motion = until_rest(scene);
    expect_falling_energy(scene, motion);
}

TEST(RollingResistance, APileEndsAndGainsNothing) {
    Scene scene = resisted_scene(0.5, 0.1, 0.001);
    scene.pairs.push_back({{1, 1}, 0.3, 0.4, {}, {}, 0.05});
    add_plane(scene);
    for (int i = 0; i < 36; ++i)
        add_ball(scene,
                 {0.201 * (i % 3) + 0.01 * (i / 9), 0.201 * (i / 3 % 3), 0.1 + 0.21 * (i / 9)});
    const Motion motion = until_rest(scene);
    double before = total_energy(scene, motion, 0);
    for (int i = 1; i <= 200; ++i) {
        const double now = total_energy(scene, motion, motion.duration * i / 200);
        EXPECT_LE(now, before * (1 + 1e-6)) << i;
        before = now;
    }
}

/// v = v0 - mu g t, s = v0^2/(2 mu g), as the step becomes short; and a top's k r^2 w/(p g).
TEST(RollingResistance, FixedConvergesToTheClosedForms) {
    for (const Solver solver : {Solver::kWorld, Solver::kQuick}) {
        double last = 0;
        for (const double step : {1e-3, 5e-4, 2.5e-4}) {
            Scene scene = resisted_scene(0.5, 0.05, 0.001);
            scene.simulation.method = Method::kFixed;
            scene.simulation.solver = solver;
            scene.simulation.step = step;
            add_rolling(scene, Vec3::UnitZ(), {1, 0, 0});
            const SimulationResult result = run(scene, 3);
            EXPECT_TRUE(result.report.effects.at("rolling").on);
            const BallState end = result.motion.balls.front().at(3);
            const double start = scene.balls.front().position.x();
            const double way = 1 / (2 * 0.05 * kGravity);
            const double off = std::abs(end.position.x() - start - way);
            std::printf("step %g: rolls %.6f m, off by %.2g m\n", step, end.position.x() - start,
                        off);
            EXPECT_LT(off, 2 * step);
            EXPECT_LT(end.velocity.norm(), 1e-9);
            if (last > 0) {
                EXPECT_NEAR(0.5, off / last, 0.2);
            }
            last = off;
        }
    }
}

TEST(RollingResistance, FixedSlowsATop) {
    Scene scene = resisted_scene(0.5, 0, 0.002);
    scene.simulation.method = Method::kFixed;
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1});
    scene.balls.front().spin = {0, 0, 10};
    const double rate = 0.002 * kGravity / (0.4 * 0.01);  // rad/s^2
    const Motion motion = run(scene, 3).motion;
    EXPECT_NEAR(10 - rate, motion.balls.front().at(1).spin.z(), 2 * rate * 0.00025);
    EXPECT_NEAR(0, motion.balls.front().at(3).spin.norm(), 1e-9);
}

}  // namespace
}  // namespace carom
