// Parts of goldens that are not compared: side files beside them.
#pragma once

#include <string>
#include <vector>

#include "core/pixel_rect.h"

namespace carom {

/// DIR/<still>.ignore.yaml holds for one golden, DIR/<scene>.ignore.yaml for all of a scene:
///
///     ignore:
///       - {x: 10, y: 20, width: 100, height: 30, why: the clock}
///
/// in pixels of the golden, from its upper left corner; `why` may be left out.
inline constexpr const char* kIgnoreEnding = ".ignore.yaml";

/// The rectangles of both files, in their order; none where there are no such files. Throws
/// Failure(kInput) with every mistake as file:line:column where one cannot be read or is wrong.
std::vector<PixelRect> ignored_rects(const std::string& folder, const std::string& still);

/// Throws Failure(kInput) where a rectangle leaves a picture of that size, or nothing is left of
/// it.
void require_inside(const std::vector<PixelRect>& rects, int width_px, int height_px,
                    const std::string& still);

/// How many pixels the rectangles cover together.
long covered_pixels(const std::vector<PixelRect>& rects, int width_px, int height_px);

}  // namespace carom
