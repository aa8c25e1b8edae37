// Trails: exact curves, and pictures that do not depend on what was drawn before.
#include "render/marks/trails.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

Sample crossing(double seconds) {
    Sample sample = empty_floor(3);
    add_bouncing(sample, "a", 0.12, Vec3(-1, 0, 1.5), Vec3(0.7, 0, 0), 0.8, {0.8, 0.3, 0.1});
    add_bouncing(sample, "b", 0.1, Vec3(1, 0.2, 1.2), Vec3(-0.7, 0, 0.5), 0.8, {0.1, 0.3, 0.8});
    add_bouncing(sample, "c", 0.05, Vec3(0, 0, 1), Vec3::Zero(), 0.9, {1, 1, 1});
    sample.scene.overlay.trail = TrailOptions{seconds, 2};
    return sample;
}

class TrailOf : public ::testing::TestWithParam<double> {};

TEST_P(TrailOf, IsTheSameWhateverWasDrawnBefore) {
    const Sample sample = crossing(GetParam());
    const View view = view_of(sample, {640, 360});
    TrailsElement film(sample.scene, sample.motion, view);
    for (int k = 0; k <= 179; ++k) film.update(k / 60.0);
    for (const double t : {179 / 60.0, 3.0, 1.237, 0.0, 2.5, 2.5000001, 2.1}) {
        film.update(t);
        TrailsElement alone(sample.scene, sample.motion, view);
        alone.update(t);
        const ImageDifference difference = compare_images(film.picture(), alone.picture());
        EXPECT_EQ(difference.differing, 0) << "t = " << t;
        EXPECT_TRUE(film.picture() == alone.picture());
    }
}

TEST_P(TrailOf, TellsWhatChanged) {
    const Sample sample = crossing(GetParam());
    const View view = view_of(sample, {320, 180});
    TrailsElement trails(sample.scene, sample.motion, view);
    Image before(320, 180);
    int frames_with_change = 0;
    for (const double t : {0.1, 0.11, 0.5, 1.5, 1.5, 0.7, 2.9}) {
        const PixelRect changed = trails.update(t);
        for (int y = 0; y < 180; ++y) {
            for (int x = 0; x < 320; ++x) {
                const bool in = x >= changed.left && x < changed.right && y >= changed.top &&
                                y < changed.bottom;
                if (in) continue;
                ASSERT_TRUE(std::equal(before.row(y) + 4 * x, before.row(y) + 4 * x + 4,
                                       trails.picture().row(y) + 4 * x))
                    << "t = " << t << " at " << x << ", " << y;
            }
        }
        if (!(before == trails.picture())) ++frames_with_change;
        before = trails.picture();
    }
    EXPECT_GE(frames_with_change, 6);
}

INSTANTIATE_TEST_SUITE_P(Seconds, TrailOf,
                         ::testing::Values(std::numeric_limits<double>::infinity(), 0.6));

TEST(Trail, PassesThroughTheCentresAndStaysThere) {
    const Sample sample = crossing(std::numeric_limits<double>::infinity());
    const View view = view_of(sample, {1280, 720});
    TrailsElement trails(sample.scene, sample.motion, view);
    trails.update(2);
    const Image& picture = trails.picture();
    Image near_path(1280, 720);  // alpha marks pixels within 3 px of a centre at any instant
    int least = 255;
    for (const Trajectory& ball : sample.motion.balls) {
        for (int k = 0; k <= 20000; ++k) {
            const auto p = view.project(ball.at(2 * k / 20000.0).position);
            const int x = static_cast<int>(p.x_px), y = static_cast<int>(p.y_px);
            least = std::min(least, alpha_at(picture, x, y));
            for (int dy = -2; dy <= 2; ++dy)
                for (int dx = -2; dx <= 2; ++dx) near_path.row(y + dy)[4 * (x + dx) + 3] = 1;
        }
    }
    int astray = 0;
    for (int y = 0; y < 720; ++y)
        for (int x = 0; x < 1280; ++x)
            if (alpha_at(picture, x, y) > 0 && alpha_at(near_path, x, y) == 0) ++astray;
    fmt::print("least opacity on the paths {} (at least 140), pixels astray {}\n", least, astray);
    EXPECT_GE(least, 140);
    EXPECT_EQ(astray, 0);
}

