// What the fits share: how they refuse, and the factor of their intervals.
#pragma once

#include <string>

#include "core/failure.h"

namespace carom {

inline constexpr double kNormal95 = 1.959963984540054;  ///< P(|z| < 1.96) = 0.95

[[noreturn]] inline void refuse_fit(const std::string& why) {
    throw Failure(FailureKind::kInput, why);
}

}  // namespace carom
