// Impacts that grip and spring back: the formulas of R. L. Garwin ("Kinematics of an ultraelastic
// rough ball", Am. J. Phys. 37, 88, 1969) and R. Cross ("Grip-slip behavior of a bouncing ball",
// Am. J. Phys. 70, 1093, 2002), the cone of friction, and the energy.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exact_scenes.h"
#include "sim/contact/contact_laws.h"
#include "sim/solve/impact_solver.h"

namespace carom {
namespace {

using namespace testing;

constexpr double kSpringyRadius = 0.1;

/// A ball that meets the floor at -v_n, with v_x and spin w about y; the state behind.
BallState bounce(double e, double b, double mu, double k, double v_x, double w, Method method) {
    Scene scene = exact_scene(e, mu, 0);
    scene.simulation.method = method;
    scene.materials[1].tangential_restitution = b;
    add_plane(scene);
    Ball& ball = add_ball(scene, {0, 0, kSpringyRadius + 0.5}, {v_x, 0, -5});
    ball.inertia_factor = k;
    ball.spin = {0, w, 0};
    const auto result = run(scene, 0.15);
    EXPECT_EQ(result.report.impacts, 1);
    return result.motion.balls[0].at(0.15);
}

TEST(TangentialRestitution, GarwinsSuperballAndCrosssFormula) {
    for (const Method method : {Method::kExact, Method::kFixed})
        for (const double k : {kSolid, kShell})
            for (const double b : {1.0, 0.6, 0.0, -0.5, -1.0})
                for (const double w : {0.0, 20.0, -35.0}) {
                    const double v = 3;
                    const BallState s = bounce(0.8, b, 10, k, v, w, method);
                    // The slip v - R w becomes -b times itself, and k R w + v keeps (the angular
                    // momentum about the contact).
                    const double slip = -b * (v - kSpringyRadius * w),
                                 kept = v + k * kSpringyRadius * w;
                    const double w_after = (kept - slip) / ((1 + k) * kSpringyRadius);
                    EXPECT_NEAR(s.velocity.x(), slip + kSpringyRadius * w_after, 1e-13);
                    EXPECT_NEAR(s.spin.y(), w_after, 1e-12);
                    EXPECT_NEAR(s.velocity.z(), 4, 1e-13);
                }
    // Garwin: a superball without spin leaves with 3/7 of its speed, and R w = 10/7 of it.
    const BallState s = bounce(1, 1, 10, kSolid, 3, 0, Method::kExact);
    EXPECT_NEAR(s.velocity.x(), 3 * 3.0 / 7, 1e-14);
    EXPECT_NEAR(kSpringyRadius * s.spin.y(), 3 * 10.0 / 7, 1e-14);
}

TEST(TangentialRestitution, FrictionsConeStaysTheLimit) {
    const double mu = 0.1;  // mu (1 + e) v_n = 0.9 < (1 + b) k/(1 + k) 3
    for (const Method method : {Method::kExact, Method::kFixed}) {
        const BallState s = bounce(0.8, 0.7, mu, kSolid, 3, 0, method);
        EXPECT_NEAR(s.velocity.x(), 3 - mu * 1.8 * 5, 1e-13);
        EXPECT_NEAR(kSpringyRadius * s.spin.y(), mu * 1.8 * 5 / kSolid, 1e-12);
    }
}

TEST(TangentialRestitution, APairMultipliesWhatIsNamed) {
    Scene scene = exact_scene(0.8, 10, 0);
    add_plane(scene);
    add_ball(scene, {0, 0, kSpringyRadius}, {1, 0, -5});
    const auto left = [&] {
        const BallState s = run(scene, 0.01).motion.balls[0].at(0.01);
        return -(s.velocity.x() - kSpringyRadius * s.spin.y());
    };
    EXPECT_NEAR(left(), 0, 1e-14);
    scene.materials[1].tangential_restitution = 0.5;
    EXPECT_NEAR(left(), 0.5, 1e-14);
    scene.materials[2].tangential_restitution = 0.4;
    EXPECT_NEAR(left(), 0.2, 1e-14);
    scene.pairs.push_back({{1, 2}, {}, {}, {}, {}, {}, {}, -0.3});
    EXPECT_NEAR(left(), -0.3, 1e-14);
}

TEST(TangentialRestitution, ClustersObeyTheConeAndGainNoEnergy) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    ContactLaws laws;
    ImpactSolver solver;
    int met = 0;
    for (int trial = 0; trial < 300; ++trial) {
        laws.tangential_restitution = any(random);
        // A ball in a corner, or two that meet the floor and each other.
        const bool corner = trial % 2 == 0;
        std::vector<ImpactBody> bodies;
        for (int i = 0; i < (corner ? 1 : 2); ++i)
            bodies.push_back({Vec3(0.2 * i, 0, 0),
                              {Vec3(any(random) - i, any(random), any(random) - 1),
                               Vec3(9 * any(random), 9 * any(random), 9 * any(random))},
                              1 + 0.5 * i,
                              0.4 * (1 + 0.5 * i) * kSpringyRadius * kSpringyRadius});
        std::vector<SolverContact> contacts;
        const auto add = [&](int body, int other, const Vec3& normal) {
            SolverContact c;
            c.body = body;
            c.other_body = other;
            c.normal = normal;
            c.arm = -kSpringyRadius * normal;
            if (other >= 0) c.arm_other = kSpringyRadius * normal;
            c.restitution = 0.7;
            c.friction = 0.5;
            c.laws = &laws;
            contacts.push_back(c);
        };
        add(0, -1, Vec3::UnitZ());
        if (corner)
            add(0, -1, Vec3::UnitX());
        else
            add(0, 1, -Vec3::UnitX());
        const auto energy = [&bodies] {
            double sum = 0;
            for (const ImpactBody& b : bodies)
                sum += 0.5 * b.mass * b.velocities.linear.squaredNorm() +
                       0.5 * b.inertia * b.velocities.spin.squaredNorm();
            return sum;
        };
        const double before = energy();
        solver.solve(bodies, contacts, 0);
        EXPECT_LE(energy(), before * (1 + 1e-12)) << trial;
        for (const SolverContact& c : contacts) {
            EXPECT_LE(c.tangential_impulse, c.friction * c.impulse * (1 + 1e-9) + 1e-12) << trial;
            const bool grips = c.tangential_impulse < 0.99 * c.friction * c.impulse;
            if (!grips || std::abs(c.separation_speed - 0.7 * c.approach_speed) > 1e-9) continue;
            ++met;
            EXPECT_LT((c.slip_after + laws.tangential_restitution * c.slip).norm(), 1e-9) << trial;
        }
    }
    EXPECT_GT(met, 50);
    EXPECT_EQ(solver.sweeps(), 0);
}

TEST(TangentialRestitution, EnergyNeverRisesOverALongBounce) {
    for (const double b : {1.0, 0.5, -0.5}) {
        Scene scene = exact_scene(0.8, 0.4, kGravity);
        scene.materials[1].tangential_restitution = b;
        add_plane(scene);
        add_plane(scene, -Vec3::UnitX(), -2);
        add_ball(scene, {0, 0, 1}, {2, 0.5, 0}).spin = {5, -40, 3};
        const auto result = run(scene, 8);
        ASSERT_GT(result.report.impacts, 20);
        double before = total_energy(scene, result.motion, 0);
        for (int i = 1; i <= 4000; ++i) {
            const double now = total_energy(scene, result.motion, 0.002 * i);
            EXPECT_LE(now, before * (1 + 1e-11)) << i;
            before = now;
        }
    }
}

}  // namespace
}  // namespace carom
