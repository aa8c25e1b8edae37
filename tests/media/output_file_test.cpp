#include "media/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include "media_fixture.h"

namespace carom {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class OutputFileTest : public FolderTest {};

TEST_F(OutputFileTest, AppearsOnlyWithCommit) {
    const std::string path = in_folder("film.mp4");
    OutputFile file(path);
    EXPECT_EQ(file.path(), path);
    EXPECT_EQ(fs::path(file.temporary_path()).parent_path(), folder_);
    EXPECT_EQ(fs::path(file.temporary_path()).extension(), ".mp4");
    EXPECT_EQ(names(), Names{fs::path(file.temporary_path()).filename().string()});
    std::ofstream(file.temporary_path()) << "whole";
    EXPECT_FALSE(fs::exists(path));
    file.commit();
    EXPECT_EQ(names(), Names{"film.mp4"});
    EXPECT_EQ(bytes_of(path), "whole");
}

TEST_F(OutputFileTest, LeavesNothingWithoutCommitAndTheOldFileAsItWas) {
    const std::string path = in_folder("film.mp4");
    std::ofstream(path) << "old";
    {
        const OutputFile file(path);
        std::ofstream(file.temporary_path()) << "half";
        EXPECT_EQ(names().size(), 2U);
    }
    EXPECT_EQ(names(), Names{"film.mp4"});
    EXPECT_EQ(bytes_of(path), "old");
}

TEST_F(OutputFileTest, TwoForOnePathDoNotMeet) {
    OutputFile one(in_folder("a.txt"));
    OutputFile two(in_folder("a.txt"));
    EXPECT_NE(one.temporary_path(), two.temporary_path());
    std::ofstream(one.temporary_path()) << "one";
    std::ofstream(two.temporary_path()) << "two";
    two.commit();
    one.commit();
    EXPECT_EQ(bytes_of(in_folder("a.txt")), "one");
    EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(OutputFileTest, AMoveTakesTheTemporaryFileAlong) {
    OutputFile kept(in_folder("kept.txt"));
    {
        OutputFile first(in_folder("a.txt"));
        OutputFile second(std::move(first));
        EXPECT_EQ(names().size(), 2U);
        kept = std::move(second);  // what `kept` held is removed
        EXPECT_EQ(names().size(), 1U);
    }
    EXPECT_EQ(names().size(), 1U);
    kept.commit();
    EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(OutputFileTest, CommitsUnderAnotherName) {
    OutputFile file(in_folder("film.mp4"));
    file.commit_as(partial_path(file.path()));
    EXPECT_EQ(names(), Names{"film.partial.mp4"});
}

TEST_F(OutputFileTest, ALinkStaysAndItsTargetIsReplaced) {
    fs::create_directory(folder_ / "disk");
    fs::create_symlink("disk/there.txt", folder_ / "link.txt");  // leads nowhere yet
    write_text_file(in_folder("link.txt"), "one");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
    EXPECT_EQ(bytes_of(in_folder("disk/there.txt")), "one");
    write_text_file(in_folder("link.txt"), "two");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
    EXPECT_EQ(bytes_of(in_folder("disk/there.txt")), "two");
    EXPECT_THROW(require_writable(in_folder("link.txt"), false), Failure);

    fs::create_symlink("round.txt", folder_ / "round.txt");
    const std::string text =
        failure_text(FailureKind::kOutput, [&] { write_text_file(in_folder("round.txt"), "x"); });
    EXPECT_TRUE(contains(text, "symbolic links")) << text;
}

TEST_F(OutputFileTest, AnyNameThatTheDiskTakes) {
    const Names all = {".hidden",
                       "a b.txt",
                       "c:d.txt",
                       "e%d.txt",
                       "noextension",
                       "ä.txt",
                       std::string(251, 'x') + ".txt"};
    for (const std::string& name : all) {
        write_text_file(in_folder(name), name);
        EXPECT_EQ(bytes_of(in_folder(name)), name);
    }
    EXPECT_EQ(names().size(), all.size());
}

TEST_F(OutputFileTest, ADeviceIsWrittenInPlaceAndNeverReplaced) {
    EXPECT_NO_THROW(require_writable("/dev/null", false));
    write_text_file("/dev/null", "gone");
    struct stat info = {};
    ASSERT_EQ(stat("/dev/null", &info), 0);
    EXPECT_TRUE(S_ISCHR(info.st_mode));
    const std::string text =
        failure_text(FailureKind::kOutput, [] { write_text_file("/dev/full", "no room"); });
    EXPECT_TRUE(contains(text, "'/dev/full': No space left on device")) << text;
}

TEST_F(OutputFileTest, AFullDiskIsAFailureThatLeavesNothing) {
    const FullDisk full(1000);
    const std::string path = in_folder("a.txt");
    const std::string text =
        failure_text(FailureKind::kOutput, [&] { write_text_file(path, std::string(5000, 'x')); });
    EXPECT_TRUE(contains(text, path + "': File too large")) << text;
    EXPECT_EQ(names(), Names{});
}

TEST_F(OutputFileTest, FoldersThatCannotBeWritten) {
    std::ofstream(in_folder("file")) << "";
    for (const std::string& path :
         {in_folder("missing/a.txt"), in_folder("file/a.txt"), std::string("/proc/carom.txt")}) {
        const std::string text =
            failure_text(FailureKind::kOutput, [&] { const OutputFile file(path); });
        EXPECT_TRUE(contains(text, path)) << text;
    }
    EXPECT_TRUE(contains(failure_text(FailureKind::kOutput,
                                      [&] { require_writable(in_folder("missing/a.txt"), true); }),
                         in_folder("missing") + "': No such file or directory"));
    EXPECT_TRUE(contains(failure_text(FailureKind::kOutput,
                                      [&] { require_writable(in_folder("file/a.txt"), true); }),
                         "Not a directory"));
    EXPECT_TRUE(contains(
        failure_text(FailureKind::kOutput, [&] { require_writable(folder_.string(), true); }),
        "Is a directory"));
    EXPECT_THROW(const OutputFile file(folder_.string()), Failure);
}

TEST_F(OutputFileTest, AnExistingFileNeedsLeave) {
    const std::string path = in_folder("a.txt");
    EXPECT_NO_THROW(require_writable(path, false));
    EXPECT_EQ(names(), Names{});  // asking leaves no trace
    std::ofstream(path) << "old";
    EXPECT_NO_THROW(require_writable(path, true));
    const std::string text =
        failure_text(FailureKind::kOutput, [&] { require_writable(path, false); });
    EXPECT_TRUE(contains(text, path)) << text;
    EXPECT_TRUE(contains(text, "-y")) << text;
    EXPECT_EQ(bytes_of(path), "old");
}

TEST_F(OutputFileTest, HonoursTheUmask) {
    const mode_t before = umask(027);
    write_text_file(in_folder("a.txt"), "x");
    umask(before);
    struct stat info = {};
    ASSERT_EQ(stat(in_folder("a.txt").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0640U);
}

TEST(PartialPath, StandsBeforeTheExtension) {
    EXPECT_EQ(partial_path("out/film.mp4"), "out/film.partial.mp4");
    EXPECT_EQ(partial_path("film.v2.mkv"), "film.v2.partial.mkv");
    EXPECT_EQ(partial_path("/a.b/film"), "/a.b/film.partial");
}

}  // namespace
}  // namespace carom
