#include "report/growing_motion.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/failure.h"
#include "core/image.h"
#include "render/painter.h"
#include "scene/film_clock.h"
#include "scene/reader.h"

namespace carom {
namespace {

/// 27 balls that never rest between walls; `more` are further keys.
Scene gas(double duration, const std::string& more = "camera: {from: [0, -6, 1], to: [0, 0, 1]}") {
    const std::string text = fmt::format(R"(
carom: 1
simulation: {{duration: {}}}
surfaces:
  - {{name: floor, plane: {{normal: [0, 0, 1], offset: 0}}}}
  - {{name: left, plane: {{normal: [1, 0, 0], offset: -1}}}}
  - {{name: right, plane: {{normal: [-1, 0, 0], offset: -1}}}}
  - {{name: front, plane: {{normal: [0, 1, 0], offset: -1}}}}
  - {{name: back, plane: {{normal: [0, -1, 0], offset: -1}}}}
balls:
  - {{name: a, radius: 0.1, position: [-0.6, -0.6, 0.3], velocity: [1, 2, 0],
     repeat: {{count: [3, 3, 3], spacing: 0.4, jitter: 0.01, seed: 1}}}}
film: {{fps: 20}}
{}
)",
                                         duration, more);
    SceneResult result = read_scene(text, "gas.yaml", {});
    for (const Diagnostic& d : result.diagnostics.items()) ADD_FAILURE() << d.text();
    return *result.scene;
}

bool are_equal(const BallState& a, const BallState& b) {
    return a.position == b.position && a.velocity == b.velocity &&
           a.orientation.coeffs() == b.orientation.coeffs() && a.spin == b.spin;
}

TEST(GrowingMotion, IsTheMotionAsFarAsItIsKnown) {
    const Scene scene = gas(60);
    const SimulationResult whole = simulate(scene);
    ASSERT_GT(whole.report.impacts, 1000);
    GrowingMotion growing(scene, GrowingMotion::Keep::kAll, {});
    EXPECT_EQ(growing.motion().duration, 60);
    EXPECT_EQ(growing.motion().ball_names, whole.motion.ball_names);
    for (int k = 0; k < 1200; ++k) {
        const double t = 0.05 * k;
        growing.wait_for({0, t});
        for (std::size_t b = 0; b < scene.balls.size(); ++b)
            ASSERT_TRUE(are_equal(growing.motion().balls[b].at(t), whole.motion.balls[b].at(t)))
                << t;
    }
    growing.wait_for({0, 60});
    const SimulationResult result = growing.finish();
    EXPECT_EQ(result.motion.hash(), whole.motion.hash());
    EXPECT_EQ(result.report.impacts, whole.report.impacts);
    EXPECT_EQ(result.report.effects.size(), whole.report.effects.size());
    ASSERT_EQ(result.motion.peaks.size(), whole.motion.peaks.size());
    for (std::size_t b = 0; b < scene.balls.size(); ++b)
        EXPECT_EQ(result.motion.peaks[b].size(), whole.motion.peaks[b].size());
    EXPECT_GT(growing.cpu_s(), 0);
}

TEST(GrowingMotion, ItsBeginningIsThereLongBeforeItsEnd) {
    const Scene scene = gas(1e6);  // an hour of work
    GrowingMotion growing(scene, GrowingMotion::Keep::kAll, {});
    growing.wait_for({0, 1});
    EXPECT_GE(growing.motion().balls.front().pieces().size(), 2U);
    // The destructor stops it.
}

TEST(GrowingMotion, WhatStopsTheSimulationIsThrownWhereItIsWaitedFor) {
    const Scene scene = gas(1e6);
    std::stop_source stop;
    GrowingMotion growing(scene, GrowingMotion::Keep::kNeeded, stop.get_token());
    growing.wait_for({0.5, 0.5});
    int signs = 0;
    EXPECT_THROW(growing.wait_for({1e6, 1e6},
                                  [&] {
                                      if (++signs == 3) stop.request_stop();
                                  }),
                 Failure);
    EXPECT_GE(signs, 3);
    growing.wait_for({0.5, 0.5});  // what is known stays known
    EXPECT_THROW(growing.finish(), Failure);
}

TEST(WhyWholeMotion, NamesWhatNeedsTheEnd) {
    const std::string camera = "camera: {from: [0, -6, 1], to: [0, 0, 1]}\n";
    EXPECT_EQ(why_whole_motion(gas(1), false), "");
    EXPECT_NE(why_whole_motion(gas(1), true), "");
    const auto why = [&](const std::string& more) { return why_whole_motion(gas(1, more), false); };
    EXPECT_NE(why("").find("camera"), std::string::npos);
    EXPECT_EQ(why(camera + "overlay: {clock: true, labels: true, caption: x}"), "");
    EXPECT_EQ(why(camera + "overlay: {velocity: {scale: 0.1}}"), "");
    for (const char* element :
         {"ruler: true", "trail: true", "peaks: true", "velocity: true", "plot: {ball: a_0_0_0}"})
        EXPECT_NE(why(camera + fmt::format("overlay: {{{}}}", element)), "") << element;
    Scene until_rest = gas(1), fixed = gas(1), far = gas(1);
    until_rest.simulation.duration.reset();
    EXPECT_NE(why_whole_motion(until_rest, false).find("rest"), std::string::npos);
    fixed.simulation.method = Method::kFixed;
    EXPECT_NE(why_whole_motion(fixed, false).find("fixed"), std::string::npos);
}

TEST(NeededForPicture, LooksAsFarAsFramesLabelsAndCameraDo) {
    Scene scene = gas(10);
    const auto expect = [&](double t, double from, double to) {
        const MotionSpan span = needed_for_picture(scene, t);
        EXPECT_NEAR(span.from, from, 1e-12);
        EXPECT_NEAR(span.to, to, 1e-12);
    };
    expect(2, 2 - 0.05, 2 + 0.05);
    scene.overlay.labels = LabelOptions{};
    expect(3, 3 - 2.05, 3 + 2.05);
    expect(0.3, 0, 0.3 + 2.05);
    scene.film.speed = 0.1;
    expect(2, 2 - 0.205, 2 + 0.205);
    scene.camera->smooth_s = 0.4;
    expect(2, 2 - 0.605, 2 + 0.605);
}

/// What comes after it does not show: not in where labels stand either, which once were drawn from
/// a motion that was not known so far yet.
TEST(NeededForPicture, IsAllThatAPictureDependsOn) {
    const Scene scene = gas(8,
                            "camera: {from: [0, -5, 2], to: [0, 0, 1]}\n"
                            "overlay: {clock: true, labels: true}\n");
    const Motion whole = simulate(scene).motion;
    Painter all(scene, whole, {.width_px = 160, .height_px = 90});
    for (const double t : {1.0, 3.5, 4.5, 5.0}) {
        Motion known = whole;
        const double end = needed_for_picture(scene, t).to;
        for (Trajectory& ball : known.balls) {
            std::vector<Piece> pieces = ball.pieces();
            std::erase_if(pieces, [&](const Piece& piece) { return piece.start > end; });
            ball = Trajectory();
            for (const Piece& piece : pieces) ball.append(piece);
        }
        Painter some(scene, known, {.width_px = 160, .height_px = 90});
        Image a, b;
        all.paint(t, a);
        some.paint(t, b);
        EXPECT_EQ(a, b) << t;
    }
}

TEST(GrowingMotion, WhatIsNotNeededIsLetGo) {
    const Scene scene = gas(400);
    const SimulationResult whole = simulate(scene);
    GrowingMotion growing(scene, GrowingMotion::Keep::kNeeded, {});
    std::size_t most = 0;
    for (double t = 0; t < 400; t += 0.25) {
        growing.wait_for({t, t});
        std::size_t pieces = 0;
        for (std::size_t b = 0; b < scene.balls.size(); ++b) {
            pieces += growing.motion().balls[b].pieces().size();
            ASSERT_TRUE(are_equal(growing.motion().balls[b].at(t), whole.motion.balls[b].at(t)))
                << t;
        }
        most = std::max(most, pieces);
    }
    std::size_t all = 0;
    for (const Trajectory& ball : whole.motion.balls) all += ball.pieces().size();
    RecordProperty("most_pieces", static_cast<int>(most));
    fmt::print("{} pieces at most, of {}\n", most, all);
    ASSERT_GT(all, 20'000U);
    EXPECT_GT(most, scene.balls.size());
    const SimulationResult result = growing.finish();
    EXPECT_EQ(result.report.impacts, whole.report.impacts);
    EXPECT_TRUE(result.motion.balls.empty() || result.motion.balls.front().pieces().empty());
}

}  // namespace
}  // namespace carom
