// The rows of the table that describe what is written over the picture.
#include "scene/keys.h"

namespace carom {

namespace {

/// What is shown or not; a mapping shows it, with what is said there.
KeySpec element(std::string_view key, Section child, std::string_view doc,
                std::string_view example) {
    return {.section = Section::kOverlay,
            .key = key,
            .forms = form::kBool | form::kMap,
            .child = child,
            .fallback = false,
            .doc = doc,
            .example = example};
}

KeySpec letters(Section section, double fallback, std::string_view doc, std::string_view example) {
    return {.section = section,
            .key = "size_px",
            .forms = form::kNumber,
            .range = above_up_to(0, 200),
            .unit = "pixels",
            .fallback = fallback,
            .doc = doc,
            .example = example};
}

KeySpec corner(Section section, const char* fallback, std::string_view doc,
               std::string_view example) {
    return {.section = section,
            .key = "corner",
            .forms = form::kWord,
            .words = {"top_left", "top_right", "bottom_left", "bottom_right"},
            .fallback = fallback,
            .doc = doc,
            .example = example};
}

}  // namespace

std::vector<KeySpec> overlay_keys() {
    using enum Section;
    using namespace form;
    return {
        element("ruler", kRuler, "A vertical scale in metres beside the balls.", "true"),
        element("clock", kClock, "The time of the motion.", "true"),
        element("trail", kTrail, "The path of each ball's centre.", "{seconds: 1.5}"),
        element("labels", kLabels, "The balls' names beside them.", "true"),
        element("title", kTitle, "The scene's `title`, at the top of the picture.", "true"),
        {.section = kOverlay,
         .key = "caption",
         .forms = kText,
         .fallback_doc = "none",
         .doc = "Text at the bottom of the picture, of at most 400 characters; long lines are "
                "broken.",
         .example = "Dropped from 1.8 m"},
        element("peaks", kPeaks, "A mark at each peak that a ball has reached, with its height.",
                "true"),
        element("velocity", kVelocity, "The balls' velocities as arrows.", "{scale: 0.1}"),
        element("plot", kPlot, "An inset plot of height over time that grows with the film.",
                "{ball: a, corner: bottom_right}"),
        {.section = kOverlay,
         .key = "theme",
         .forms = kWord,
         .words = {"light", "dark"},
         .fallback = "light",
         .doc = "`light`: dark letters on light plates, for light surfaces; `dark`: light letters "
                "on dark plates.",
         .example = "dark"},

        {.section = kRuler,
         .key = "at",
         .forms = kNumbers,
         .count = 2,
         .range = kCoordinate,
         .unit = "m",
         .fallback_doc = "beside the motion",
         .doc = "x and y of the scale's foot.",
         .example = "[-0.5, 0]"},
        {.section = kRuler,
         .key = "from",
         .forms = kNumber,
         .range = kCoordinate,
         .unit = "m",
         .fallback = 0.0,
         .doc = "Height of the scale's foot.",
         .example = "0"},
        {.section = kRuler,
         .key = "to",
         .forms = kNumber,
         .range = kCoordinate,
         .unit = "m",
         .fallback_doc = "a little above the motion",
         .doc = "Height of the scale's upper end.",
         .example = "2"},
        {.section = kRuler,
         .key = "band",
         .forms = kNumbers,
         .count = 2,
         .range = kCoordinate,
         .unit = "m",
         .fallback_doc = "none",
         .doc = "Heights between which the scale is marked.",
         .example = "[1.2, 1.4]"},
        corner(kClock, "top_left", "Where the clock stands in the picture.", "top_right"),
        {.section = kClock,
         .key = "digits",
         .forms = kInteger,
         .range = between(0, 9),
         .fallback = 2,
         .doc = "Digits after the decimal point of the seconds.",
         .example = "3"},
        {.section = kTrail,
         .key = "seconds",
         .forms = kNumber,
         .range = above(0),
         .unit = "s",
         .fallback_doc = "the whole path",
         .doc = "How far back a trail reaches.",
         .example = "1.5"},
        {.section = kTrail,
         .key = "width_px",
         .forms = kNumber,
         .range = above_up_to(0, 100),
         .unit = "pixels",
         .fallback = 2.0,
         .doc = "Width of the line in a picture of 720 lines; it grows with the picture.",
         .example = "3"},
        letters(kLabels, 15.0,
                "Height of the letters in a picture of 720 lines; it grows with the picture.",
                "18"),
        letters(kTitle, 22.0,
                "Height of the letters in a picture of 720 lines; it grows with the picture, and a "
                "long title gets smaller ones.",
                "28"),
        letters(kPeaks, 13.0,
                "Height of the letters in a picture of 720 lines; it grows with the picture. "
                "Heights that have no room beside their marks are left out.",
                "16"),
        {.section = kVelocity,
         .key = "scale",
         .forms = kNumber,
         .range = above_up_to(0, 1e9),
         .unit = "m per m/s",
         .fallback_doc = "1, 2 or 5 times a power of ten, such that the longest arrow is at most a "
                         "quarter of the picture high",
         .doc = "Length of the arrow of a ball at 1 m/s.",
         .example = "0.1"},
        {.section = kPlot,
         .key = "ball",
         .forms = kReference | kReferences,
         .fallback_doc = "all balls",
         .doc = "The ball that is plotted, or a list of balls, at most 12.",
         .example = "[a, b]"},
        {.section = kPlot,
         .key = "size",
         .forms = kNumbers,
         .count = 2,
         .range = between(0.1, 1),
         .fallback = {0.36, 0.36},
         .doc = "Width and height as shares of the picture's.",
         .example = "[0.5, 0.3]"},
        corner(kPlot, "top_right", "Where the plot stands in the picture.", "bottom_right"),
    };
}

}  // namespace carom
