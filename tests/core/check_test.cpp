#include "core/check.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(Check, PassesWhereTheComparisonHolds) {
    EXPECT_NO_THROW(CAROM_CHECK(1, <, 2));
    EXPECT_NO_THROW(CAROM_CHECK(std::string("a"), ==, "a"));
}

TEST(Check, SaysBothSidesAndThePlace) {
    const int index = 7;
    try {
        CAROM_CHECK(index, <, 3 + 2);
        FAIL() << "7 < 5 passed";
    } catch (const Bug& bug) {
        const std::string text = bug.what();
        EXPECT_NE(text.find("index < 3 + 2"), std::string::npos) << text;
        EXPECT_NE(text.find("7 against 5"), std::string::npos) << text;
        EXPECT_NE(text.find("check_test.cpp:"), std::string::npos) << text;
    }
}

TEST(Check, EvaluatesEachSideOnce) {
    int calls = 0;
    const auto next = [&calls] { return ++calls; };
    CAROM_CHECK(next(), ==, 1);
    EXPECT_EQ(calls, 1);
    EXPECT_THROW(CAROM_CHECK(next(), ==, 1), Bug);
    EXPECT_EQ(calls, 2);
}

TEST(Check, IsOneStatement) {
    bool other = false;
    if (other)
        CAROM_CHECK(0, ==, 1);
    else
        other = true;
    EXPECT_TRUE(other);
}

}  // namespace
}  // namespace carom
