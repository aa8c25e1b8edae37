// Events of the method exact allocate nothing once their vectors have grown. This program counts
// every operator new, and what ODE asks of its allocator.
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <random>

#include "../sim/exact_scenes.h"
#include "sim/exact/exact.h"

namespace {

std::size_t allocations = 0;

void* counted_alloc(std::size_t size) {
    ++allocations;
    return std::malloc(size);
}
void* counted_realloc(void* block, std::size_t, std::size_t size) {
    ++allocations;
    return std::realloc(block, size);
}
void counted_free(void* block, std::size_t) { std::free(block); }

}  // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* block = std::malloc(size > 0 ? size : 1)) return block;
    throw std::bad_alloc();
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace carom::testing {
namespace {

struct Counted {
    std::size_t allocations = 0;
    std::int64_t impacts = 0;
};

Counted count(Scene& scene, double seconds) {
    scene.simulation.duration = seconds;
    const std::size_t before = allocations;
    const SimulationResult result = simulate_exact(scene);
    return {allocations - before, result.report.impacts};
}

class Allocation : public ::testing::Test {
  protected:
    void SetUp() override {
        dSetAllocHandler(counted_alloc);
        dSetReallocHandler(counted_realloc);
        dSetFreeHandler(counted_free);
    }
    void TearDown() override {
        dSetAllocHandler(nullptr);
        dSetReallocHandler(nullptr);
        dSetFreeHandler(nullptr);
    }
};

/// Doubling the time doubles the vectors of the motion, each by one allocation, and of the rest the
/// queue's, at most: what an event allocated itself would be thousands.
void expect_nothing_per_event(Scene& scene, double seconds) {
    count(scene, 0.1 * seconds);  // what is made once for the process
    const Counted once = count(scene, seconds), twice = count(scene, 2 * seconds);
    const std::int64_t events = twice.impacts - once.impacts;
    const std::size_t more = twice.allocations - once.allocations;
    // Per ball its pieces and its peaks grow, and once for all the events and the queue.
    const std::size_t allowed = 4 * scene.balls.size() + 16;
    std::printf(
        "%zu balls: %zu allocations in %lld impacts, %zu more for %lld more (at most %zu)\n",
        scene.balls.size(), once.allocations, static_cast<long long>(once.impacts), more,
        static_cast<long long>(events), allowed);
    ASSERT_GT(once.allocations, 10u) << "nothing is counted";
    ASSERT_GT(events, 2000);
    EXPECT_LE(more, allowed);
}

TEST_F(Allocation, BouncingBall) {
    for (const double friction : {0.0, 0.4}) {
        Scene scene = exact_scene(1, friction, kGravity);
        add_plane(scene);
        add_ball(scene, Vec3(0, 0, 0.3), Vec3(1, 0, 0)).spin = Vec3(1, 2, 3);
        expect_nothing_per_event(scene, 3000 * 2 * std::sqrt(2 * 0.2 / kGravity));
    }
}

TEST_F(Allocation, Gas) {
    Scene scene = exact_scene(1, 0, 0);
    use_pair(scene, 1);
    for (int axis = 0; axis < 3; ++axis) {
        add_plane(scene, Vec3::Unit(axis), 0);
        add_plane(scene, -Vec3::Unit(axis), -2);
    }
    std::mt19937 random(4);
    std::uniform_real_distribution<double> speed(-1, 1);
    for (int i = 0; i < 60; ++i) {
        const Vec3 at(i % 4, i / 4 % 4, i / 16);
        const double x = speed(random), y = speed(random), z = speed(random);
        add_ball(scene, 0.5 * at + Vec3::Constant(0.2), Vec3(x, y, z));
    }
    expect_nothing_per_event(scene, 60);
}

}  // namespace
}  // namespace carom::testing
