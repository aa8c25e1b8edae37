// Impacts of one instant at several contacts with friction: both laws at each of them.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "exact_scenes.h"
#include "sim/solve/impact_solver.h"

namespace carom::testing {
namespace {

constexpr double kCoulombR = 0.1;

double energy_of(const std::vector<ImpactBody>& bodies) {
    double sum = 0;
    for (const ImpactBody& b : bodies)
        sum += 0.5 * b.mass * b.velocities.linear.squaredNorm() +
               0.5 * b.inertia * b.velocities.spin.squaredNorm();
    return sum;
}

SolverContact wall_contact(int ball, const Vec3& normal, double restitution, double friction) {
    SolverContact c;
    c.body = ball;
    c.normal = normal.normalized();
    c.arm = -kCoulombR * c.normal;
    c.restitution = restitution;
    c.friction = friction;
    return c;
}

/// A ball that is driven into a groove of 90 degrees while it spins about the groove: it slips on
/// both walls, so that with the impulses J1 and J2
///   J1 + mu J2 = J2 - mu J1 = (1 + e) m v / sqrt(2).
TEST(CoulombImpact, ASpinningBallInAGroove) {
    for (const double mu : {0.8, 0.5, 0.2})
        for (const double e : {0.5, 0.9})
            for (const double speed : {1.0, 0.3}) {
                const double spin = 100;
                std::vector<ImpactBody> bodies(1);
                bodies[0].mass = 1;
                bodies[0].inertia = 0.4 * kCoulombR * kCoulombR;
                bodies[0].velocities = {{0, 0, -speed}, {0, spin, 0}};
                std::vector<SolverContact> contacts = {wall_contact(0, {1, 0, 1}, e, mu),
                                                       wall_contact(0, {-1, 0, 1}, e, mu)};
                ImpactSolver().solve(bodies, contacts, 0);
                const double c = (1 + e) * speed / std::sqrt(2);
                const double small = c * (1 - mu) / (1 + mu * mu);
                const double large = c * (1 + mu) / (1 + mu * mu);
                EXPECT_NEAR(contacts[0].impulse, small, 1e-12) << mu << " " << e;
                EXPECT_NEAR(contacts[1].impulse, large, 1e-12) << mu << " " << e;
                EXPECT_NEAR(contacts[0].tangential_impulse, mu * small, 1e-12) << mu << " " << e;
                EXPECT_NEAR(contacts[1].tangential_impulse, mu * large, 1e-12) << mu << " " << e;
                EXPECT_NEAR(bodies[0].velocities.spin.y(),
                            spin - mu * (small + large) * kCoulombR / bodies[0].inertia, 1e-9);
            }
}

/// What every contact of a solved impact obeys; the largest of what it is off.
struct Off {
    double cone = 0, grip = 0, newton = 0;
};

void add(Off& off, const SolverContact& c, double speed) {
    off.newton = std::max(off.newton, -c.separation_speed / speed);
    off.cone = std::max(off.cone, (c.tangential_impulse - c.friction * c.impulse) / speed);
    // Contacts that give nothing neither grip nor slip.
    if (c.impulse > 1e-12 && c.tangential_impulse < c.friction * c.impulse * (1 - 1e-6))
        off.grip = std::max(off.grip, c.slip_after.norm() / speed);
}

TEST(CoulombImpact, ConesGripAndEnergyInCorners) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1, 1), share(0, 1);
    Off off;
    double gain = 0;
    int friction_acted = 0;
    for (int trial = 0; trial < 400; ++trial) {
        std::vector<ImpactBody> bodies(1);
        bodies[0].mass = 1;
        bodies[0].inertia = (trial % 2 == 0 ? kSolid : kShell) * kCoulombR * kCoulombR;
        const double e = share(random), mu = 1.5 * share(random);
        bodies[0].velocities = {{unit(random), unit(random), -3},
                                Vec3(unit(random), unit(random), unit(random)) * 60};
        std::vector<SolverContact> contacts;
        const int walls = 2 + trial % 3;
        for (int i = 0; i < walls; ++i) {
            const double angle = 2 * M_PI * (i + 0.3 * unit(random)) / walls;
            const double tilt = 0.5 + 0.5 * share(random);
            contacts.push_back(
                wall_contact(0, {tilt * std::cos(angle), tilt * std::sin(angle), 1}, e, mu));
        }
        const double before = energy_of(bodies);
        ImpactSolver().solve(bodies, contacts, 0);
        for (const SolverContact& c : contacts) {
            add(off, c, 3);
            friction_acted += c.tangential_impulse > 0;
        }
        gain = std::max(gain, energy_of(bodies) / before - 1);
    }
    fmt::print("off by: cone {:.2g}, grip {:.2g}, Newton {:.2g}; energy {:.2g}\n", off.cone,
               off.grip, off.newton, gain);
    EXPECT_GT(friction_acted, 400);
    EXPECT_LE(off.cone, 1e-11);
    EXPECT_LE(off.grip, 1e-10);
    EXPECT_LE(off.newton, 1e-10);
    EXPECT_LE(gain, 1e-12);
}

