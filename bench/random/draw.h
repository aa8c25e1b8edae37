// Random numbers of a seed: the same ones with every compiler (the standard's distributions are
// not).
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

#include "core/types.h"

namespace carom::bench {

class Draw {
  public:
    explicit Draw(std::uint64_t seed) : engine_(seed) {
        engine_.discard(16);  // seeds that differ in one bit begin alike
    }

    double unit() { return std::ldexp(static_cast<double>(engine_() >> 11), -53); }  ///< [0, 1)
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    double log_uniform(double low, double high) {
        return low * std::exp(std::log(high / low) * unit());
    }
    bool chance(double p) { return unit() < p; }
    /// low ... high, both included.
    int integer(int low, int high) {
        return low + static_cast<int>(unit() * static_cast<double>(high - low + 1));
    }
    double pick(std::initializer_list<double> values) {
        return values.begin()[integer(0, static_cast<int>(values.size()) - 1)];
    }

    Vec3 direction() {
        const double z = uniform(-1, 1), turn = uniform(-M_PI, M_PI);
        const double across = std::sqrt(1 - z * z);
        return {across * std::cos(turn), across * std::sin(turn), z};
    }
    Vec3 in_cube(double half) {
        const double x = uniform(-half, half), y = uniform(-half, half);
        return {x, y, uniform(-half, half)};
    }
    Quat rotation() {
        const Vec3 axis = direction();
        return Quat(Eigen::AngleAxisd(uniform(0, M_PI), axis));
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace carom::bench
