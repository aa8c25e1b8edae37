// How much motion a run may keep.
#pragma once

#include <fmt/format.h>

#include <cstddef>

#include "core/failure.h"

namespace carom {

/// Pieces and events together: an impact gives one of each. Each takes up to 200 bytes, pieces
/// twice that while they are put in order: some 4 GB. A ball that bounces once a second comes that
/// far in three months.
inline constexpr std::size_t kMostKept = 16'000'000;

/// Throws Failure(kRun) that says how far the motion came, before memory ends.
inline void require_room(std::size_t kept, double time, double end) {
    if (kept <= kMostKept) return;
    throw Failure(
        FailureKind::kRun,
        fmt::format(
            "the motion has {} pieces and events by t = {:.6g} s of {:.6g} s, more than can "
            "be kept: shorten simulation.duration, or let the balls lose energy "
            "(restitution below 1) so that they come to rest",
            kept, time, end));
}

}  // namespace carom
