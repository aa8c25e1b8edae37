// Impacts of balls on curved pieces: roots of long polynomials, times against fine sampling, and
// whole scenes.
#include "sim/collide/time_of_impact_high_degree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>

#include "exact_scenes.h"
#include "geometry/nearest.h"
#include "sim/exact/exact.h"
#include "sim/math/bernstein_roots.h"

namespace carom::testing {
namespace {

// ---- Roots
// ----------------------------------------------------------------------------------------

/// scale times the product of (u - root).
LongPolynomial product_of(const std::vector<double>& roots, double scale) {
    LongPolynomial p;
    p.c[0] = scale;
    for (const double root : roots) {
        ++p.degree;
        for (std::size_t i = p.degree; i > 0; --i) p.c[i] = p.c[i - 1] - root * p.c[i];
        p.c[0] *= -root;
    }
    return p;
}

std::vector<double> crossings_of(const LongPolynomial& p) {
    std::vector<double> found;
    DownwardCrossings crossings(p);
    for (double u = 0; crossings.next(u);) found.push_back(u);
    EXPECT_FALSE(crossings.capped());
    return found;
}

TEST(DownwardCrossings, FindsEverySecondRoot) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-0.5, 1.5), sign(-1, 1);
    double worst = 0;
    int crossings = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<double> roots;
        const int count = 1 + trial % 8;
        for (int i = 0; i < count; ++i) roots.push_back(place(random));
        std::sort(roots.begin(), roots.end());
        bool apart = true;
        for (std::size_t i = 1; i < roots.size(); ++i) apart &= roots[i] - roots[i - 1] > 0.02;
        if (!apart) continue;
        const double scale = sign(random) < 0 ? -1 : 1;
        // Its sign before the first root.
        bool positive = (scale > 0) == (count % 2 == 0);
        std::vector<double> expected;
        for (const double root : roots) {
            if (positive && root > 0 && root < 1) expected.push_back(root);
            positive = !positive;
        }
        const std::vector<double> found = crossings_of(product_of(roots, scale));
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            worst = std::max(worst, std::abs(found[i] - expected[i]));
        crossings += static_cast<int>(found.size());
    }
    std::printf("%d crossings within %.2g\n", crossings, worst);
    EXPECT_GT(crossings, 500);
    EXPECT_LT(worst, 1e-9);  // eight roots of a power basis: conditioned like that
}

TEST(DownwardCrossings, GrazingIsDecidedBySign) {
    // (u - 0.3)^2 (1 + u^2) - h: a dip to about -h.
    for (const double h : {-1e-9, -1e-14, 0.0, 1e-14, 1e-9}) {
        LongPolynomial p;
        p.degree = 4;
        p.c = {0.09 - h, -0.6, 1.09, -0.6, 1};
        const std::vector<double> found = crossings_of(p);
        if (std::abs(h) > 1e-15) {
            EXPECT_EQ(found.size(), h > 0 ? 1u : 0u) << h;
        }
        if (h > 0) {
            EXPECT_NEAR(found.front(), 0.3 - std::sqrt(h / 1.09), 0.01 * std::sqrt(h) + 1e-8);
        }
    }
}

TEST(DownwardCrossings, RootOnTheBorderOfHalvesIsOne) {
    EXPECT_EQ(crossings_of(product_of({0.5}, -1)), std::vector<double>{0.5});
    const std::vector<double> found = crossings_of(product_of({0.25, 0.5, 0.75}, -1));
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 0.25, 1e-15);
    EXPECT_NEAR(found[1], 0.75, 1e-15);
}

// ---- Times of impact
// ------------------------------------------------------------------------------

Piece random_piece(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&](double size) {
        const double x = unit(random), y = unit(random), z = unit(random);
        return Vec3(size * Vec3(x, y, z));
    };
    Piece p;
    p.start = 2;
    p.position = vector(1);
    p.velocity = vector(3);
    p.acceleration = vector(4);
    Curve curve;
    curve.seconds = 0.5;
    for (Vec3& term : curve.position) term = vector(0.3);
    p.curve = OptionalCurve(curve);
    return p;
}

