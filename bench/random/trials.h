// The kinds of random scenes: how one is made from a seed, and what its motion must keep.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "guarded.h"

namespace carom::bench {

/// What is judged at once; scenes as texts, so that a file of one gives the same motion.
struct Trial {
    std::uint64_t seed = 0;
    std::string scene;
    std::string other = {};  ///< the same track as one box (seams)
    int transform = -1;      ///< into transforms(seed)
    std::string about = {};  ///< the transform's name
};

struct Kind {
    std::string name;
    std::function<std::vector<Trial>(std::uint64_t seed)> make;
    /// In a child: throws what the simulation throws.
    std::function<Verdict(const Trial&, Watch&)> judge;
};

/// tracks, seams, scenes, shapes, air, transforms.
std::vector<Kind> all_kinds();

// Bounds, see the judges.
inline constexpr double kDepthLimit = 1e-9;      ///< m: the issue's for a ball on a track
inline constexpr double kSteppedDepth = 0.01;    ///< of a radius, as for piles (H22)
inline constexpr double kEnergyLimit = 1e-12;    ///< relative
inline constexpr double kSteppedEnergy = 1e-9;   ///< where ODE steps
inline constexpr double kMomentumLimit = 1e-12;  ///< relative
inline constexpr double kSeamLimit = 1e-11;      ///< m and m/s
inline constexpr double kCpuLimit = 1;           ///< s a second of motion
inline constexpr double kHang = 4;               ///< the same: taken for a hang
inline constexpr double kSpreadFactor = 100;     ///< differences over the spread of last digits
inline constexpr double kLargestSpread = 1e-6;   ///< m: up to there motions are compared

}  // namespace carom::bench
