// What an action that is refused says.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/failure.h"

namespace carom {

/// Of a Failure(kInput); empty without one.
template <class Action>
std::string complaint(const Action& action) {
    try {
        action();
    } catch (const Failure& failure) {
        EXPECT_EQ(FailureKind::kInput, failure.kind());
        return failure.what();
    }
    return "";
}

inline bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace carom
