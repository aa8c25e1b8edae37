// The list of all elements: what is made of it for one picture and for two halves.
#include "render/overlay/elements.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "render/overlay/overlay.h"
#include "sample_views.h"

namespace carom {
namespace {

using samples::five_balls;
using samples::Sample;
using samples::Size;
using samples::view_of;

constexpr Size kSize{320, 180};

/// With everything that a scene may ask for.
Sample decorated() {
    Sample sample = five_balls();
    Overlay& overlay = sample.scene.overlay;
    overlay.ruler = RulerOptions{};
    overlay.clock = ClockOptions{};
    overlay.trail = TrailOptions{};
    overlay.labels = LabelOptions{};
    overlay.title = TitleOptions{};
    overlay.caption = "A caption";
    overlay.peaks = PeakOptions{};
    overlay.velocity = VelocityOptions{};
    overlay.plot = PlotOptions{};
    overlay.plot->balls = {0};
    sample.scene.title = "A title";
    return sample;
}

SecondRun second_of(const Sample& sample) {
    SecondRun second;
    second.scene = sample.scene;
    second.motion = sample.motion;
    second.ended_s = sample.motion.duration;
    second.differences = {{"simulation.method", "exact", "fixed"}};
    return second;
}

/// Names of the kinds of which an element is made for this part of a picture.
std::set<std::string> made(const Sample& sample, PicturePart part, const SecondRun* second,
                           const BothRuns* both) {
    std::set<std::string> names;
    const View view = view_of(sample, kSize);
    for (const ElementKind& kind : element_kinds()) {
        const bool here = part == PicturePart::kWhole || (part == PicturePart::kOverHalves) ==
                                                             (kind.repeat == Repeat::kOncePerFilm);
        if (!here || !kind.wanted(sample.scene)) continue;
        if (kind.make({sample.scene, sample.motion, view, part, second, both}))
            names.insert(kind.name != nullptr ? kind.name : "run name");
    }
    return names;
}

TEST(Elements, EachHasItsOwnNameAndIsWantedOnlyWhereAsked) {
    const Sample all = decorated(), none = five_balls();
    std::set<std::string> names;
    for (const ElementKind& kind : element_kinds()) {
        ASSERT_NE(nullptr, kind.make);
        ASSERT_NE(nullptr, kind.wanted);
        if (kind.name == nullptr) continue;
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
        if (kind.name == std::string("against")) continue;  // the command line may ask for it
        EXPECT_FALSE(kind.wanted(none.scene)) << kind.name;
        EXPECT_EQ(kind.name != std::string("verdict"), kind.wanted(all.scene)) << kind.name;
    }
    EXPECT_EQ(11u, names.size());
}

TEST(Elements, AWholePictureHasWhatTheSceneAsksFor) {
    const std::set<std::string> expected = {"ruler", "clock", "title",    "caption", "plot",
                                            "peaks", "trail", "velocity", "labels"};
    EXPECT_EQ(expected, made(decorated(), PicturePart::kWhole, nullptr, nullptr));
    EXPECT_TRUE(made(five_balls(), PicturePart::kWhole, nullptr, nullptr).empty());
    const Sample sample = decorated();
    const SecondRun second = second_of(sample);
    const BothRuns both = both_runs(sample.scene, sample.motion, second);
    std::set<std::string> ghosts = expected;
    ghosts.insert("against");
    EXPECT_EQ(ghosts, made(sample, PicturePart::kWhole, &second, &both));
}

TEST(Elements, WhatIsSaidOnceStandsOverBothHalvesAndTheRestInEach) {
    const Sample sample = decorated();
    const SecondRun second = second_of(sample);
    const BothRuns both = both_runs(sample.scene, sample.motion, second);
    EXPECT_EQ((std::set<std::string>{"clock", "title", "caption", "against"}),
              made(sample, PicturePart::kOverHalves, &second, nullptr));
    for (const PicturePart half : {PicturePart::kFirstHalf, PicturePart::kSecondHalf})
        EXPECT_EQ((std::set<std::string>{"ruler", "run name", "plot", "peaks", "trail", "velocity",
                                         "labels"}),
                  made(sample, half, &second, &both));
}

// A ghost's trail is drawn in the picture that shows the ghost; a half shows its own run.
TEST(Elements, OnlyAPictureOfGhostsTracesBothRuns) {
    const Sample sample = decorated();
    const SecondRun second = second_of(sample);
    const BothRuns both = both_runs(sample.scene, sample.motion, second);
    const View view = view_of(sample, kSize);
    ElementContext context{sample.scene, sample.motion, view, PicturePart::kWhole, &second, &both};
    EXPECT_EQ(&both.motion, &context.traced_motion());
    context.part = PicturePart::kFirstHalf;
    EXPECT_EQ(&sample.motion, &context.traced_motion());
    EXPECT_EQ(&sample.scene, &context.traced_scene());
}

TEST(Elements, PlacesAreTakenOnce) {
    const Sample sample = decorated();
    const OverlayPainter overlay(sample.scene, sample.motion, view_of(sample, {640, 360}));
    const std::vector<PixelRect>& taken = overlay.obstacles();
    EXPECT_EQ(4u, taken.size()) << "clock, title, caption and plot";
    for (std::size_t i = 0; i < taken.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(taken[i].overlaps(taken[j]));
}

}  // namespace
}  // namespace carom