/// The first time at which a gap turns negative, by sampling.
template <class Gap>
std::optional<double> sampled(const Gap& gap, double seconds) {
    const int looks = 1000;
    if (gap(0) < 0) return std::nullopt;
    for (int i = 1; i <= looks; ++i) {
        double lo = seconds * (i - 1) / looks, hi = seconds * i / looks;
        if (gap(hi) >= 0) continue;
        for (int k = 0; k < 60; ++k) (gap(0.5 * (lo + hi)) < 0 ? hi : lo) = 0.5 * (lo + hi);
        return hi;
    }
    return std::nullopt;
}

TEST(CurvedImpact, TimesAgreeWithSampling) {
    const std::vector<SurfaceShape> shapes = {
        PlaneShape{Vec3(0.6, 0, 0.8), 0.2},
        SphereShape{Vec3(0.2, 0, 0), 0.4},
        CapsuleShape{Vec3(-0.6, 0, 0), Vec3(0.6, 0.3, 0), 0.1},
        BoxShape{Vec3(0, 0.1, 0), Vec3(0.8, 0.5, 0.3),
                 Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))},
        CylinderShape{Vec3(-0.2, 0, 0.1), Vec3(0.3, 0.2, 0), 0.35},
        RingShape{Vec3(0, 0.1, 0), Vec3(1, 2, 3).normalized(), 0.5, 0.1},
        BowlShape{Vec3(0, 0.1, 0), 0.6, Vec3(1, 2, 3).normalized(), 0.8},
        PipeShape{Vec3(-0.5, 0, 0), Vec3(0.5, 0.1, 0), 0.5, Vec3::UnitZ(), 4}};
    std::mt19937 random(11);
    for (const SurfaceShape& shape : shapes) {
        int hits = 0, misses = 0;
        double worst = 0;
        for (int trial = 0; trial < 800; ++trial) {
            const Piece piece = random_piece(random);
            const double from = 2.05, seconds = 0.4, radius = 0.15;
            const auto gap = [&](double s) {
                return nearest_on(shape, piece.position_at(from + s), radius).gap;
            };
            if (gap(0) < 0) continue;
            const std::optional<double> expected = sampled(gap, seconds);
            const TimeOfImpact toi =
                impact_with_surface(high_degree_path(piece, from, seconds), radius, shape, false);
            ASSERT_EQ(toi.state, expected ? ImpactState::kHit : ImpactState::kMiss)
                << "trial " << trial;
            if (!expected) {
                ++misses;
                continue;
            }
            ++hits;
            // A grazing touch has a time as good as the gap's slope allows.
            worst = std::max(worst, std::abs(gap(toi.s)));
        }
        std::printf("%d hits, %d misses, gap at the impact up to %.2g m\n", hits, misses, worst);
        EXPECT_GT(hits, 20);
        EXPECT_GT(misses, 20);
        EXPECT_LT(worst, 1e-13);
    }
}

TEST(CurvedImpact, BallsOnTwoCurves) {
    std::mt19937 random(3);
    int hits = 0;
    double worst = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        const Piece a = random_piece(random);
        Piece b = random_piece(random);
        b.start = 1.9;
        const double from = 2, seconds = 0.35, sum = 0.5;
        const auto gap = [&](double s) {
            return (a.position_at(from + s) - b.position_at(from + s)).norm() - sum;
        };
        if (gap(0) < 0) continue;
        const std::optional<double> expected = sampled(gap, seconds);
        const HighDegreePath path =
            high_degree_path(a, from, seconds).relative_to(high_degree_path(b, from, seconds));
        const TimeOfImpact toi = impact_with_sphere(path, sum, false);
        ASSERT_EQ(toi.state, expected ? ImpactState::kHit : ImpactState::kMiss);
        if (!expected) continue;
        ++hits;
        worst = std::max(worst, std::abs(gap(toi.s)));
    }
    std::printf("%d hits, gap at the impact up to %.2g m\n", hits, worst);
    EXPECT_GT(hits, 20);
    EXPECT_LT(worst, 1e-13);
}

// ---- Scenes
// ---------------------------------------------------------------------------------------

/// A ball that slides or rolls off a level shaft, and what crosses its path.
Scene shaft(double friction, double restitution = 1) {
    Scene scene = exact_scene(restitution, friction, kGravity);
    Surface rail;
    rail.name = "rail";
    rail.shape = CapsuleShape{Vec3(-5, 0, 0), Vec3(5, 0, 0), 0.2};
    rail.material = 2;
    scene.surfaces.push_back(rail);
    const double a = 8 * M_PI / 180, R = 0.1;
    const Vec3 n(0, std::sin(a), std::cos(a)), v(0.9, 0, 0);
    Ball& ball = add_ball(scene, 0.3 * n, v);
    if (friction > 0) ball.spin = n.cross(v) / R;
    return scene;
}

