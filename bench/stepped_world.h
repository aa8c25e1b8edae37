// A world that goes on by steps of one size: what the loops of SimBenchmark need of an engine.
#pragma once

#include "core/types.h"

namespace carom::bench {

class SteppedWorld {
  public:
    SteppedWorld() = default;
    SteppedWorld(const SteppedWorld&) = delete;
    SteppedWorld& operator=(const SteppedWorld&) = delete;
    virtual ~SteppedWorld() = default;

    virtual void step() = 0;
    /// Of ball i of the scene, after the last step: m, m/s, rad/s in world axes.
    virtual Vec3 position(std::size_t i) const = 0;
    virtual Vec3 velocity(std::size_t i) const = 0;
    virtual Vec3 spin(std::size_t i) const = 0;
};

}  // namespace carom::bench