TEST(Trail, CornersFollowTheCurveAndKeepEveryImpact) {
    const Sample sample = crossing(std::numeric_limits<double>::infinity());
    for (const Size& size : kSizes) {
        const View view = view_of(sample, size);
        double worst = 0;
        int corners = 0, impacts = 0;
        for (const Trajectory& ball : sample.motion.balls) {
            TrailCurve curve(ball, view, sample.motion.duration);
            std::vector<TrailPoint> points;
            while (const auto point = curve.next(sample.motion.duration)) points.push_back(*point);
            corners += static_cast<int>(points.size());
            ASSERT_GT(points.size(), 10u);
            for (std::size_t k = 1; k < points.size(); ++k) {
                const Vec2 along = points[k].px - points[k - 1].px;
                for (int i = 1; i < 8; ++i) {
                    const double t =
                        points[k - 1].time + (points[k].time - points[k - 1].time) * i / 8;
                    const Vec2 off = curve.at(t).px - points[k - 1].px;
                    const double u = std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0);
                    worst = std::max(worst, (off - u * along).norm());
                }
            }
            for (const Piece& piece : ball.pieces()) {
                ++impacts;
                double nearest = 1e9;
                for (const TrailPoint& point : points)
                    nearest = std::min(nearest, (point.px - curve.at(piece.start).px).norm());
                EXPECT_LE(nearest, TrailCurve::kLeastStep);
            }
        }
        fmt::print(
            "{}x{}: {} corners, {} of them at impacts, off the curve by at most {:.3f} px "
            "(bound 0.25)\n",
            size.width, size.height, corners, impacts, worst);
        EXPECT_LT(worst, 0.25);
    }
}

// A million hops: as many corners as some thousands have, each on the path; near the end of a short
// trail none of them is left out.
TEST(Trail, HopsWithoutNumberAreShownInPart) {
    constexpr int kHops = 1'000'000;
    constexpr double kRadius = 0.1, kHop_s = 0.9, kGravity = 9.81;
    Sample sample = empty_floor(kHops * kHop_s);
    add_ball(sample, "a", kRadius, {straight(0, Vec3(0, 0, kRadius), Vec3::Zero())});
    Trajectory path;
    path.reserve(kHops);
    for (int i = 0; i < kHops; ++i) {
        Piece hop = straight(i * kHop_s, Vec3(0, 0, kRadius), Vec3(0, 0, 0.5 * kGravity * kHop_s));
        hop.acceleration = Vec3(0, 0, -kGravity);
        path.append(hop);
    }
    const View view(pinhole({0, -5, 0.5}, {0, 0, 0.5}, 30), 1280, 720);
    const double end = sample.motion.duration;
    const auto corners_of = [&](TrailCurve curve, double from, int& shown) {
        int corners = 0;
        curve.skip_to(from);
        while (const auto corner = curve.next(end)) {
            ++corners;
            shown += corner->visible ? 1 : 0;
            if (!corner->visible) continue;
            const View::Projected p = view.project(path.at(corner->time).position);
            EXPECT_NEAR(corner->px.y(), p.y_px, 1e-6);
        }
        return corners;
    };
    int shown = 0;
    const int all = corners_of(TrailCurve(path, view, end, 1e300), 0, shown);
    fmt::print("{} corners, {} of them visible, for {} hops\n", all, shown, kHops);
    EXPECT_GT(shown, static_cast<int>(10 * TrailCurve::kManyPieces));
    EXPECT_LT(all, static_cast<int>(200 * TrailCurve::kManyPieces));
    int last = 0;
    const int few = corners_of(TrailCurve(path, view, end, 10), end - 10, last);
    EXPECT_EQ(few, last);
    EXPECT_LT(few, 2000);
    EXPECT_GT(few, 100);
}

