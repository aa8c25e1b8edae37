// The double that is greater than all numbers.
#pragma once

#include <limits>

namespace carom {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace carom