/// The ball's path when nothing is in its way.
Trajectory alone(const Scene& scene, std::size_t ball, double duration) {
    Scene one = scene;
    one.balls = {scene.balls[ball]};
    one.surfaces.resize(1);
    return run(one, duration).motion.balls[0];
}

TEST(CurvedImpact, FlyingBallMeetsOneOnAShaft) {
    for (const double friction : {0.0, 0.5}) {
        Scene scene = shaft(friction);
        const double met = 0.33;
        const Trajectory path = alone(scene, 0, 1);
        // Aimed so that it arrives about then, from above and from the side, off centre.
        const Vec3 v(0.5, -1, -2), x = path.at(met).position + Vec3(0.02, 0.05, 0.19);
        add_ball(scene, x - met * v - 0.5 * kGravity * met * met * Vec3::UnitZ(),
                 v + kGravity * met * Vec3::UnitZ());
        const Trajectory other = alone(scene, 1, 1);
        const std::optional<double> expected = sampled(
            [&](double t) { return (path.at(t).position - other.at(t).position).norm() - 0.2; },
            0.6);
        ASSERT_TRUE(expected);
        const SimulationResult r = run(scene, 0.6);
        const std::vector<Event> impacts = impacts_of(r.motion);
        ASSERT_FALSE(impacts.empty());
        std::printf("met at %.12f s, off by %.2g s\n", impacts[0].time,
                    impacts[0].time - *expected);
        EXPECT_FALSE(impacts[0].other.is_surface);
        EXPECT_NEAR(impacts[0].time, *expected, 1e-12);
        // Nothing sinks into the shaft.
        for (int i = 0; i <= 600; ++i)
            for (const Trajectory& ball : r.motion.balls) {
                const Vec3 p = ball.at(0.001 * i).position;
                EXPECT_GT(std::hypot(p.y(), p.z()), 0.3 - 1e-12);
            }
    }
}

TEST(CurvedImpact, GrazingIsDecidedBySignOnACurve) {
    for (const double clearance : {-1e-9, 1e-9}) {
        Scene scene = shaft(0, 0.5);
        const double met = 0.4;
        const Trajectory path = alone(scene, 0, 1);
        const BallState at = path.at(met);
        // Passes across, at right angles to the relative motion; no gravity difference matters at
        // the nearest point, so that its distance is corrected once by what sampling finds.
        const Vec3 side = Vec3(0, at.position.y(), at.position.z()).normalized();
        Vec3 x = at.position + 0.2 * side;
        const Vec3 v = at.velocity + Vec3(3, 0, 0);
        const auto nearest = [&](const Vec3& place) {
            double least = 1;
            for (int i = -2000; i <= 2000; ++i) {
                const double s = 2e-5 * i;
                const Vec3 p = place + s * v - 0.5 * kGravity * s * s * Vec3::UnitZ();
                least = std::min(least, (p - path.at(met + s).position).norm());
            }
            return least - 0.2;
        };
        for (int i = 0; i < 4; ++i) x += (clearance - nearest(x)) * side;
        EXPECT_NEAR(nearest(x), clearance, 1e-13);
        const double back = 0.03;  // it starts so long before
        Scene late = shaft(0, 0.5);
        const BallState start = path.at(met - back);
        late.balls[0].position = start.position;
        late.balls[0].velocity = start.velocity;
        late.balls[0].spin = start.spin;
        add_ball(late, x - back * v - 0.5 * kGravity * back * back * Vec3::UnitZ(),
                 v + kGravity * back * Vec3::UnitZ());
        const SimulationResult r = run(late, 2 * back);
        const std::vector<Event> impacts = impacts_of(r.motion);
        const auto met_ball = std::count_if(impacts.begin(), impacts.end(),
                                            [](const Event& e) { return !e.other.is_surface; });
        // Pressed onto the shaft it may rebound from it, and meet the other once more.
        EXPECT_EQ(met_ball > 0, clearance < 0) << clearance;
    }
}

