// A ball on a ball that another support holds, or that gives way; a ball in a groove or on rails:
// integrated together (method exact). Where they part has closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "curved_scenes.h"

namespace carom::testing {
namespace {

/// Ball 1 stands on the floor z = 0; ball 0 stands on it, `degrees` off its top towards +x.
struct BallOnBall {
    Scene scene;
    double start_cosine = 1, distance = 1;
};

BallOnBall ball_on_ball(double degrees, double friction, double radius = 0.1, double below = 0.3,
                        double mass_below = 1) {
    BallOnBall b;
    b.scene = exact_scene(0, 0, kGravity);
    use_pair(b.scene, 0, friction);
    add_plane(b.scene);
    const double angle = degrees * M_PI / 180;
    b.start_cosine = std::cos(angle);
    b.distance = radius + below;
    const Vec3 top(0, 0, below);
    add_ball(b.scene, top + b.distance * Vec3(std::sin(angle), 0, std::cos(angle)), Vec3::Zero(),
             radius);
    add_ball(b.scene, top, Vec3::Zero(), below).mass = mass_below;
    return b;
}

/// What holds ball 1 from behind.
void add_wall(BallOnBall& b) { add_plane(b.scene, Vec3::UnitX(), -b.scene.balls[1].radius); }

/// The cosine of the angle at which the balls part, and how far off it may be.
void expect_parting(BallOnBall& b, double cosine, const char* what) {
    const SimulationResult r = run(b.scene, 4);
    const std::vector<Event> rows = events_of(r.motion, EventKind::kLeave);
    const auto left = std::find_if(rows.begin(), rows.end(), [](const Event& e) {
        return e.ball == 0 && !e.other.is_surface;
    });
    ASSERT_NE(left, rows.end()) << what;
    EXPECT_EQ(r.report.steps, 0) << what;
    const double found = left->normal.z();
    std::printf("%s: part at cos = %.12f, off by %.2g, %zu pieces\n", what, found, found - cosine,
                r.motion.balls[0].pieces().size());
    EXPECT_NEAR(found, cosine, 1e-11) << what;
}

// Held by a wall, ball 1 is a sphere of the surroundings: H29.
TEST(CoupledContacts, SlidesOffHeldBall) {
    for (const double degrees : {1.0, 10.0, 30.0, 60.0}) {
        BallOnBall b = ball_on_ball(degrees, 0);
        add_wall(b);
        expect_parting(b, 2.0 / 3 * b.start_cosine, "smooth, held");
    }
    for (const double radius : {0.02, 0.15}) {
        BallOnBall b = ball_on_ball(20, 0, radius, 0.2, 0.01);
        add_wall(b);
        expect_parting(b, 2.0 / 3 * b.start_cosine, "smooth, a light one held");
    }
}

// Momentum along x and energy give the angle's rate; p = m/(m + M):
// D rate^2 (1 - p cos^2) / 2 = g (cos0 - cos), and they part where D rate^2 = g cos.
TEST(CoupledContacts, SlidesOffBallThatGivesWay) {
    for (const double degrees : {5.0, 30.0})
        for (const double mass : {0.1, 1.0, 20.0}) {
            BallOnBall b = ball_on_ball(degrees, 0, 0.1, 0.3, mass);
            const double p = 1 / (1 + mass);
            double lo = 0, hi = b.start_cosine;
            for (int i = 0; i < 100; ++i) {
                const double c = 0.5 * (lo + hi);
                (p * c * c * c - 3 * c + 2 * b.start_cosine > 0 ? lo : hi) = c;
            }
            expect_parting(b, lo, "smooth, free");
        }
}

/// Between 3 and 90 degrees, where f falls from positive to negative.
template <class F>
double falling_root(const F& f) {
    double lo = 3 * M_PI / 180, hi = M_PI / 2;
    for (int i = 0; i < 100; ++i) (f(0.5 * (lo + hi)) > 0 ? lo : hi) = 0.5 * (lo + hi);
    return lo;
}

// Rolling on a ball that is held but turns freely: the friction is k' m D angle'', k' = k / (1 +
// m/M), so that all is as on a sphere for a ball with this k'. With y = (angle's rate)^2: rolling
// has (1 + k') D y / 2 = g (cos0 - cos) and holds while k'/(1 + k') g sin <= mu (g cos - D y).
// Sliding has dy/dangle = 2 mu y + 2 g/D (sin - mu cos), solved by y = A cos + B sin + C exp(2 mu
// angle).
TEST(CoupledContacts, RollsAndSlidesOffHeldBallThatTurns) {
    for (const double mass : {0.2, 1.0, 50.0})
        for (const double mu : {0.1, 0.5}) {
            BallOnBall b = ball_on_ball(3, mu, 0.1, 0.3, mass);
            add_wall(b);
            // Friction pulls the ball below forward in the end: a block stands there.
            add_surface(b.scene, "block",
                        BoxShape{Vec3(0.4, 0, 0.17), Vec3(0.2, 1, 0.34), Quat::Identity()});
            const double g = kGravity, D = b.distance, k = kSolid / (1 + 1 / mass);
            const auto rolling_y = [&](double angle) {
                return 2 * g * (b.start_cosine - std::cos(angle)) / ((1 + k) * D);
            };
            const double slides = falling_root([&](double angle) {
                return mu * (g * std::cos(angle) - D * rolling_y(angle)) -
                       k / (1 + k) * g * std::sin(angle);
            });
            const double A = (4 * mu * mu - 2) / (1 + 4 * mu * mu) * g / D;
            const double B = -6 * mu / (1 + 4 * mu * mu) * g / D;
            const auto particular = [&](double a) { return A * std::cos(a) + B * std::sin(a); };
            const double C = (rolling_y(slides) - particular(slides)) * std::exp(-2 * mu * slides);
            const double leaves = falling_root([&](double angle) {
                return g * std::cos(angle) - D * (particular(angle) + C * std::exp(2 * mu * angle));
            });
            const SimulationResult r = run(b.scene, 3);
            const auto row = [&](EventKind kind) {
                const std::vector<Event> rows = events_of(r.motion, kind);
                const auto found = std::find_if(rows.begin(), rows.end(), [](const Event& e) {
                    return e.ball == 0 && !e.other.is_surface;
                });
                EXPECT_NE(found, rows.end()) << event_kind_name(kind);
                return found == rows.end() ? Event{} : *found;
            };
            const double slide_cosine = row(EventKind::kSlide).normal.z();
            const double leave_cosine = row(EventKind::kLeave).normal.z();
            std::printf(
                "M %g, mu %g: slides at cos = %.12f, off by %.2g, leaves at %.12f, off by "
                "%.2g, %lld steps, %zu pieces\n",
                mass, mu, slide_cosine, slide_cosine - std::cos(slides), leave_cosine,
                leave_cosine - std::cos(leaves), static_cast<long long>(r.report.steps),
                r.motion.balls[0].pieces().size());
            EXPECT_EQ(r.report.steps, 0);
            EXPECT_NEAR(slide_cosine, std::cos(slides), 1e-11);
            EXPECT_NEAR(leave_cosine, std::cos(leaves), 1e-9);
        }
}

// Ball 1 rolls on the floor, and ball 0 on it. Lagrange's equations have the place along x as a
// cyclic coordinate: its momentum m v + M V + k M R W - k m r w keeps its value, W and w the spins
// about y.
TEST(CoupledContacts, RollsOffBallThatRolls) {
    for (const double mass : {0.5, 1.0, 5.0}) {
        BallOnBall b = ball_on_ball(10, 10, 0.1, 0.3, mass);
        b.scene.materials[1].friction = 10;
        b.scene.materials[2].friction = 1;
        const SimulationResult r = run(b.scene, 0.3);
        ASSERT_EQ(r.report.steps, 0);
        const Motion& m = r.motion;
        const double start = total_energy(b.scene, m, 0);
        double energy = 0, momentum = 0, slip = 0, angle = 0;
        for (double t = 0; t <= 0.3; t += 0.01) {
            const BallState top = m.balls[0].at(t), below = m.balls[1].at(t);
            const Vec3 n = (top.position - below.position).normalized();
            energy = std::max(energy, std::abs(total_energy(b.scene, m, t) - start));
            momentum = std::max(momentum, std::abs(top.velocity.x() + mass * below.velocity.x() +
                                                   kSolid * mass * 0.3 * below.spin.y() -
                                                   kSolid * 0.1 * top.spin.y()));
            slip = std::max(
                slip, (top.velocity - below.velocity - (0.1 * top.spin + 0.3 * below.spin).cross(n))
                          .norm());
            slip = std::max(slip, std::abs(below.velocity.x() - 0.3 * below.spin.y()));
            angle = std::acos(n.z()) * 180 / M_PI;
        }
        std::printf("M = %g: energy off by %.2g J, momentum by %.2g, slip %.2g m/s, angle %.3g\n",
                    mass, energy, momentum, slip, angle);
        EXPECT_GT(angle, 15);
        EXPECT_LT(energy, kBound);
        EXPECT_LT(momentum, kBound);
        EXPECT_LT(slip, 1e-11);
    }
}

// On a ball so heavy that nothing moves it, all happens as on a sphere: rolling, sliding, leaving.
TEST(CoupledContacts, HeavyBallIsASphere) {
    for (const double mu : {0.1, 0.5}) {
        BallOnBall b = ball_on_ball(3, mu, 0.1, 0.9, 1e13);
        const SimulationResult linked = run(b.scene, 3);
        Scene dome = b.scene;
        dome.balls.pop_back();
        dome.pairs.clear();
        dome.materials[1].friction = mu;
        dome.materials[2].friction = 1;
        add_surface(dome, "dome", SphereShape{Vec3(0, 0, 0.9), 0.9});
        const SimulationResult alone = run(dome, 3);
        const auto leave = [](const SimulationResult& r) {
            const std::vector<Event> rows = events_of(r.motion, EventKind::kLeave);
            EXPECT_FALSE(rows.empty());
            return rows.empty() ? Event{} : rows.front();
        };
        const Event a = leave(linked), s = leave(alone);
        EXPECT_EQ(linked.report.steps, 0);
        std::printf("mu %g: leaves at %.12f s, on the sphere at %.12f s, points %.2g m apart\n", mu,
                    a.time, s.time, (a.point - s.point).norm());
        EXPECT_NEAR(a.time, s.time, 1e-9);
        EXPECT_LT((a.point - s.point).norm(), 1e-9);
    }
}

// In a groove, friction on both sides holds the ball back by mu N each, and turns it until it
// rolls.
TEST(CoupledContacts, SlidesDownGroove) {
    const double mu = 0.2, a = 40 * M_PI / 180, half = M_PI / 4;
    Scene scene = exact_scene(0, mu, kGravity);
    const Vec3 up(std::sin(a), 0, std::cos(a)), along(std::cos(a), 0, -std::sin(a));
    const Vec3 left = std::cos(half) * up + std::sin(half) * Vec3::UnitY();
    const Vec3 right = std::cos(half) * up - std::sin(half) * Vec3::UnitY();
    add_plane(scene, left);
    add_plane(scene, right);
    add_ball(scene, 0.1 / std::cos(half) * up);
    const SimulationResult r = run(scene, 1);
    EXPECT_EQ(r.report.steps, 0);
    const double push = kGravity * std::cos(a) / (2 * std::cos(half));
    const double acceleration = kGravity * std::sin(a) - 2 * mu * push;
    const BallState end = r.motion.balls[0].at(1);
    const Vec3 way = end.position - scene.balls[0].position;
    std::printf("way %.15f m, expected %.15f m, off the line by %.2g m, %zu pieces\n",
                along.dot(way), 0.5 * acceleration, (way - along.dot(way) * along).norm(),
                r.motion.balls[0].pieces().size());
    EXPECT_NEAR(along.dot(way), 0.5 * acceleration, kBound);
    EXPECT_LT((way - along.dot(way) * along).norm(), kBound);
}

// A third ball meets two that act on each other: momentum along the floor is kept through the
// impact and all that follows, energy never rises, and nothing sinks in.
TEST(CoupledContacts, HitFromOutside) {
    for (const double restitution : {0.0, 0.5, 1.0})
        for (const double time : {0.1, 0.15, 0.19}) {  // they part at 0.197 s
            BallOnBall b = ball_on_ball(30, 0);
            b.scene.pairs.front().restitution = restitution;
            // It comes along the floor, without friction, and meets the lower ball.
            add_ball(b.scene, Vec3(-0.55 - 2 * time, 0, 0.25), Vec3(2, 0, 0), 0.25).mass = 3;
            const SimulationResult r = run(b.scene, 1);
            const std::vector<Event> impacts = impacts_of(r.motion);
            ASSERT_FALSE(impacts.empty());
            const double hit = impacts.front().time;
            EXPECT_LT(hit, 0.197);
            const Vec3 start = momentum(b.scene, r.motion, 0);
            double least = total_energy(b.scene, r.motion, 0), rise = 0, drift = 0, overlap = 0;
            for (double t = 0; t <= 1; t += 1e-3) {
                const double energy = total_energy(b.scene, r.motion, t);
                rise = std::max(rise, energy - least);
                least = std::min(least, energy);
                const Vec3 p = momentum(b.scene, r.motion, t) - start;
                drift = std::max({drift, std::abs(p.x()), std::abs(p.y())});
                for (std::size_t i = 0; i < 3; ++i)
                    for (std::size_t k = 0; k < i; ++k)
                        overlap =
                            std::max(overlap, b.scene.balls[i].radius + b.scene.balls[k].radius -
                                                  (r.motion.balls[i].at(t).position -
                                                   r.motion.balls[k].at(t).position)
                                                      .norm());
            }
            std::printf(
                "e %g, hit at %.4f s: momentum off by %.2g, energy rises by %.2g J, "
                "overlap %.2g m, %lld steps\n",
                restitution, hit, drift, rise, overlap, static_cast<long long>(r.report.steps));
            EXPECT_LT(drift, 1e-10);
            EXPECT_LT(rise, 1e-10);
            EXPECT_LT(overlap, 1e-9);
        }
}

}  // namespace
}  // namespace carom::testing
