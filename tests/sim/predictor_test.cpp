// What comes next to a ball, in closed form; and that asking changes nothing.
#include "sim/exact/predictor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "exact_scenes.h"

namespace carom {
namespace {

using namespace testing;

/// A world in which all balls fly, and who looks ahead in it.
struct Ahead {
    explicit Ahead(const Scene& s)
        : world(s),
          links(s.balls.size()),
          rules(world, notes),
          log(world),
          forms(world, rules, log, kEnd),
          piles(world, links, log, forms),
          predictor(world, links, notes, rules, piles, kEnd) {
        for (int i = 0; i < static_cast<int>(s.balls.size()); ++i)
            forms.begin_flight(i, 0, {world.body(i).velocity, world.body(i).spin});
    }

    static constexpr double kEnd = 10;
    ExactWorld world;
    Links links;
    InstantNotes notes;
    ContactRules rules;
    RunLog log;
    ClosedForms forms;
    Piles piles;
    Predictor predictor;
};

TEST(Predictor, AFallEndsOnTheFloor) {
    Scene scene = exact_scene(0.5, 0, kGravity);
    add_plane(scene);
    add_ball(scene, {0, 0, 1.1});
    const Ahead ahead(scene);
    const Outlook out = ahead.predictor.look_ahead(0, 0);
    EXPECT_EQ(out.next.kind, PredictionKind::kImpact);
    EXPECT_EQ(out.next.partner, (Partner{true, 0}));
    EXPECT_NEAR(out.next.time, std::sqrt(2 / kGravity), 1e-15);
    EXPECT_FALSE(out.pressing.has_value());
}

TEST(Predictor, OfTwoPartnersTheFirstOneCounts) {
    Scene scene = exact_scene(1, 0, 0);
    add_plane(scene, {-1, 0, 0}, -5);
    add_ball(scene, {0, 0, 0}, {1, 0, 0});
    add_ball(scene, {2, 0, 0});
    const Ahead ahead(scene);
    const Outlook out = ahead.predictor.look_ahead(0, 0);
    EXPECT_EQ(out.next.partner, (Partner{false, 1}));
    EXPECT_NEAR(out.next.time, 1.8, 1e-15);
}

TEST(Predictor, AskingChangesNeitherTheWorldNorTheAnswer) {
    Scene scene = exact_scene(0.5, 0, kGravity);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1});  // lies there, but is looked at as if it flew: it presses
    add_ball(scene, {0.5, 0, 1.1});
    const Ahead ahead(scene);
    const std::uint64_t stamp = ahead.world.ball(0).stamp;
    const Outlook first = ahead.predictor.look_ahead(0, 0);
    ASSERT_EQ(first.next.kind, PredictionKind::kPresses);
    ASSERT_TRUE(first.pressing.has_value());
    EXPECT_EQ(first.next.time, 0);
    const Outlook second = ahead.predictor.look_ahead(0, 0);
    EXPECT_EQ(second.next.kind, PredictionKind::kPresses);
    EXPECT_EQ(second.pressing->event_due, first.pressing->event_due);
    EXPECT_EQ(ahead.world.ball(0).stamp, stamp);
    EXPECT_EQ(ahead.world.ball(0).phase(), Phase::kFlight);
    EXPECT_TRUE(ahead.links.of(0).empty());
    EXPECT_EQ(ahead.notes.landing_of(first.pressing->contact, 0), nullptr);
}

TEST(ExactWorld, ANewPhaseForgetsWhatBelongedToTheOneBefore) {
    Scene scene = exact_scene(0.5, 0, kGravity);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.1});
    ExactWorld world(scene);
    ExactBall& ball = world.ball(0);
    ball.surface = 0;
    ball.event_due = 3;
    ball.phase_end = 2;
    world.set_phase(0, Phase::kFlat);
    EXPECT_EQ(ball.surface, 0);
    world.set_phase(0, Phase::kFlight);
    EXPECT_EQ(ball.phase(), Phase::kFlight);
    EXPECT_EQ(ball.surface, -1);
    EXPECT_TRUE(std::isinf(ball.event_due));
    EXPECT_TRUE(std::isinf(ball.phase_end));
}

}  // namespace
}  // namespace carom
