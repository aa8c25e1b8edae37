#include "sim/exact/refusal.h"

#include <fmt/core.h>

#include "core/failure.h"

namespace carom {

void refuse(const ExactWorld& world, const std::string& what, int ball, const Partner& partner,
            double now) {
    const std::string with = partner.index >= 0 ? fmt::format(" and {}", world.name(partner)) : "";
    throw Failure(FailureKind::kRun,
                  fmt::format("method exact, at {} s, {}{}: {}; use simulation.method: fixed", now,
                              world.body(ball).name, with, what));
}

}  // namespace carom
