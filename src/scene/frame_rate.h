// Frames or rows per second as a fraction.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace carom {

/// The fraction with the smallest denominator that is `value` to 12 digits, by continued fractions:
/// 23.976 is 2997/125. Times are computed from it, so that they do not drift.
FrameRate frame_rate(double value);

/// "30000/1001", "29.97" or "1e6"; none where the text is no such number above 0 and at most
/// `most`.
std::optional<FrameRate> parse_rate(const std::string& text, double most);

}  // namespace carom