TEST(Trail, ManyPiecesAtOnePlaceMakeFewCorners) {
    // A ball at rest, stepped 40,000 times.
    Sample sample = empty_floor(10);
    std::vector<Piece> pieces;
    for (int k = 0; k < 40000; ++k)
        pieces.push_back(straight(k * 0.00025, Vec3(0, 0, 0.1 + 1e-7 * (k % 2)), Vec3::Zero()));
    add_ball(sample, "a", 0.1, pieces);
    const View view = view_of(sample, {640, 360});
    TrailCurve curve(sample.motion.balls[0], view, 10);
    int corners = 0;
    while (curve.next(10)) ++corners;
    EXPECT_EQ(corners, 1);
}

TEST(Trail, OrderOfDrawingDoesNotMatter) {
    std::vector<TrailRaster::Segment> segments;
    for (int k = 0; k < 60; ++k) {
        TrailRaster::Segment s;
        s.line = k % 5;
        s.from = Vec2(40 + 35 * std::sin(1.7 * k), 40 + 35 * std::cos(2.9 * k));
        s.to = Vec2(40 + 35 * std::sin(0.3 * k * k), 40 + 35 * std::cos(1.1 * k));
        s.opacity_from = 0.2 + 0.01 * k;
        s.opacity_to = 0.8;
        s.half_width = 1.5;
        segments.push_back(s);
    }
    const std::vector<Ink> inks = {
        {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0.5, 0.5, 0, 1}, {0, 0, 0, 1}};
    TrailRaster forwards(80, 80, inks), backwards(80, 80, inks), taken_back(80, 80, inks);
    for (const auto& s : segments) forwards.draw(s, true);
    std::reverse(segments.begin(), segments.end());
    for (const auto& s : segments) backwards.draw(s, true);
    for (const auto& s : segments) taken_back.draw(s, false);
    EXPECT_TRUE(forwards.picture() == backwards.picture());
    EXPECT_TRUE(forwards.picture() == taken_back.picture());
    EXPECT_GT(alpha_at(forwards.picture(), static_cast<int>(segments[0].from.x()),
                       static_cast<int>(segments[0].from.y())),
              60);
    taken_back.take_back();
    EXPECT_TRUE(taken_back.picture() == Image(80, 80));
}

TEST(Trail, FadesTowardsThePast) {
    Sample sample = empty_floor(2);
    add_ball(sample, "a", 0.1, {straight(0, Vec3(-1, 0, 0.5), Vec3(1, 0, 0))});
    sample.scene.overlay.trail = TrailOptions{1, 4};
    const View view = view_of(sample, {640, 360});
    TrailsElement trails(sample.scene, sample.motion, view);
    trails.update(1.5);
    int last = 256;
    for (const double age : {0.05, 0.25, 0.45, 0.65, 0.85, 1.05}) {
        const auto p = view.project(sample.motion.balls[0].at(1.5 - age).position);
        const int alpha =
            alpha_at(trails.picture(), static_cast<int>(p.x_px), static_cast<int>(p.y_px));
        // 80 % of 255 at the ball, in proportion to what is left of the second.
        EXPECT_NEAR(alpha, 0.8 * 255 * std::max(0.0, 1 - age), 4) << age;
        EXPECT_LT(alpha, last);
        last = alpha;
    }
    EXPECT_EQ(last, 0);
}

TEST(Trail, ColoursAreDarkEnoughForALightFloor) {
    for (const Color& color :
         {Color{1, 1, 1}, Color{0.9, 0.95, 0.2}, Color{0.85, 0.42, 0.1}, Color{0, 0, 0}}) {
        Look look;
        look.color = color;
        look.second_color = color;
        const Ink ink = trail_ink(look);
        EXPECT_LT(0.2126 * ink.r + 0.7152 * ink.g + 0.0722 * ink.b, 0.5);
    }
    Look volleyball;
    volleyball.color = {0.95, 0.95, 0.95};
    volleyball.second_color = {0.1, 0.2, 0.8};
    EXPECT_GT(trail_ink(volleyball).b, 2 * trail_ink(volleyball).r);
}

}  // namespace
}  // namespace carom
