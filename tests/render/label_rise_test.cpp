// How labels rise over other balls.
#include "render/marks/label_rise.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/marks/labels.h"

namespace carom {
namespace {

TEST(LabelRise, IsTheLeastWayOverBalls) {
    const LabelBox label{100, 180, 300, 20};  // over ball 0
    std::vector<BallDisc> discs = {{Vec2(140, 330), 30, true}, {Vec2(170, 290), 40, true}};
    // 0.85 of the radius counts, and the disc's middle lies in the label's columns.
    EXPECT_NEAR(300 - (290 - 0.85 * 40), rise_over_balls(label, 0, discs), 1e-12);
    discs[1].center.x() = 180 + 20;  // beside it: half a chord
    EXPECT_NEAR(300 - (290 - std::sqrt(34.0 * 34 - 20 * 20)), rise_over_balls(label, 0, discs),
                1e-12);
    discs[1].center.x() = 180 + 35;  // it only touches
    EXPECT_EQ(0, rise_over_balls(label, 0, discs));
    discs[1] = {Vec2(140, 290), 10, false};
    EXPECT_EQ(0, rise_over_balls(label, 0, discs));
    EXPECT_EQ(0, rise_over_balls(label, 0, {discs[0]}));
}

TEST(LabelRise, GoesOverSeveralThatLieAboveOneAnother) {
    const std::vector<BallDisc> discs = {{Vec2(0, 130), 20, true},
                                         {Vec2(0, 90), 20, true},
                                         {Vec2(5, 60), 20, true},
                                         {Vec2(0, -200), 20, true}};
    EXPECT_NEAR(100 - (60 - 17), rise_over_balls({-20, 20, 100, 15}, 0, discs), 1e-12);
}

/// Something 40 px high lies in the way from 2 s on, for so long.
LabelRises rises_for(double seconds) {
    return LabelRises([seconds](double s) {
        return std::vector<double>{s >= 2 && s <= 2 + seconds ? 40.0 : 0.0};
    });
}

TEST(LabelRise, LetsPassWhatIsBrief) {
    LabelRises brief = rises_for(0.9), lasting = rises_for(1.2);
    for (double s = 0; s < 5; s += 0.05) EXPECT_EQ(0, brief.at(s)[0]) << s;
    EXPECT_EQ(40, lasting.at(2.5)[0]);
}

TEST(LabelRise, BeginsBeforeAndChangesSmoothly) {
    LabelRises rises = rises_for(3);
    EXPECT_EQ(0, rises.at(1.5)[0]);
    EXPECT_GT(rises.at(1.8)[0], 5);
    double before = 0, worst = 0;
    for (double s = 1; s < 6.5; s += 1.0 / 60) {
        const double now = rises.at(s)[0];
        worst = std::max(worst, std::abs(now - before));
        before = now;
    }
    EXPECT_LT(worst, 40 * 1.5 / (0.5 * 60) + 1e-9);  // the steepest place of 3 x^2 - 2 x^3
    EXPECT_EQ(0, before);
    // Whatever was asked before.
    LabelRises fresh = rises_for(3);
    for (const double s : {4.9, 1.7, 2.2, 1.9}) EXPECT_EQ(fresh.at(s), rises.at(s)) << s;
}

TEST(LabelRise, FadesWhereItIsFar) {
    EXPECT_EQ(1, opacity_of_risen(40, 20));
    EXPECT_DOUBLE_EQ(0.5, opacity_of_risen(50, 20));
    EXPECT_EQ(0, opacity_of_risen(60, 20));
}

/// Five rows of eight balls that rest, seen from the front and above.
struct Crowd {
    Scene scene;
    Motion motion;
    Crowd() {
        scene.overlay.labels.emplace();
        motion.duration = 4;
        for (int row = 0; row < 5; ++row)
            for (int column = 0; column < 8; ++column) {
                Ball ball;
                ball.name = "c_" + std::to_string(column) + "_" + std::to_string(row);
                ball.radius = 0.06;
                scene.balls.push_back(ball);
                Piece piece;
                piece.position = Vec3(-0.9 + 0.25 * column, 0.25 * row, 0.06);
                motion.balls.emplace_back().append(piece);
            }
        camera.from = Vec3(0, -2.5, 0.8);
        camera.to = Vec3(0, 0.5, 0.1);
    }
    Camera camera;
};

/// Those places that lie on a ball of another name.
int lying_on_balls(const Crowd& crowd, const View& view,
                   const std::vector<std::optional<LabelPlace>>& places) {
    int found = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        bool lies = false;
        for (std::size_t j = 0; j < crowd.scene.balls.size() && places[i]; ++j) {
            const auto ball = view.project(crowd.motion.balls[j].at(2).position);
            const double radius = 0.06 * view.pixels_per_metre(ball.depth_m);
            const PixelRect& rect = places[i]->rect;
            const Vec2 center(ball.x_px, ball.y_px);
            const Vec2 nearest(std::clamp(center.x(), double(rect.left), double(rect.right)),
                               std::clamp(center.y(), double(rect.top), double(rect.bottom)));
            lies |= i != j && (nearest - center).norm() < 0.8 * radius;
        }
        found += lies;
    }
    return found;
}

TEST(LabelRise, InACrowdFewNamesLieOnBalls) {
    Crowd crowd;
    const View view(crowd.camera, 1280, 720);
    const LabelsElement labels(crowd.scene, crowd.motion, view);
    const auto places = labels.place(2, {});
    const auto shown =
        std::count_if(places.begin(), places.end(), [](auto& p) { return p.has_value(); });
    const int lying = lying_on_balls(crowd, view, places);
    // What they would do without rising: within a second nothing lasts.
    crowd.motion.duration = 0.9;
    const LabelsElement flat(crowd.scene, crowd.motion, view);
    const int lying_flat = lying_on_balls(crowd, view, flat.place(0.5, {}));
    fmt::print("{} of 40 names shown, {} lie on balls; without rising {}\n", shown, lying,
               lying_flat);
    EXPECT_GE(shown, 8);   // the last row at least
    EXPECT_LT(shown, 40);  // and not those that have no room
    // Some are pushed by others' names.
    EXPECT_LE(lying, lying_flat / 4);
}

}  // namespace
}  // namespace carom
