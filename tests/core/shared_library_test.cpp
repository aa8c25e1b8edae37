#include "core/shared_library.h"

#include <gtest/gtest.h>

#include <string>

#include "core/failure.h"

namespace carom {
namespace {

/// What the failure says that `attempt` ends with.
template <class Attempt>
std::string failure_of(const Attempt& attempt) {
    try {
        attempt();
    } catch (const Failure& failure) {
        EXPECT_EQ(FailureKind::kRun, failure.kind());
        return failure.what();
    }
    return {};
}

TEST(SharedLibrary, FindsFunctions) {
    const SharedLibrary library("libm.so.6", "tests need numbers");
    double (*root)(double) = nullptr;
    library.find(root, "sqrt");
    EXPECT_EQ(3, root(9));
}

TEST(SharedLibrary, SaysWhatIsMissingAndWhoNeedsIt) {
    const std::string none =
        failure_of([] { const SharedLibrary library("libnone.so.9", "tests need none"); });
    EXPECT_NE(none.find("tests need none, but its library libnone.so.9"), std::string::npos)
        << none;
    EXPECT_NE(none.find("No such file"), std::string::npos) << none;
    const SharedLibrary library("libm.so.6", "tests need numbers");
    const std::string nothing = failure_of([&] {
        void (*function)() = nullptr;
        library.find(function, "no_such_function");
    });
    EXPECT_NE(nothing.find("libm.so.6 has no function no_such_function"), std::string::npos)
        << nothing;
}

}  // namespace
}  // namespace carom
