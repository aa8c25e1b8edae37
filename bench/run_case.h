// One run of a case by one engine, in a process of its own: an engine that crashes, hangs or fills
// the memory costs its own row only.
#pragma once

#include <cstdint>
#include <string>

#include "case.h"
#include "engine.h"

namespace carom::bench {

struct Outcome {
    enum class Kind {
        kDone,
        kRefused,  ///< by the reader of scenes, as it must be
        kFailed,   ///< the engine gave up with a message
        kCut,      ///< used up its CPU time
        kCrashed,
    };
    Kind kind = Kind::kCrashed;
    // Of the measure that is furthest from its limit.
    double error = 0;
    double limit = 0;
    std::string what;  ///< in words: the measure, or the engine's message
    std::string how;   ///< what goes wrong beyond inexactness, in words; "" if nothing

    double cpu_s = 0;        ///< of the simulation; the median where it is short enough to repeat
    double simulated_s = 0;  ///< what it got to
    std::int64_t steps = 0;

    bool holds() const { return (kind == Kind::kDone && error <= limit) || kind == Kind::kRefused; }
};

/// `repeat`: a short run is repeated, so that its cost is a median.
Outcome run_case(const Case& one, const Run& run, const Engine& engine, double cpu_limit_s,
                 bool repeat);

}  // namespace carom::bench
