// The solver of impacts against Newton and Coulomb in closed form: a single contact, ODE's contact
// solver, and the sweeps that stand in for it.
#include "sim/solve/impact_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/solve/contact_sweeps.h"

namespace carom {
namespace {

constexpr double kSolverRadius = 0.1;

ImpactBody ball(const Vec3& position, const Vec3& velocity, double mass = 1, double k = 0.4) {
    return {position, {velocity, Vec3::Zero()}, mass, k * mass * kSolverRadius * kSolverRadius};
}

SolverContact on_surface(int index, const Vec3& normal, double e, double mu = 0) {
    SolverContact c;
    c.body = index;
    c.normal = normal;
    c.arm = -kSolverRadius * normal;
    c.restitution = e;
    c.friction = mu;
    return c;
}

SolverContact between(int a, int b, const std::vector<ImpactBody>& bodies, double e) {
    SolverContact c;
    c.body = a;
    c.other_body = b;
    c.normal = (bodies[std::size_t(a)].position - bodies[std::size_t(b)].position).normalized();
    c.arm = -kSolverRadius * c.normal;
    c.arm_other = kSolverRadius * c.normal;
    c.restitution = e;
    return c;
}

class LoneContact : public ::testing::TestWithParam<SingleContacts> {};
INSTANTIATE_TEST_SUITE_P(Solvers, LoneContact,
                         ::testing::Values(SingleContacts::kClosedForm, SingleContacts::kOde),
                         [](const auto& solver) {
                             return solver.param == SingleContacts::kOde ? "ode" : "closed_form";
                         });

TEST_P(LoneContact, FrictionAtEveryAzimuth) {
    ImpactSolver solver(GetParam());
    double worst = 0;
    for (const double k : {0.4, 2.0 / 3})
        for (const double mu : {0.05, 0.3})
            for (int azimuth = 0; azimuth < 360; azimuth += 7) {
                const double b = azimuth * M_PI / 180;
                const Vec3 along(std::cos(b), std::sin(b), 0);
                std::vector<ImpactBody> bodies = {
                    ball(Vec3(3, 1, 2), 3 * along - 5 * Vec3::UnitZ(), 1, k)};
                std::vector<SolverContact> contacts = {on_surface(0, Vec3::UnitZ(), 0.8, mu)};
                solver.solve(bodies, contacts, 0);
                const bool grips = mu >= 3 / ((1 + 1 / k) * 1.8 * 5);
                const double v = grips ? 3 / (1 + k) : 3 - mu * 9;
                const double rw = grips ? 3 / (1 + k) : mu * 9 / k;
                worst = std::max(worst,
                                 (bodies[0].velocities.linear - v * along - Vec3(0, 0, 4)).norm());
                worst = std::max(worst, (kSolverRadius * bodies[0].velocities.spin -
                                         rw * Vec3::UnitZ().cross(along))
                                            .norm());
                EXPECT_NEAR(contacts[0].impulse, 9, 1e-13);
                EXPECT_NEAR(contacts[0].tangential_impulse, 3 - v, 1e-13);
            }
    std::printf("friction at every azimuth within %.3g\n", worst);
    EXPECT_LE(worst, 1e-13);
}

// Any speeds, spins, masses, coefficients: one contact's closed form is what ODE makes of it.
TEST(ImpactSolver, OneContactIsAsOdeSolvesIt) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    ImpactSolver closed(SingleContacts::kClosedForm), ode(SingleContacts::kOde);
    double worst = 0;
    int slid = 0, gripped = 0;
    for (int i = 0; i < 500; ++i) {
        std::vector<ImpactBody> bodies = {ball(vector(), 3 * vector(), 0.5 + i % 7),
                                          ball(vector(), 3 * vector(), 2, 2.0 / 3)};
        bodies[1].position = bodies[0].position + 2 * kSolverRadius * vector().normalized();
        for (ImpactBody& b : bodies) b.velocities.spin = 20 * vector();
        std::vector<SolverContact> contacts = {
            i % 2 == 0 ? between(0, 1, bodies, 0.5 + 0.5 * uniform(random))
                       : on_surface(0, vector().normalized(), 0.5 + 0.5 * uniform(random))};
        contacts[0].friction = i % 3 == 0 ? 0 : 0.5 + 0.5 * uniform(random);
        std::vector<ImpactBody> same = bodies;
        std::vector<SolverContact> same_contacts = contacts;
        closed.solve(bodies, contacts, 0);
        ode.solve(same, same_contacts, 0);
        for (std::size_t b = 0; b < 2; ++b) {
            const Velocities &x = bodies[b].velocities, &y = same[b].velocities;
            worst = std::max(worst, (x.linear - y.linear).norm());
            worst = std::max(worst, kSolverRadius * (x.spin - y.spin).norm());
        }
        worst = std::max(worst, std::abs(contacts[0].impulse - same_contacts[0].impulse));
        if (contacts[0].approach_speed > 0 && contacts[0].friction > 0)
            ++(contacts[0].slip_after.norm() > 1e-9 ? slid : gripped);
    }
    std::printf("one contact against ODE: %.3g m/s (%d slid, %d gripped)\n", worst, slid, gripped);
    EXPECT_LE(worst, 1e-13);
    EXPECT_GT(slid, 20);
    EXPECT_GT(gripped, 20);
}

TEST(ImpactSolver, Grooves) {
    ImpactSolver solver;
    for (const double opening : {120.0, 90.0, 40.0})
        for (const double e : {1.0, 0.5, 0.0}) {
            const double a = (90 - opening / 2) * M_PI / 180;
            std::vector<ImpactBody> bodies = {ball(Vec3::Zero(), Vec3(0, 0, -2))};
            std::vector<SolverContact> contacts = {
                on_surface(0, Vec3(std::sin(a), 0, std::cos(a)), e),
                on_surface(0, Vec3(-std::sin(a), 0, std::cos(a)), e)};
            solver.solve(bodies, contacts, 0);
            EXPECT_NEAR(bodies[0].velocities.linear.z(), 2 * e, 1e-13) << opening;
            EXPECT_NEAR(bodies[0].velocities.linear.x(), 0, 1e-14) << opening;
        }
}

TEST(ImpactSolver, FourRedundantContacts) {
    ImpactSolver solver;
    std::vector<ImpactBody> bodies = {ball(Vec3::Zero(), Vec3(0, 0, -2))};
    std::vector<SolverContact> contacts;
    for (const Vec3& n : {Vec3(1, 0, 1), Vec3(-1, 0, 1), Vec3(0, 1, 1), Vec3(0, -1, 1)})
        contacts.push_back(on_surface(0, n.normalized(), 0.7));
    solver.solve(bodies, contacts, 0);
    EXPECT_LE((bodies[0].velocities.linear - Vec3(0, 0, 1.4)).norm(), 1e-13);
}

TEST(ImpactSolver, MassRatios) {
    ImpactSolver solver;
    for (const double ratio : {1e-9, 1e-3, 1.0, 1e6, 1e9}) {
        std::vector<ImpactBody> bodies = {ball(Vec3(0, 0, 0), Vec3(2, 0, 0)),
                                          ball(Vec3(0.2, 0, 0), Vec3(-1, 0, 0), ratio)};
        std::vector<SolverContact> contacts = {between(0, 1, bodies, 0.5)};
        solver.solve(bodies, contacts, 0);
        const double impulse = 1.5 * 3 * ratio / (1 + ratio);
        EXPECT_LE(std::abs(bodies[0].velocities.linear.x() - (2 - impulse)), 1e-13) << ratio;
        EXPECT_LE(std::abs(bodies[1].velocities.linear.x() - (-1 + impulse / ratio)), 1e-13)
            << ratio;
    }
    EXPECT_EQ(solver.sweeps(), 0);
}

/// A line of touching balls, all contacts at once, inelastic: ODE alone reports an error there.
TEST(ImpactSolver, ChainsAtOnceKeepMomentum) {
    ImpactSolver solver;
    for (const std::size_t balls : {3u, 5u, 9u, 20u}) {
        std::vector<ImpactBody> bodies;
        std::vector<SolverContact> contacts;
        for (std::size_t i = 0; i < balls; ++i)
            bodies.push_back(ball(Vec3(0.2 * double(i), 0, 0), Vec3(i == 0 ? 1 : 0, 0, 0)));
        for (int i = 0; i + 1 < static_cast<int>(balls); ++i)
            contacts.push_back(between(i, i + 1, bodies, 0));
        solver.solve(bodies, contacts, 0);
        double sum = 0;
        for (const ImpactBody& b : bodies) {
            sum += b.velocities.linear.x();
            EXPECT_NEAR(b.velocities.linear.x(), 1 / double(balls), 1e-9) << balls;
        }
        EXPECT_NEAR(sum, 1, 1e-13);
    }
}

/// Balls around one in the middle: sweeps find what ODE finds.
TEST(ImpactSweeps, AgreeWithOde) {
    ImpactSolver solver;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    double worst = 0;
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<ImpactBody> bodies = {ball(Vec3::Zero(), Vec3(unit(random), unit(random), 0))};
        std::vector<SolverContact> contacts;
        for (int i = 0; i < 4; ++i) {
            const double a = (90.0 * i + 10 * unit(random)) * M_PI / 180;
            bodies.push_back(ball(0.2 * Vec3(std::cos(a), std::sin(a), 0),
                                  Vec3(unit(random), unit(random), 0), 1 + std::abs(unit(random))));
            contacts.push_back(between(0, i + 1, bodies, 0.5));
        }
        std::vector<ImpactBody> swept = bodies;
        std::vector<SolverContact> swept_contacts = contacts;
        solver.solve(bodies, contacts, 0);
        for (std::size_t i = 0; i < contacts.size(); ++i)
            swept_contacts[i].approach_speed = contacts[i].approach_speed;
        solve_by_gauss_seidel(swept, swept_contacts);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            worst =
                std::max(worst, (bodies[i].velocities.linear - swept[i].velocities.linear).norm());
    }
    std::printf("sweeps and ODE agree within %.3g\n", worst);
    EXPECT_LE(worst, 1e-12);
}

