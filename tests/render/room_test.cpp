// Pictures with no room for what is asked for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "render/runs/second_run.h"
#include "sample_views.h"

namespace carom {
namespace {

using namespace samples;

/// With everything that can be written over a picture.
Sample full_sample() {
    Sample sample = five_balls();
    sample.scene.title = "Five balls that fall and rebound";
    Overlay& overlay = sample.scene.overlay;
    overlay.ruler = RulerOptions{};
    overlay.clock = ClockOptions{};
    overlay.labels = LabelOptions{};
    overlay.trail = TrailOptions{};
    overlay.title = TitleOptions{};
    overlay.caption = "each from a height of 1.8 m";
    overlay.peaks = PeakOptions{};
    overlay.velocity = VelocityOptions{};
    overlay.plot = PlotOptions{};
    for (int i = 0; i < 5; ++i) overlay.plot->balls.push_back(i);
    return sample;
}

TEST(OverlayRoom, WhatHasNoRoomIsLeftOutInEverySize) {
    const Sample sample = full_sample();
    SecondRun second;
    second.scene = sample.scene;
    second.motion = sample.motion;
    second.ended_s = sample.motion.duration;
    second.differences = {{"materials.rubber.restitution", "0.8", "0.7"}};
    second.first_name = "one";
    second.second_name = "other";
    int pictures = 0, left_out = 0, whole = 0;
    // Halves of pictures may be as narrow as 7 pixels.
    for (const int width : {7, 16, 18, 24, 33, 48, 64, 100, 160, 320, 640}) {
        for (const int height : {7, 16, 18, 24, 33, 48, 64, 100, 180, 360}) {
            for (const PicturePart part :
                 {PicturePart::kWhole, PicturePart::kOverHalves, PicturePart::kFirstHalf}) {
                const bool ghosts = part == PicturePart::kWhole;
                second.view = ghosts ? AgainstView::kGhost : AgainstView::kSide;
                const BothRuns both = both_runs(sample.scene, sample.motion, second);
                OverlayPainter overlay(
                    sample.scene, sample.motion, view_of(sample, {width, height}),
                    {part, &second, part == PicturePart::kOverHalves ? nullptr : &both, {}});
                for (const PixelRect& rect : overlay.obstacles()) {
                    EXPECT_FALSE(rect.empty());
                    EXPECT_TRUE(inside(rect, {width, height})) << width << " x " << height;
                }
                Image picture(width, height);
                overlay.background_layer();
                overlay.update_moving_layer(3);
                overlay.draw_over(3, picture);
                left_out += static_cast<int>(overlay.left_out().size());
                whole += overlay.left_out().empty() ? 1 : 0;
                if (width == 7) {
                    // Ruler and plot, in each half; clock, title, caption and difference once.
                    EXPECT_EQ(overlay.left_out().size(), ghosts                             ? 6U
                                                         : part == PicturePart::kOverHalves ? 4U
                                                                                            : 2U);
                }
                ++pictures;
            }
        }
    }
    fmt::print("{} pictures, {} with everything, {} elements left out\n", pictures, whole,
               left_out);
    EXPECT_GT(whole, 0);
}

}  // namespace
}  // namespace carom
