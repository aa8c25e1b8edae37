// Folders for work on the way: each its own, and nothing left.
#include "core/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

namespace carom {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, GoesWithItsContent) {
    std::optional<TemporaryFolder> one, other;
    one.emplace(FailureKind::kOutput);
    other.emplace(FailureKind::kOutput);
    EXPECT_NE(one->path(), other->path());
    EXPECT_TRUE(fs::is_empty(one->path()));
    std::ofstream(one->file("a.txt")) << "content";
    fs::create_directory(one->path() / "below");
    EXPECT_EQ(one->path() / "a.txt", fs::path(one->file("a.txt")));
    const fs::path was = one->path();
    one.reset();
    EXPECT_FALSE(fs::exists(was));
    EXPECT_TRUE(fs::exists(other->path()));
}

TEST(TemporaryFolder, SaysThatThereIsNoPlaceForIt) {
    const char* before = std::getenv("TMPDIR");
    const std::string kept = before == nullptr ? "" : before;
    ASSERT_EQ(0, setenv("TMPDIR", "/no/such/place", 1));
    try {
        const TemporaryFolder folder(FailureKind::kRun);
        ADD_FAILURE() << "made in " << folder.path();
    } catch (const Failure& failure) {
        EXPECT_EQ(FailureKind::kRun, failure.kind());
        EXPECT_NE(std::string::npos, std::string(failure.what()).find("TMPDIR")) << failure.what();
    }
    ASSERT_EQ(0, before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1));
}

}  // namespace
}  // namespace carom
