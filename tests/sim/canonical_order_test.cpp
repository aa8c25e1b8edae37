// Solvers do not see in which order balls and contacts are listed.
#include "sim/solve/canonical_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "sim/solve/impact_solver.h"
#include "sim/solve/island_solver.h"

namespace carom::testing {
namespace {

struct Heap {
    std::vector<ImpactBody> bodies;
    std::vector<SolverContact> contacts;
    std::vector<Vec3> pushes;
};

constexpr double kRadius = 0.1;

/// A layer of four balls on the floor and one on top, all touching, with random velocities.
Heap pyramid(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&] {
        const double x = unit(random), y = unit(random);
        return Vec3(x, y, unit(random));
    };
    Heap heap;
    for (int i = 0; i < 5; ++i) {
        ImpactBody& b = heap.bodies.emplace_back();
        b.position = i < 4 ? kRadius * Vec3(i % 2 == 0 ? 1 : -1, i < 2 ? 1 : -1, 1)
                           : kRadius * Vec3(0, 0, 1 + std::sqrt(2.0));
        b.mass = 1 + 0.1 * i;
        b.inertia = 0.4 * b.mass * kRadius * kRadius;
        b.velocities = {vector() - Vec3::UnitZ(), vector()};
    }
    const auto touch = [&](int a, int b, const Vec3& normal) {
        SolverContact& c = heap.contacts.emplace_back();
        c.body = a;
        c.other_body = b;
        c.normal = normal;
        c.arm = -kRadius * normal;
        if (b >= 0) c.arm_other = kRadius * normal;
        c.restitution = 0.5;
        c.friction = 0.3;
    };
    for (int a = 0; a < 5; ++a) {
        if (a < 4) touch(a, -1, Vec3::UnitZ());
        for (int b = a + 1; b < 5; ++b) {
            const Vec3 apart = heap.bodies[static_cast<std::size_t>(a)].position -
                               heap.bodies[static_cast<std::size_t>(b)].position;
            if (apart.norm() < 2.0001 * kRadius) touch(a, b, apart.normalized());
        }
    }
    heap.pushes.assign(heap.contacts.size(), Vec3::Zero());
    return heap;
}

/// The same heap with its balls under other numbers, its contacts in another order, and some of
/// them seen from the other ball. `numbers`: the new one of each ball.
Heap renumbered(const Heap& heap, const std::vector<std::size_t>& numbers, std::mt19937& random) {
    Heap other = heap;
    for (std::size_t i = 0; i < numbers.size(); ++i) other.bodies[numbers[i]] = heap.bodies[i];
    const auto number = [&](int i) {
        return static_cast<int>(numbers[static_cast<std::size_t>(i)]);
    };
    for (SolverContact& c : other.contacts) {
        c.body = number(c.body);
        if (c.on_surface()) continue;
        c.other_body = number(c.other_body);
        if (random() % 2 == 0) continue;
        std::swap(c.body, c.other_body);
        std::swap(c.arm, c.arm_other);
        c.normal = -c.normal;
    }
    std::shuffle(other.contacts.begin(), other.contacts.end(), random);
    return other;
}

template <class Solve>
void expect_same_in_any_order(const Solve& solve) {
    std::mt19937 random(5);
    for (unsigned seed = 0; seed < 20; ++seed) {
        Heap heap = pyramid(seed);
        std::vector<std::size_t> numbers(heap.bodies.size());
        std::iota(numbers.begin(), numbers.end(), 0);
        std::shuffle(numbers.begin(), numbers.end(), random);
        Heap other = renumbered(heap, numbers, random);
        solve(heap);
        solve(other);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const Velocities &a = heap.bodies[i].velocities,
                             &b = other.bodies[numbers[i]].velocities;
            EXPECT_EQ(a.linear, b.linear) << "seed " << seed;
            EXPECT_EQ(a.spin, b.spin) << "seed " << seed;
        }
    }
}

TEST(CanonicalOrder, ImpactsAreTheSameBitForBit) {
    ImpactSolver solver;
    expect_same_in_any_order([&](Heap& heap) { solver.solve(heap.bodies, heap.contacts, 0); });
}

TEST(CanonicalOrder, StepsAreTheSameBitForBit) {
    IslandSolver solver;
    expect_same_in_any_order([&](Heap& heap) {
        for (int i = 0; i < 3; ++i)
            solver.step(heap.bodies, heap.contacts, heap.pushes, Vec3(0, 0, -9.81), 1.0 / 4000);
    });
}

/// What a solver writes into the sorted ones arrives where it belongs.
TEST(CanonicalOrder, PutsBackWhatItTook) {
    Heap heap = pyramid(1);
    std::mt19937 random(2);
    const Heap other = renumbered(heap, {3, 0, 4, 1, 2}, random);
    const CanonicalOrder order(other.bodies, other.contacts);
    EXPECT_FALSE(order.is_given());
    std::vector<ImpactBody> bodies = other.bodies;
    std::vector<SolverContact> contacts = other.contacts;
    order.put_back(order.sorted(other.bodies), bodies);
    order.put_back(order.sorted(other.contacts), contacts);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        EXPECT_EQ(bodies[i].position, other.bodies[i].position);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        EXPECT_EQ(contacts[i].body, other.contacts[i].body);
        EXPECT_EQ(contacts[i].other_body, other.contacts[i].other_body);
        EXPECT_EQ(contacts[i].normal, other.contacts[i].normal);
        EXPECT_EQ(contacts[i].arm, other.contacts[i].arm);
    }
    const CanonicalOrder again(order.sorted(other.bodies), order.sorted(other.contacts));
    EXPECT_TRUE(again.is_given());
}

}  // namespace
}  // namespace carom::testing
