// Ghost marks at the peaks.
#include "render/marks/peaks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

/// Five balls with the peaks of their closed form.
Sample five_with_peaks() {
    Sample sample = five_balls();
    for (std::size_t i = 0; i < sample.motion.balls.size(); ++i) {
        const auto& pieces = sample.motion.balls[i].pieces();
        for (std::size_t k = 1; k < pieces.size(); ++k) {
            const double speed = pieces[k].velocity.z();
            if (!(speed > 1e-3)) break;
            const double time = pieces[k].start + speed / 9.81;
            if (time < sample.motion.duration)
                sample.motion.peaks[i].push_back({time, speed * speed / (2 * 9.81)});
        }
    }
    sample.scene.overlay.peaks = PeakOptions{};
    return sample;
}

TEST(Peaks, MarksStandWhereTheBallsTurnAndSayHowHigh) {
    const Sample sample = five_with_peaks();
    const View view = view_of(sample, {1280, 720});
    const auto marks = lay_out_peaks(sample.scene, sample.motion, view, Font(13), {});
    ASSERT_GT(marks.size(), 10u);
    double worst = 0;
    int numbers = 0;
    for (const PeakMark& mark : marks) {
        const auto ball = static_cast<std::size_t>(mark.ball);
        const auto& peaks = sample.motion.peaks[ball];
        const auto peak = std::find_if(peaks.begin(), peaks.end(),
                                       [&](const Peak& p) { return p.time == mark.time; });
        ASSERT_NE(peak, peaks.end());
        const double radius = sample.scene.balls[ball].radius;
        const BallState state = sample.motion.balls[ball].at(mark.time);
        worst = std::max(worst, std::abs(state.position.z() - radius - peak->height));
        const auto foot = view.project(state.position - Vec3(0, 0, radius));
        EXPECT_NEAR(mark.foot.x(), foot.x_px, 1e-9);
        EXPECT_NEAR(mark.foot.y(), foot.y_px, 1e-9);
        EXPECT_NEAR(std::stod(mark.text), peak->height, 0.5001e-2);
        if (mark.place.empty()) continue;
        ++numbers;
        EXPECT_NEAR(mark.place.middle_y(), mark.foot.y(), 1.0);
    }
    fmt::print("{} marks, {} with numbers; gap at the mark within {:.1e} m (bound 1e-9)\n",
               marks.size(), numbers, worst);
    EXPECT_LT(worst, 1e-9);
    EXPECT_GE(numbers, 10);
}

TEST(Peaks, NumbersNeverOverlap) {
    for (const Size& size : kSizes) {
        const Sample sample = five_with_peaks();
        const View view = view_of(sample, size);
        const Font font(std::max(13.0 * size.height / 720, 9.5));
        const PixelRect taken = PixelRect::at(size.width / 4, 0, size.width / 4, size.height / 3);
        const auto marks = lay_out_peaks(sample.scene, sample.motion, view, font, {taken});
        int numbers = 0;
        for (std::size_t i = 0; i < marks.size(); ++i) {
            if (marks[i].place.empty()) continue;
            ++numbers;
            EXPECT_TRUE(inside(marks[i].place, size));
            EXPECT_FALSE(marks[i].place.overlaps(taken));
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_FALSE(marks[i].place.overlaps(marks[j].place)) << i << " and " << j;
        }
        fmt::print("{}x{}: {} numbers of {} marks\n", size.width, size.height, numbers,
                   marks.size());
        EXPECT_GE(numbers, 3);
    }
}

