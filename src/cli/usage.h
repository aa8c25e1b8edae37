// How commands refuse what they are asked for.
#pragma once

#include <string>

#include "core/failure.h"

namespace carom {

[[noreturn]] inline void usage(const std::string& message) {
    throw Failure(FailureKind::kInput, message);
}

}  // namespace carom