/// A cue ball onto two touching balls, with friction and spin about the axis of symmetry.
TEST(CoulombImpact, ACueBallOntoTwoKeepsMomentumAndSymmetry) {
    for (const double mu : {0.05, 0.2, 0.7})
        for (const double spin : {0.0, 40.0}) {
            std::vector<ImpactBody> bodies(3);
            for (ImpactBody& b : bodies) {
                b.mass = 1;
                b.inertia = 0.4 * kCoulombR * kCoulombR;
            }
            bodies[0].velocities = {{1, 0, 0}, {spin, 0, 0}};
            std::vector<SolverContact> contacts;
            for (const double side : {1.0, -1.0}) {
                SolverContact c;
                c.body = 0;
                c.other_body = side > 0 ? 1 : 2;
                c.normal = -Vec3(std::cos(M_PI / 6), side * std::sin(M_PI / 6), 0);
                c.arm = -kCoulombR * c.normal;
                c.arm_other = kCoulombR * c.normal;
                bodies[static_cast<std::size_t>(c.other_body)].position = -2 * kCoulombR * c.normal;
                c.restitution = 0.9;
                c.friction = mu;
                contacts.push_back(c);
            }
            const double before = energy_of(bodies);
            ImpactSolver().solve(bodies, contacts, 0);
            Vec3 momentum = Vec3::Zero();
            Off off;
            for (const ImpactBody& b : bodies) momentum += b.mass * b.velocities.linear;
            for (const SolverContact& c : contacts) add(off, c, 1);
            EXPECT_LE((momentum - Vec3(1, 0, 0)).norm(), 1e-14) << mu;
            EXPECT_LE(energy_of(bodies), before * (1 + 1e-13)) << mu;
            EXPECT_LE(off.cone, 1e-12) << mu;
            EXPECT_LE(off.grip, 1e-11) << mu;
            EXPECT_NEAR(contacts[0].impulse, contacts[1].impulse, 1e-12) << mu;
            if (spin > 0) {
                EXPECT_GT(contacts[0].tangential_impulse, 0.01) << mu;
            }
        }
}

/// G. Galperin, "Playing pool with the number pi", 2003: a heavy ball, a light one and a wall. With
/// no gap all impacts are at one instant; the light ball's energy and the heavy one's are kept.
TEST(CoulombImpact, ACascadeAtOneInstantKeepsItsEnergy) {
    for (const double gap : {0.0, 1e-14, 1e-12, 1e-9})
        for (const double heavy : {1e2, 1e4, 1e6, 1e7}) {
            Scene scene = exact_scene(1, 0, 0);
            scene.simulation.duration = 1;
            add_plane(scene, Vec3::UnitX());
            add_ball(scene, {kCoulombR + gap, 0, 0}, Vec3::Zero(), kCoulombR).mass = 1;
            add_ball(scene, {3 * kCoulombR + 2 * gap, 0, 0}, {-1, 0, 0}, kCoulombR).mass = heavy;
            use_pair(scene, 1);
            const Motion motion = simulate(scene).motion;
            const double before = kinetic_energy(scene, motion, 0);
            const double after = kinetic_energy(scene, motion, 1);
            EXPECT_NEAR(after / before, 1, 1e-11) << gap << " " << heavy;
            EXPECT_GT(motion.balls[1].at(1).velocity.x(), 0.9) << gap << " " << heavy;
        }
}

}  // namespace
}  // namespace carom::testing
