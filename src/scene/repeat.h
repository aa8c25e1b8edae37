// A grid of equal balls from one: `repeat` of a scene file.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace carom {

struct RepeatGrid {
    std::array<int, 3> count = {1, 1, 1};
    Vec3 spacing = Vec3::Zero();  ///< m, between centres along x, y and z
    double jitter = 0;            ///< m
    std::uint64_t seed = 1;
};

/// Balls NAME_i_j_k with i along x, j along y, k along z, from 0, k running fastest; ball i, j, k
/// stands at ball.position + (i, j, k) * spacing + u, each coordinate of u uniform in [0, jitter).
///
/// The random numbers are the same on every machine: std::mt19937_64 (whose output the C++ standard
/// fixes) seeded with `seed`, its upper 53 bits over 2^53, in the order of the balls and x, y, z.
std::vector<Ball> repeat_ball(const Ball& ball, const RepeatGrid& grid);

}  // namespace carom
