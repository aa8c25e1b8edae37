// Random tracks: surfaces that touch each other, and a ball or two on them.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace carom::bench {

/// A track of one of several kinds: boxes whose top edges meet (flush, convex, concave), tiles,
/// capsules in line, rails of capsules, boxes in a plane. Pair coefficients 0 ... 1, friction
/// 0 ... 1, speeds up to 10 m/s. The balls touch the track or fall on it.
Scene random_track(std::uint64_t seed);

/// The same straight track twice: of flush boxes, and as one long box.
struct SeamPair {
    Scene seams, whole;
};
SeamPair random_seams(std::uint64_t seed);

}  // namespace carom::bench