TEST(ImpactSweeps, CoulombsCone) {
    for (int azimuth = 0; azimuth < 360; azimuth += 30) {
        const double b = azimuth * M_PI / 180;
        const Vec3 along(std::cos(b), std::sin(b), 0);
        std::vector<ImpactBody> bodies = {ball(Vec3::Zero(), 3 * along - 5 * Vec3::UnitZ())};
        std::vector<SolverContact> contacts = {on_surface(0, Vec3::UnitZ(), 0.8, 0.05)};
        contacts[0].approach_speed = 5;
        solve_by_gauss_seidel(bodies, contacts);
        EXPECT_LE((bodies[0].velocities.linear - 2.55 * along - Vec3(0, 0, 4)).norm(), 1e-13);
    }
}

/// What approaches a million times slower than all of it moves is solved to the rounding of the
/// velocities, which ODE's answer has: sweeps find no better one.
TEST(ImpactSolver, SlowApproachesInAFastHeapNeedNoSweeps) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    ImpactSolver solver;
    double worst = 0;
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<ImpactBody> bodies;
        for (int i = 0; i < 12; ++i)
            bodies.push_back(
                ball(Vec3(0.2 * (i % 4) + 0.1 * (i / 4 % 2), 0.1 * std::sqrt(3.0) * (i / 4), 0),
                     Vec3(3, 2, 0) + 1e-6 * Vec3(unit(random), unit(random), 0)));
        std::vector<SolverContact> contacts;
        for (int a = 0; a < 12; ++a)
            for (int b = a + 1; b < 12; ++b) {
                const auto at = [&bodies](int i) { return bodies[std::size_t(i)].position; };
                if ((at(a) - at(b)).norm() < 0.201) contacts.push_back(between(a, b, bodies, 0));
            }
        ASSERT_GT(contacts.size(), 20u);
        solver.solve(bodies, contacts, 0);
        for (const SolverContact& c : contacts) worst = std::max(worst, -c.separation_speed);
    }
    std::printf("sweeps %d, still approaching %.3g m/s\n", int(solver.sweeps()), worst);
    EXPECT_EQ(solver.sweeps(), 0);
    EXPECT_LE(worst, 1e-13);
}

}  // namespace
}  // namespace carom
