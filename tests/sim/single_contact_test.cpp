// One ball on one contact without a closed form of its path: slip that turns, spheres, edges
// (method exact). Where it lifts off, what it conserves and when its slip ends do have closed
// forms. Capsules: curved_capsule_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "curved_scenes.h"
#include "slip_reference.h"

namespace carom::testing {
namespace {

// ---- Slip that turns
// ------------------------------------------------------------------------------

TEST(SingleContact, SlipAcrossSlopeTurns) {  // H28
    for (const double k : {kSolid, kShell}) {
        Scene scene = exact_scene(0, 0.3, kGravity);
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
        std::printf("k = %.3g: position off by %.3g m, velocity by %.3g m/s, %zu pieces\n", k,
                    place, speed, r.motion.balls[0].pieces().size());
        EXPECT_LT(place, kBound);
        EXPECT_LT(speed, kBound);
        EXPECT_LT(r.motion.balls[0].pieces().size(), 40u);
    }
}

// With g = |g_t|, A = mu g_n (1 + 1/k) and the slip s: d/dt (g_t.s + A |s|) = g^2 - A^2, so the
// slip ends at (g_t.s0 + A |s0|) / (A^2 - g^2); and v - k/(1+k) s always changes by g_t / (1+k).
TEST(SingleContact, TurningSlipEndsInRolling) {
    for (const double degrees : {2.0, 10.0, 25.0})
        for (const double azimuth : {0.5, 1.5, 2.8})
            for (const double k : {kSolid, kShell}) {
                const double mu = 0.35;
                Scene scene = exact_scene(0, mu, kGravity);
                const Vec3 n = incline(degrees, 20);
                add_plane(scene, n);
                const Vec3 g = scene.simulation.gravity, g_t = g - g.dot(n) * n;
                const Vec3 down = g_t.normalized();
                const Vec3 v0 = 2 * (std::cos(azimuth) * down + std::sin(azimuth) * n.cross(down));
                Ball& ball = add_ball(scene, 0.1 * n, v0);
                ball.inertia_factor = k;
                ball.spin = Vec3(1, -2, 5);
                const Vec3 s0 = slip_of(ball, {ball.position, v0, Quat::Identity(), ball.spin}, n);
                const double A = -mu * g.dot(n) * (1 + 1 / k);
                const double expected = (g_t.dot(s0) + A * s0.norm()) / (A * A - g_t.squaredNorm());
                const SimulationResult r = run(scene, expected + 0.2);
                const Event roll = only(r.motion, EventKind::kRoll);
                const double t = expected + 0.1;
                const BallState s = r.motion.balls[0].at(t);
                const Vec3 v = v0 - k / (1 + k) * s0 + t / (1 + k) * g_t;
                const double off = (s.velocity - v).norm();
                std::printf("%g deg, %g rad: rolls at %.12f s, off by %.2g s; v off by %.2g m/s\n",
                            degrees, azimuth, roll.time, roll.time - expected, off);
                EXPECT_NEAR(roll.time, expected, 1e-11);
                EXPECT_LT(off, 1e-11);
                EXPECT_LT(slip_of(scene.balls[0], s, n).norm(), kBound);
            }
}

// ---- Spheres
// --------------------------------------------------------------------------------------

struct Dome {
    Scene scene;
    Vec3 up;
    double distance = 1;
    double start_cosine = 1;
};

/// A ball at an angle from the top of a sphere, gravity along -up.
Dome dome(double degrees, double ball_radius, double dome_radius, double friction,
          const Vec3& up = Vec3::UnitZ()) {
    Dome d{exact_scene(0, friction, kGravity), up.normalized(), ball_radius + dome_radius, 1};
    d.scene.simulation.gravity = -kGravity * d.up;
    const Vec3 center(0.3, -0.2, 0.4);
    add_surface(d.scene, "dome", SphereShape{center, dome_radius});
    const double a = degrees * M_PI / 180;
    const Vec3 side = d.up.unitOrthogonal();
    add_ball(d.scene, center + d.distance * (std::cos(a) * d.up + std::sin(a) * side), Vec3::Zero(),
             ball_radius);
    d.start_cosine = std::cos(a);
    return d;
}

void expect_departure(Dome& d, double cosine, double k, const char* what) {
    // From rest the angle grows like exp(t sqrt(g / D)); some seconds are enough for all.
    const SimulationResult r = run(d.scene, 12 * std::sqrt(d.distance / kGravity));
    const Event leave = only(r.motion, EventKind::kLeave);
    const Trajectory& ball = r.motion.balls[0];
    const double relative = leave.normal.dot(d.up) / cosine - 1;
    const double drift = energy(d.scene, ball.at(leave.time)) - energy(d.scene, ball.at(0));
    const double fall = kGravity * d.distance * (d.start_cosine - cosine);
    std::printf("%s: leaves at %.4f s, cosine off by %.2g; energy by %.2g; %zu pieces\n", what,
                leave.time, relative, drift / fall, ball.pieces().size());
    EXPECT_NEAR(relative, 0, kBound);
    EXPECT_NEAR(drift / fall, 0, kBound);
    EXPECT_LT(ball.pieces().size(), 200u);
    // On the way it stays on the sphere, and its speed is that of the height.
    const Vec3 center = std::get<SphereShape>(d.scene.surfaces[0].shape).center;
    for (int i = 0; i <= 100; ++i) {
        const BallState s = ball.at(leave.time * i / 100);
        const Vec3 q = s.position - center;
        EXPECT_NEAR(q.norm(), d.distance, 1e-13 * (1 + d.distance));
        const double v2 = 2 / (1 + k) * kGravity * (d.distance * d.start_cosine - d.up.dot(q));
        EXPECT_NEAR(s.velocity.squaredNorm(), v2, 1e-11 * fall);
    }
}

TEST(SingleContact, BallLeavesSphere) {  // H29
    for (const double degrees : {1.0, 10.0, 30.0, 60.0}) {
        Dome d = dome(degrees, 0.1, 0.9, 0);
        expect_departure(d, 2.0 / 3 * d.start_cosine, 0, "smooth");
    }
    for (const double radius : {1e-3, 0.02, 3.0}) {
        Dome d = dome(20, radius, 0.5, 0);
        expect_departure(d, 2.0 / 3 * d.start_cosine, 0, "radius of the ball");
    }
    for (const double radius : {0.01, 40.0}) {
        Dome d = dome(20, 0.1, radius, 0);
        expect_departure(d, 2.0 / 3 * d.start_cosine, 0, "radius of the sphere");
    }
    for (const Vec3& up : {Vec3(1, 0, 0), Vec3(-1, 2, 0.5), Vec3(0, 0, -1)}) {
        Dome d = dome(15, 0.1, 0.9, 0, up);
        expect_departure(d, 2.0 / 3 * d.start_cosine, 0, "up elsewhere");
    }
}

// (1 + k) v^2 / 2 = g D (cos0 - cos), and it leaves where v^2 = g D cos: cos = 2 cos0 / (3 + k).
TEST(SingleContact, BallRollsOffSphere) {
    for (const double k : {kSolid, kShell})
        for (const double degrees : {5.0, 40.0}) {
            Dome d = dome(degrees, 0.1, 0.9, 1e12);
            d.scene.balls[0].inertia_factor = k;
            expect_departure(d, 2 / (3 + k) * d.start_cosine, k, "rolling");
        }
}

// With y = (angle's rate)^2, rolling has (1 + k) D y / 2 = g (cos0 - cos) and holds while
// k/(1+k) g sin <= mu (g cos - D y). Sliding has dy/dangle = 2 mu y + 2 g/D (sin - mu cos), solved
// by y = A cos + B sin + C exp(2 mu angle), A = (4 mu^2 - 2)/(1 + 4 mu^2) g/D, B = -6 mu/(1 + 4
// mu^2) g/D. It leaves where g cos = D y.
TEST(SingleContact, RollingBallBeginsToSlideOnSphere) {
    for (const double mu : {0.1, 0.5, 1.5}) {
        Dome d = dome(3, 0.1, 0.9, mu);
        const double g = kGravity, D = d.distance, k = kSolid;
        const auto root = [](const auto& f) {  // from positive to negative in [3, 90] degrees
            double lo = 3 * M_PI / 180, hi = M_PI / 2;
            for (int i = 0; i < 100; ++i) (f(0.5 * (lo + hi)) > 0 ? lo : hi) = 0.5 * (lo + hi);
            return lo;
        };
        const auto rolling = [&](double a) {
            return 2 / (1 + k) * g / D * (d.start_cosine - std::cos(a));
        };
        const double slides = root([&](double a) {
            return mu * (g * std::cos(a) - D * rolling(a)) - k / (1 + k) * g * std::sin(a);
        });
        const double A = (4 * mu * mu - 2) / (1 + 4 * mu * mu) * g / D;
        const double B = -6 * mu / (1 + 4 * mu * mu) * g / D;
        const double C = (rolling(slides) - A * std::cos(slides) - B * std::sin(slides)) *
                         std::exp(-2 * mu * slides);
        const double leaves = root([&](double a) {
            const double y = A * std::cos(a) + B * std::sin(a) + C * std::exp(2 * mu * a);
            return g * std::cos(a) - D * y;
        });
        const SimulationResult r = run(d.scene, 5);
        const double slide_cosine = only(r.motion, EventKind::kSlide).normal.dot(d.up);
        const double leave_cosine = only(r.motion, EventKind::kLeave).normal.dot(d.up);
        std::printf("mu = %g: slides at cos = %.12f, off by %.2g; leaves at %.12f, off by %.2g\n",
                    mu, slide_cosine, slide_cosine - std::cos(slides), leave_cosine,
                    leave_cosine - std::cos(leaves));
        EXPECT_NEAR(slide_cosine, std::cos(slides), kBound);
        EXPECT_NEAR(leave_cosine, std::cos(leaves), 1e-11);
        EXPECT_GT(slides, 4 * M_PI / 180);
        EXPECT_GT(leaves, slides + 0.01);
    }
}

TEST(SingleContact, BallOnTheVeryTopRests) {
    for (const double friction : {0.0, 0.5}) {
        Scene scene = exact_scene(0.5, friction, kGravity);
        add_surface(scene, "dome", SphereShape{Vec3::Zero(), 0.9});
        add_ball(scene, Vec3(0, 0, 1.4)).spin = Vec3(0, 0, 3);
        const SimulationResult r = run(scene, 20);
        const double expected = std::sqrt(2 * 0.4 / kGravity) * 1.5 / 0.5;
        EXPECT_NEAR(only(r.motion, EventKind::kRest).time, expected, 1e-9);
        const BallState s = r.motion.balls[0].at(20);
        EXPECT_NEAR(s.position.z(), 1, 1e-14);
        EXPECT_EQ(s.velocity, Vec3::Zero());
        EXPECT_TRUE(events_of(r.motion, EventKind::kLeave).empty());
    }
}

TEST(SingleContact, MirroredBallsMirror) {
    Scene scene = exact_scene(0, 0.4, kGravity);
    add_surface(scene, "dome", SphereShape{Vec3::Zero(), 0.9});
    for (const double side : {-1.0, 1.0}) {
        const Vec3 n = Vec3(side * 0.3, 0.1, 1).normalized();
        const Vec3 v(0.1 * side, 0.2, 0);
        add_ball(scene, n, v - v.dot(n) * n).spin = Vec3(1, -2 * side, 3 * side);
    }
    const SimulationResult r = run(scene, 1.2);
    ASSERT_EQ(events_of(r.motion, EventKind::kLeave).size(), 2u);
    double worst = 0;
    for (int i = 0; i <= 120; ++i) {
        const BallState a = r.motion.balls[0].at(0.01 * i), b = r.motion.balls[1].at(0.01 * i);
        const Vec3 mirrored(-a.position.x(), a.position.y(), a.position.z());
        worst = std::max(worst, (mirrored - b.position).norm());
    }
    std::printf("mirrored places differ by %.2g m\n", worst);
    EXPECT_LT(worst, kBound);
}

// ---- Edges
// ----------------------------------------------------------------------------------------

// It leaves where v^2 = g R cos, with v^2 = v0^2 + 2 g R (1 - cos); only the part across the edge
// counts, the part along it stays.
TEST(SingleContact, BallPivotsOverEdge) {  // H30
    for (const double R : {0.1, 0.004})
        for (const double fraction : {0.05, 0.3, 0.999, 1.001, 1.5})
            for (const double along : {0.0, 0.7}) {
                const double v = fraction * std::sqrt(kGravity * R);
                Scene scene = exact_scene(0, 0, kGravity);
                add_surface(scene, "table",
                            BoxShape{Vec3(-1, 0, -0.5), Vec3(2, 9, 1), Quat::Identity()});
                add_ball(scene, Vec3(-R, 0, R), Vec3(v, along, 0), R);
                const SimulationResult r = run(scene, R / v + 1);
                const Event leave = only(r.motion, EventKind::kLeave);
                const BallState s = r.motion.balls[0].at(leave.time);
                const double expected = std::min(1.0, (v * v / (kGravity * R) + 2) / 3);
                const double relative = s.position.z() / R / expected - 1;
                std::printf("R = %g, v = %.3f sqrt(g R): leaves at cos = %.12f, off by %.2g\n", R,
                            fraction, s.position.z() / R, relative);
                EXPECT_NEAR(relative, 0, kBound);
                EXPECT_NEAR(s.velocity.y(), along, kBound);
                EXPECT_NEAR(s.position.y(), along * leave.time, kBound);
                EXPECT_GE(leave.time, R / v - kBound);
            }
}

TEST(SingleContact, BallRollsOverEdgeAndCorner) {
    // Rolling over the edge: (1 + k) v^2 / 2 grows by g R (1 - cos), as on a sphere of radius 0.
    Scene scene = exact_scene(0, 1e12, kGravity);
    add_surface(scene, "table", BoxShape{Vec3(-1, 0, -0.5), Vec3(2, 2, 1), Quat::Identity()});
    const double R = 0.1, k = kSolid, v = 0.4;
    add_ball(scene, Vec3(-0.2, 0, R), Vec3(v, 0, 0)).spin = Vec3(0, v / R, 0);
    SimulationResult r = run(scene, 1.5);
    const double expected = ((1 + k) * v * v / (kGravity * R) + 2) / (3 + k);
    double cosine = only(r.motion, EventKind::kLeave).normal.z();
    std::printf("edge: leaves at cos = %.12f, off by %.2g\n", cosine, cosine - expected);
    EXPECT_NEAR(cosine, expected, kBound);

    // Smooth, straight over the corner of a box that stands on its corner's axis: as H30.
    Scene corner = exact_scene(0, 0, kGravity);
    const Quat turn(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()));
    add_surface(corner, "block", BoxShape{Vec3(-std::sqrt(2.0), 0, -1), Vec3(2, 2, 2), turn});
    add_ball(corner, Vec3(-R, 0, R), Vec3(v, 0, 0));
    r = run(corner, 1.5);
    cosine = only(r.motion, EventKind::kLeave).normal.z();
    const double smooth = (v * v / (kGravity * R) + 2) / 3;
    std::printf("corner: leaves at cos = %.12f, off by %.2g\n", cosine, cosine - smooth);
    EXPECT_NEAR(cosine, smooth, 1e-11);
}

}  // namespace
}  // namespace carom::testing
