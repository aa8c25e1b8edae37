// Bodies that overlap at the start. A motion cannot begin from such a scene: a solver would push
// the bodies apart with speeds from nowhere.
#pragma once

#include <limits>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// Deeper than this, in units of the smaller radius, is an overlap; up to it bodies touch.
inline constexpr double kTouchingDepth = 1e-9;

/// Far from the origin, or where something is huge, bodies also touch up to this part of the
/// numbers that say where they are: a depth is the difference of a few of them, each rounded.
inline constexpr double kPlaceRounding = 8 * std::numeric_limits<double>::epsilon();

struct BallOverlap {
    int first = 0, second = 0;  ///< into Scene::balls, first < second
    double depth = 0;           ///< m
};

struct SurfaceOverlap {
    int ball = 0, surface = 0;
    double depth = 0;      ///< m
    double behind_by = 0;  ///< m; above 0 where the centre lies behind a plane
};

/// Ordered by indices. `too_many`: the search was given up, see kMostComparisons. At most
/// kMostOverlaps of each: a scene with more is wrong as a whole.
struct OverlapList {
    std::vector<BallOverlap> balls;
    std::vector<SurfaceOverlap> surfaces;
    bool too_many = false;
};
inline constexpr std::size_t kMostOverlaps = 10'000;

/// Pairs of a ball and a surface beside it that are looked at: two seconds. A million balls may
/// have thirty surfaces around all of them.
inline constexpr std::size_t kMostComparisons = 30'000'000;

/// Searches the bodies whose entry is true. The cost grows like n log n for n balls that do not
/// overlap, whatever their sizes.
OverlapList find_overlaps(const Scene& scene, const std::vector<bool>& balls,
                          const std::vector<bool>& surfaces);

}  // namespace carom