TEST(Peaks, ThePictureDependsOnTheInstantAlone) {
    const Sample sample = five_with_peaks();
    const View view = view_of(sample, {320, 180});
    PeaksElement forward(sample.scene, sample.motion, view, {}, {});
    EXPECT_TRUE(forward.update(0).empty());
    const Image nothing = forward.picture();
    for (double t = 0; t < 3; t += 0.1) forward.update(t);
    PeaksElement at_once(sample.scene, sample.motion, view, {}, {});
    EXPECT_FALSE(at_once.update(2.9).empty());
    forward.update(2.9);
    EXPECT_NE(forward.picture(), nothing);
    EXPECT_EQ(forward.picture(), at_once.picture());
    forward.update(5);
    forward.update(2.9);  // back
    EXPECT_EQ(forward.picture(), at_once.picture());
    forward.update(0);
    EXPECT_EQ(forward.picture(), nothing);
}

TEST(Peaks, WhatChangedLiesInTheRectangle) {
    const Sample sample = five_with_peaks();
    const View view = view_of(sample, {640, 360});
    PeaksElement peaks(sample.scene, sample.motion, view, {}, {});
    int changes = 0;
    for (double t = 0; t < 4; t += 1.0 / 60) {
        const Image before = peaks.picture();
        const PixelRect changed = peaks.update(t);
        for (int y = 0; y < before.height_px; ++y)
            for (int x = 0; x < before.width_px; ++x) {
                const bool same = std::equal(before.row(y) + 4 * x, before.row(y) + 4 * x + 4,
                                             peaks.picture().row(y) + 4 * x);
                if (same) continue;
                ++changes;
                ASSERT_TRUE(x >= changed.left && x < changed.right && y >= changed.top &&
                            y < changed.bottom)
                    << x << ", " << y << " at " << t;
            }
    }
    EXPECT_GT(changes, 1000);
}

TEST(Peaks, TrailsAndPeaksShareOnePicture) {
    Sample sample = five_with_peaks();
    const View view = view_of(sample, {640, 360});
    sample.scene.overlay.trail = TrailOptions{};
    OverlayPainter film(sample.scene, sample.motion, view);
    OverlayPainter once(sample.scene, sample.motion, view);
    ASSERT_TRUE(film.has_moving_layer());
    for (double t = 0; t < 2; t += 1.0 / 60) film.update_moving_layer(t);
    film.update_moving_layer(2);
    once.update_moving_layer(2);
    EXPECT_EQ(film.moving_layer(), once.moving_layer());

    // The picture is the peaks over the trails.
    PeaksElement peaks(sample.scene, sample.motion, view, {}, {});
    peaks.update(2);
    sample.scene.overlay.peaks.reset();
    OverlayPainter trails(sample.scene, sample.motion, view);
    trails.update_moving_layer(2);
    Image expected = trails.moving_layer();
    EXPECT_NE(expected, film.moving_layer());
    lay_over(peaks.picture(), 0, 0, expected);
    EXPECT_EQ(expected, film.moving_layer());
}

TEST(Peaks, OutlinesAreTheBallsSilhouettes) {
    Camera camera;
    camera.from = Vec3(0, -4, 1);
    camera.to = Vec3(0, 0, 1);
    camera.fov_deg = 60;
    const View view(camera, 1280, 720);
    const Vec3 center(1.2, 0.3, 1.5);
    const double radius = 0.3;
    const auto corners = silhouette(center, radius, view);
    ASSERT_GT(corners.size(), 50u);
    double worst = 0;
    for (const Vec2& corner : corners) {
        // The ray through the corner passes the centre at the distance of one radius.
        const double scale = view.tan_half_fov_y() / 360;
        const Vec3 ray = (view.forward() + (corner.x() - 640) * scale * view.right() -
                          (corner.y() - 360) * scale * view.up())
                             .normalized();
        const double distance = (center - view.eye()).cross(ray).norm();
        worst = std::max(worst, std::abs(distance - radius));
    }
    fmt::print("rays pass the centre within {:.1e} m of one radius (bound 1e-12)\n", worst);
    EXPECT_LT(worst, 1e-12);
    EXPECT_TRUE(silhouette(view.eye() + Vec3(0, 0.1, 0), radius, view).empty());
}

}  // namespace
}  // namespace carom
