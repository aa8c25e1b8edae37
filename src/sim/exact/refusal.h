// What a run says when it cannot go on.
#pragma once

#include <string>

#include "sim/world/exact_world.h"

namespace carom {

/// Throws Failure(kRun) that names a ball, its partner (if it has one) and the time [s].
[[noreturn]] void refuse(const ExactWorld& world, const std::string& what, int ball,
                         const Partner& partner, double now);

}  // namespace carom
