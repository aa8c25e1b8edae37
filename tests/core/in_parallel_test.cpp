#include "core/in_parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace carom {
namespace {

TEST(InParallel, DoesEachOnce) {
    std::vector<std::atomic<int>> done(1000);
    in_parallel(1000, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    for (const auto& count : done) EXPECT_EQ(1, count);
    in_parallel(0, [](int) { FAIL(); });
}

TEST(InParallel, ThrowsTheFirstExceptionAndEndsTheRest) {
    std::atomic<int> begun = 0;
    EXPECT_THROW(in_parallel(1'000'000,
                             [&](int) {
                                 ++begun;
                                 throw std::runtime_error("none");
                             }),
                 std::runtime_error);
    EXPECT_LT(begun, 100);
}

}  // namespace
}  // namespace carom
