#include "scene/repeat.h"

#include <fmt/format.h>

#include <random>

namespace carom {

namespace {

/// Uniform in [0, 1). std::uniform_real_distribution differs between standard libraries.
double uniform(std::mt19937_64& generator) {
    constexpr double kTwoToMinus53 = 1.0 / 9007199254740992.0;
    return static_cast<double>(generator() >> 11U) * kTwoToMinus53;
}

}  // namespace

std::vector<Ball> repeat_ball(const Ball& ball, const RepeatGrid& grid) {
    std::mt19937_64 generator(grid.seed);
    std::vector<Ball> balls;
    for (int i = 0; i < grid.count[0]; ++i)
        for (int j = 0; j < grid.count[1]; ++j)
            for (int k = 0; k < grid.count[2]; ++k) {
                Ball one = ball;
                one.name = fmt::format("{}_{}_{}_{}", ball.name, i, j, k);
                one.position += grid.spacing.cwiseProduct(Vec3(i, j, k));
                if (grid.jitter > 0)
                    for (int axis = 0; axis < 3; ++axis)
                        one.position[axis] += grid.jitter * uniform(generator);
                balls.push_back(std::move(one));
            }
    return balls;
}

}  // namespace carom
