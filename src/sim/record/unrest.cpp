#include "sim/record/unrest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace carom {

namespace {

/// More names than this do not help to find the cause.
constexpr std::size_t kMostNames = 3;

std::string told(const UnrestedBall& b) {
    if (b.speed == 0 && b.slip > 0)
        return fmt::format("{} {}, spinning at {:.3g} m/s", b.name, b.does, b.slip);
    return fmt::format("{} {} at {:.3g} m/s", b.name, b.does, b.speed);
}

}  // namespace

std::string unrest_text(const std::vector<UnrestedBall>& balls, double seconds) {
    if (balls.empty()) return {};
    std::string text = fmt::format("duration: rest ends at max_duration, {} s: ", seconds);
    const std::size_t named = std::min(balls.size(), kMostNames);
    for (std::size_t i = 0; i < named; ++i) text += (i > 0 ? ", " : "") + told(balls[i]);
    if (balls.size() > named) text += fmt::format(", and {} more", balls.size() - named);
    return text;
}

}  // namespace carom
