// Events of whole scenes: their kinds, their order, when everything rests; and the peaks.
#include "sim/record/event_log.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace carom {
namespace {

using namespace testing;

std::string kinds(const Motion& motion) {
    std::string text;
    for (const Event& e : motion.events)
        text +=
            fmt::format("{}:{} ", motion.surface_names.at(static_cast<std::size_t>(e.other.index)),
                        event_kind_name(e.kind));
    return text;
}

TEST(Events, H2BouncesEndInRestAndSoDoesTheMotion) {
    for (double e : {0.5, 0.8, 0.9}) {
        const double step = 1.0 / 4000;
        Scene scene = scene_of(e, 0, kGravity, step);
        add_plane(scene);
        add_ball(scene, {0, 0, 2.1});
        scene.simulation.duration.reset();
        const auto result = simulate(scene);
        const double end = std::sqrt(2 * 2 / kGravity) * (1 + e) / (1 - e);
        const auto& events = result.motion.events;
        ASSERT_GT(events.size(), 5u);
        EXPECT_EQ(events.back().kind, EventKind::kRest);
        fmt::print("e = {}: rests at {:.5f} s, closed form {:.5f} s, after {} impacts\n", e,
                   events.back().time, end, result.report.impacts);
        // Hops slower than 2 g dt are not made: 2 (2 g dt) / g / (1 - e) is missing at most, and
        // each impact came up to a step late.
        EXPECT_NEAR(events.back().time, end, 6 * step / (1 - e));
        EXPECT_EQ(result.report.impacts, std::int64_t(events.size()) - 1);
        // The motion ends as soon as the rest is sure: after the last lift out of the floor.
        EXPECT_GT(result.motion.duration, events.back().time);
        EXPECT_LT(result.motion.duration, events.back().time + 40 * step);
        for (std::size_t i = 0; i + 1 < events.size(); ++i) {
            EXPECT_EQ(events[i].kind, EventKind::kImpact);
            EXPECT_GT(events[i].approach_speed, 2 * kGravity * step);  // what makes an impact
            EXPECT_LT(events[i].time, events[i + 1].time);
        }
    }
}

TEST(Events, RestIsAwaitedNoLongerThanMaxDuration) {
    Scene scene = scene_of(1, 0, kGravity, 1e-3);
    scene.simulation.duration.reset();
    scene.simulation.max_duration = 3;
    add_plane(scene);
    add_ball(scene, {0, 0, 1});
    EXPECT_EQ(simulate(scene).motion.duration, 3);  // it bounces for ever
    // Without gravity nothing comes to rest.
    scene.simulation.gravity = Vec3::Zero();
    scene.simulation.max_duration = 0.5;
    EXPECT_EQ(simulate(scene).motion.duration, 0.5);
}

TEST(Events, WhatRestsFromTheStartEndsAtOnce) {
    Scene scene = scene_of(0.5, 0.3, kGravity, 1e-3);
    scene.simulation.duration.reset();
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1});
    const auto result = simulate(scene);
    EXPECT_NEAR(result.motion.duration, EventLog::kRestSteps * 1e-3, 1e-12);
    EXPECT_TRUE(result.motion.events.empty());  // no row for contacts that exist at time 0
}

// Ball 1 lands on ball 0, which lies on the floor: all rest only when both do.
TEST(Events, AllMustRest) {
    Scene scene = scene_of(0.5, 0, kGravity, 1e-3);
    use_pair(scene, 0);
    scene.simulation.duration.reset();
    scene.simulation.max_duration = 20;
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1});
    add_ball(scene, {2, 0, 1.1});
    const auto result = simulate(scene);
    const auto rests = events_of(result.motion, EventKind::kRest);
    ASSERT_EQ(rests.size(), 1u);
    EXPECT_EQ(rests[0].ball, 1);
    EXPECT_GT(result.motion.duration, rests[0].time);
    EXPECT_LT(result.motion.duration, 5);
}

