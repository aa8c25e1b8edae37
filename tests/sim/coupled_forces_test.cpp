// The laws of motion of balls that lasting contacts link (method exact).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "curved_scenes.h"
#include "sim/law/contact_modes.h"

namespace carom::testing {
namespace {

std::mt19937_64 numbers(3);
Vec3 random_vector() {
    std::normal_distribution<double> normal;
    return {normal(numbers), normal(numbers), normal(numbers)};
}

/// One ball on a sphere, as the only contact of a system.
CoupledContacts one_contact(const SingleContact& contact, ContactMode mode, double mass) {
    CoupledContacts system;
    system.ball_count = system.contact_count = 1;
    system.balls[0] = {contact.radius, mass, contact.inertia_factor};
    system.contacts[0].feature = contact;
    system.contacts[0].friction = contact.friction;
    system.contacts[0].mode = mode;
    system.gravity = contact.gravity;
    return system;
}

// With one contact the equations have the solution that single_contact_forces() writes down.
TEST(CoupledForces, OneContactIsTheClosedForm) {
    double worst = 0;
    for (int i = 0; i < 200; ++i)
        for (const ContactMode mode :
             {ContactMode::kSmooth, ContactMode::kSliding, ContactMode::kRolling}) {
            const double radius = 0.05 + 0.1 * i / 200;
            SingleContact c = single_contact(SphereShape{Vec3::Zero(), 0.7},
                                             (0.7 + radius) * random_vector().normalized(),
                                             Vec3::Zero(), radius, Vec3(0, 0, -kGravity));
            c.friction = 0.3;
            c.inertia_factor = kShell;
            const double mass = std::pow(10.0, i % 7 - 3);
            CoupledContacts system = one_contact(c, mode, mass);
            CoupledState state;
            state[0] = {c.origin + c.distance * random_vector().normalized(), random_vector(),
                        random_vector()};
            project(system, state);
            const SingleContactForces closed = single_contact_forces(c, mode, state[0]);
            const CoupledForces f = coupled_forces(system, state);
            worst = std::max({worst, (f.acceleration[0] - closed.acceleration).norm() / kGravity,
                              radius * (f.spin_rate[0] - closed.spin_rate).norm() / kGravity,
                              std::abs(f.contacts[0].push / mass - closed.push) / kGravity});
        }
    std::printf("off by %.2g of g\n", worst);
    EXPECT_LT(worst, 1e-13);
}

/// Two balls in a corner of three planes, all touching: a system with five contacts.
CoupledContacts corner(CoupledState& state, double friction) {
    CoupledContacts system;
    system.gravity = Vec3(0.5, -1, -9);
    system.ball_count = 2;
    system.balls[0] = {0.1, 1, kSolid};
    system.balls[1] = {0.2, 3, kShell};
    const double along = std::sqrt(0.3 * 0.3 - 2 * 0.1 * 0.1);
    state[0] = {Vec3(0.1, 0.1, 0.1), Vec3::Zero(), Vec3::Zero()};
    state[1] = {Vec3(0.2, 0.2, 0.1 + along), Vec3::Zero(), Vec3::Zero()};
    const auto wall = [&](int ball, const Vec3& normal) {
        CoupledContact& c = system.contacts[system.contact_count++];
        c.ball = ball;
        c.feature.across = normal * normal.transpose();
        c.feature.distance = system.balls[static_cast<std::size_t>(ball)].radius;
        c.friction = friction;
    };
    wall(0, Vec3::UnitX());
    wall(0, Vec3::UnitZ());
    wall(1, Vec3::UnitX());
    CoupledContact& both = system.contacts[system.contact_count++];
    both.ball = 0;
    both.other = 1;
    both.feature.distance = 0.3;
    both.friction = friction;
    return system;
}

// Energy: the power of all forces is that of gravity and of friction against slips; and nothing
// that presses opens or shuts.
TEST(CoupledForces, PowerIsThatOfGravityAndFriction) {
    double worst = 0, gap = 0;
    int slides = 0, rolls = 0;
    for (int i = 0; i < 200; ++i) {
        CoupledState state;
        CoupledContacts system = corner(state, 0.3);
        for (std::size_t b = 0; b < 2; ++b) {
            state[b].v = random_vector();
            state[b].w = 5 * random_vector();
        }
        for (std::size_t c = 0; c < system.contact_count; ++c) {
            const bool roll = (i >> c) % 2 == 1;
            system.contacts[c].mode = roll ? ContactMode::kRolling : ContactMode::kSliding;
            ++(roll ? rolls : slides);
        }
        project(system, state);
        const CoupledForces f = coupled_forces(system, state);
        double power = 0, expected = 0, size = 1;
        for (std::size_t b = 0; b < 2; ++b) {
            const CoupledBall& ball = system.balls[b];
            power += ball.mass * (state[b].v.dot(f.acceleration[b]) +
                                  ball.inertia_factor * ball.radius * ball.radius *
                                      state[b].w.dot(f.spin_rate[b]));
            expected += ball.mass * state[b].v.dot(system.gravity);
            size += ball.mass * state[b].v.norm() * (f.acceleration[b].norm() + 10);
        }
        for (std::size_t c = 0; c < system.contact_count; ++c) {
            expected += f.contacts[c].friction.dot(f.contacts[c].slip);
            gap = std::max(gap, std::abs(f.contacts[c].departure));
        }
        worst = std::max(worst, std::abs(power - expected) / size);
    }
    std::printf("power off by %.2g, gaps open by %.2g m/s^2, %d slide, %d roll\n", worst, gap,
                slides, rolls);
    EXPECT_LT(worst, 1e-12);
    EXPECT_LT(gap, 1e-9);
    EXPECT_GT(std::min(slides, rolls), 100);
}

// Slips that begin grow in the direction against which friction acts, all at the same time.
TEST(CoupledForces, SlipsBeginInTheirDirection) {
    int begun = 0;
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
        CoupledState state;
        CoupledContacts system = corner(state, 0.02);
        system.gravity += 3 * random_vector();
        for (std::size_t c = 0; c < system.contact_count; ++c)
            system.contacts[c].mode = ContactMode::kIncipient;
        const CoupledForces f = coupled_forces(system, state);
        for (std::size_t c = 0; c < system.contact_count; ++c) {
            const CoupledContactForces& at = f.contacts[c];
            if (!(at.push > 0) || !(at.slip_rate.dot(at.direction) > 0)) continue;
            ++begun;
            const double size = at.slip_rate.norm();
            worst = std::max(worst, (at.slip_rate / size - at.direction).norm());
            EXPECT_NEAR(at.friction.norm(), 0.02 * at.push, 1e-10);
        }
    }
    std::printf("%d slips begin, directions off by %.2g\n", begun, worst);
    EXPECT_GT(begun, 100);
    EXPECT_LT(worst, 1e-9);
}

}  // namespace
}  // namespace carom::testing