TEST(CurvedImpact, BallOnAShaftMeetsSurfaces) {
    const std::vector<SurfaceShape> walls = {
        PlaneShape{-Vec3::UnitX(), -0.35},
        PlaneShape{Vec3(-0.6, -0.8, 0), -0.3},
        BoxShape{Vec3(0.6, 0.2, 0.3), Vec3(0.3, 0.3, 0.3), Quat::Identity()},
        SphereShape{Vec3(0.5, 0.1, 0.35), 0.12},
        CapsuleShape{Vec3(0.5, 0, -1), Vec3(0.5, 0.2, 1), 0.05},
        CylinderShape{Vec3(0.45, 0.1, 0.5), Vec3(0.5, 0.1, 0.3), 0.2},
        RingShape{Vec3(0.55, 0, 0.35), Vec3(1, 0.2, 0.3).normalized(), 0.2, 0.08}};
    for (const SurfaceShape& wall : walls) {
        Scene scene = shaft(0.5);
        const Trajectory path = alone(scene, 0, 1);
        Surface surface;
        surface.name = "wall";
        surface.shape = wall;
        surface.material = 2;
        scene.surfaces.push_back(surface);
        const std::optional<double> expected =
            sampled([&](double t) { return nearest_on(wall, path.at(t).position, 0.1).gap; }, 0.6);
        ASSERT_TRUE(expected);
        const SimulationResult r = run(scene, 0.7);
        const std::vector<Event> impacts = impacts_of(r.motion);
        ASSERT_FALSE(impacts.empty());
        const auto first = std::find_if(impacts.begin(), impacts.end(),
                                        [](const Event& e) { return e.other.index == 1; });
        ASSERT_NE(first, impacts.end());
        std::printf("met at %.12f s, off by %.2g s\n", first->time, first->time - *expected);
        EXPECT_NEAR(first->time, *expected, 1e-12);
    }
}

// A row of equal balls on the very top of a level shaft: the speed is handed on, and all stay on
// it.
TEST(CurvedImpact, RowOnAShaftHandsSpeedOn) {
    Scene scene = shaft(0);
    scene.balls.clear();
    add_ball(scene, Vec3(-1, 0, 0.3), Vec3(2, 0, 0));
    for (int i = 0; i < 3; ++i) add_ball(scene, Vec3(0.5 * i, 0, 0.3));
    const SimulationResult r = run(scene, 1.5);
    const std::vector<Event> impacts = impacts_of(r.motion);
    ASSERT_EQ(impacts.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(impacts[i].time, 0.4 + 0.15 * static_cast<double>(i), 1e-13);
    for (std::size_t i = 0; i < 4; ++i) {
        const BallState s = r.motion.balls[i].at(1.5);
        EXPECT_NEAR(s.velocity.x(), i == 3 ? 2 : 0, 1e-13);
        EXPECT_NEAR(s.position.z(), 0.3, 1e-14);
    }
}

// Many balls on a dome and above it: the grid changes nothing.
TEST(CurvedImpact, GridChangesNothing) {
    Scene scene = exact_scene(0.6, 0.3, kGravity);
    use_pair(scene, 0.6, 0.3);
    Surface dome;
    dome.name = "dome";
    dome.shape = SphereShape{Vec3(0, 0, -3), 3};
    dome.material = 2;
    scene.surfaces.push_back(dome);
    for (int i = 0; i < 40; ++i) {
        const double x = 0.31 * (i % 7 - 3) + 0.01 * std::sin(i), y = 0.29 * (i / 7 - 3);
        if (i % 2 == 0)
            add_ball(scene, Vec3(x, y, 0.6 + 0.02 * i));
        else
            add_ball(scene, Vec3(0, 0, -3) + 3.1 * Vec3(x, y, 3).normalized());
    }
    scene.simulation.duration = 1.0;
    ExactOptions with, without;
    with.balls_for_grid = 2;
    without.balls_for_grid = 1000;
    const SimulationResult a = simulate_exact(scene, {}, {}, with);
    const SimulationResult b = simulate_exact(scene, {}, {}, without);
    std::printf("%lld impacts\n", static_cast<long long>(a.report.impacts));
    EXPECT_GT(a.report.impacts, 20);
    EXPECT_EQ(a.motion.hash(), b.motion.hash());
}

}  // namespace
}  // namespace carom::testing