// Off a table with friction: rolls from some time on, leaves over the edge, bounces, rolls.
TEST(Events, SlideRollLeaveImpact) {
    Scene scene = scene_of(0.5, 0.5, kGravity, 1.0 / 4000);
    add_plane(scene);
    Surface table;
    table.name = "table";
    table.shape = BoxShape{{0, 0, 0.5}, {1, 1, 1}, Quat::Identity()};
    table.material = 2;
    scene.surfaces.push_back(table);
    add_ball(scene, {0, 0, 1.1}, {1, 0, 0});
    const auto result = run(scene, 4);
    const std::string all = kinds(result.motion);
    fmt::print("{}\n", all);
    EXPECT_EQ(all.find("table:roll table:leave plane0:impact "), 0u);
    EXPECT_EQ(all.substr(all.rfind("plane0:")), "plane0:roll ");
    // 5/7 v at v0 / (mu g (1 + 1/k)); no row for the slide, which began at time 0
    EXPECT_NEAR(result.motion.events[0].time, 1 / (0.5 * kGravity * 3.5), 1e-3);
    for (std::size_t i = 1; i < result.motion.events.size(); ++i)
        EXPECT_LE(result.motion.events[i - 1].time, result.motion.events[i].time);
}

TEST(Events, ALandingBallSlidesThenRolls) {
    Scene scene = scene_of(0, 0.1, kGravity, 1.0 / 4000);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.3}, {4, 0, 0});
    const auto result = run(scene, 2);
    EXPECT_EQ(kinds(result.motion), "plane0:impact plane0:slide plane0:roll ");
}

TEST(Events, FrictionlessBallsSlideAndNeverRoll) {
    Scene scene = scene_of(0.3, 0, kGravity, 1.0 / 4000);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.2}, {1, 0, 0});
    const auto result = run(scene, 3);
    EXPECT_FALSE(events_of(result.motion, EventKind::kImpact).empty());
    EXPECT_EQ(events_of(result.motion, EventKind::kSlide).size(), 1u);
    EXPECT_TRUE(events_of(result.motion, EventKind::kRoll).empty());
    EXPECT_EQ(result.motion.events.back().kind, EventKind::kSlide);
}

TEST(Events, NoneLiesBehindTheDuration) {
    Scene scene = scene_of(0.8, 0, kGravity, 0.01);
    add_plane(scene);
    add_ball(scene, {0, 0, 1.1});
    for (double duration : {0.0, 0.004, 0.451, 0.4513, 0.46, 1.0}) {
        const auto result = run(scene, duration);
        EXPECT_EQ(result.motion.duration, duration);
        EXPECT_EQ(result.report.steps, std::max(1.0, std::ceil(duration / 0.01 - 1e-9)));
        for (const Event& e : result.motion.events) EXPECT_LE(e.time, duration);
        for (const Peak& p : result.motion.peaks[0]) EXPECT_LE(p.time, duration);
    }
}

TEST(Peaks, AreGapsAboveWhatWasHit) {
    // A ball on a raised, tilted plane: the gap is along the normal, v^2 / (2 g_n).
    Scene scene = scene_of(0.8, 0, kGravity, 1e-4);
    const Vec3 normal = incline(30);
    add_plane(scene, normal, 5);
    add_ball(scene, 5.1 * normal + Vec3(0, 0, 1));
    const auto result = run(scene, 2.5);
    const auto impacts = events_of(result.motion, EventKind::kImpact);
    const auto& peaks = result.motion.peaks[0];
    ASSERT_GE(peaks.size(), 3u);
    for (std::size_t n = 0; n < 3; ++n) {
        const double g_n = kGravity * normal.z();
        const double v = impacts[n].separation_speed;
        fmt::print("gap {:.6f} m, v^2/(2 g_n) {:.6f} m\n", peaks[n].height, v * v / (2 * g_n));
        EXPECT_NEAR(peaks[n].height, v * v / (2 * g_n), 1.5e-3);
        EXPECT_NEAR(peaks[n].time, impacts[n].time + v / g_n, 2e-4);
    }
}

TEST(Peaks, NeedATrueTop) {
    Scene scene = scene_of(0.9, 0, kGravity, 1e-3);
    add_plane(scene);
    add_ball(scene, {0, 0, 1.1});
    const double fall = std::sqrt(2 / kGravity);
    EXPECT_EQ(run(scene, fall * 0.9).motion.peaks[0].size(), 0u);  // has not bounced
    EXPECT_EQ(run(scene, fall * 1.8).motion.peaks[0].size(), 0u);  // is still rising
    EXPECT_EQ(run(scene, fall * 2.0).motion.peaks[0].size(), 1u);
    // Walls and ceilings give none.
    Scene walls = scene_of(1, 0, 0, 1e-3);
    add_plane(walls, {1, 0, 0}, -1);
    add_plane(walls, {-1, 0, 0}, -1);
    add_ball(walls, {0, 0, 0}, {3, 0, 0});
    const auto result = run(walls, 5);
    EXPECT_GT(result.report.impacts, 3);
    EXPECT_TRUE(result.motion.peaks[0].empty());
}

}  // namespace
}  // namespace carom
