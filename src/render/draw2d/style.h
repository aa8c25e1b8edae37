// Sizes, inks and names that the elements over a picture share.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "render/draw2d/canvas.h"
#include "scene/scene.h"

namespace carom {

inline constexpr Ink kSlate{0.122, 0.161, 0.216, 1};  // #1f2937
inline constexpr Ink kPaper{1, 1, 1, 1};
inline constexpr Ink kGood{0.043, 0.498, 0.318, 1};  // #0b7f51
inline constexpr Ink kBad{0.753, 0.161, 0.153, 1};   // #c02927

/// The inks of a theme: letters and lines, what lies below them, and the two verdicts.
struct Palette {
    Ink ink = kSlate, paper = kPaper, good = kGood, bad = kBad;
};
inline Palette palette_of(Theme theme) {
    if (theme == Theme::kLight) return {};
    return {{0.914, 0.929, 0.953, 1},   // #e9edf3
            {0.071, 0.094, 0.133, 1},   // #121822
            {0.204, 0.780, 0.541, 1},   // #34c78a
            {0.965, 0.455, 0.420, 1}};  // #f6746b
}
inline Ink with_alpha(const Ink& ink, double alpha) { return {ink.r, ink.g, ink.b, alpha}; }

/// Letters smaller than this are not legible.
inline constexpr double kSmallestLetters = 9.5;
/// Text that would have to shrink below this to fit is left out.
inline constexpr double kLeastLetters = 4;

/// A length given at a picture height of 720 pixels.
inline double overlay_px(double at_720, int height_px) { return at_720 * height_px / 720; }

inline double letters_px(double at_720, int height_px) {
    return std::max(overlay_px(at_720, height_px), kSmallestLetters);
}

/// Pixels that hold a length.
inline int whole_px(double px) { return static_cast<int>(std::ceil(px)); }

/// Between what stands in a corner and the picture's edges.
inline int border_px(int height_px) { return whole_px(std::max(overlay_px(18, height_px), 5.0)); }

/// A plate at the upper left of a picture: paper of this opacity, with round corners and a thin
/// edge. Lengths in px.
void draw_plate(Canvas& canvas, int width, int height, double radius, const Palette& palette,
                double opacity);

/// A colour of the ball's look that is legible on a light floor, or on a dark one.
Ink trail_ink(const Look& look, Theme theme = Theme::kLight);

/// The colour that stands for the second run: outlines, trails, text.
Ink ghost_ink(Theme theme);

/// "table_tennis" as people write it.
std::string label_text(const std::string& name);

}  // namespace carom
