#include <fmt/format.h>

#include "media/frame_sink.h"
#include "media/png.h"
#include "media_fixture.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

class PngSequenceTest : public FolderTest {};

TEST(SequencePath, PutsTheNumberIn) {
    EXPECT_EQ(sequence_path("out/f_%05d.png", 42), "out/f_00042.png");
    EXPECT_EQ(sequence_path("f%d.png", 42), "f42.png");
    EXPECT_EQ(sequence_path("f%03d.png", 1234567), "f1234567.png");
    EXPECT_EQ(sequence_path("100%%_%02d.png", 7), "100%_07.png");
    EXPECT_EQ(sequence_path("{0}_%d.png", 7), "{0}_7.png");
    EXPECT_EQ(sequence_path("%012d.png", 7'000'000'000), "007000000000.png");
}

TEST(SequencePath, NamesFramesInAFolder) {
    EXPECT_EQ(sequence_path("out", 3), "out/frame_00003.png");
    EXPECT_EQ(sequence_path("out/", 3), "out/frame_00003.png");
    EXPECT_EQ(sequence_path("50%%", 123456), "50%/frame_123456.png");
}

TEST(SequencePath, RefusesOtherPatterns) {
    for (const std::string pattern :
         {"%s.png", "%d_%d.png", "%5d.png", "%.3d.png", "%ld.png", "%x.png", "a%", "%0", "%-5d.png",
          "%d/frame.png", "%099d.png", "%n%d.png", ""}) {
        const std::string text =
            failure_text(FailureKind::kInput, [&] { sequence_path(pattern, 1); });
        EXPECT_TRUE(contains(text, "'" + pattern + "'")) << text;
        EXPECT_THROW(make_png_sequence(pattern), Failure) << pattern;
    }
}

TEST_F(PngSequenceTest, WritesEveryFrameUnderItsNumber) {
    for (const int threads : {1, 3}) {
        const std::string folder = in_folder(fmt::format("frames{}/deep", threads));
        const auto sink = make_png_sequence(folder + "/f_%04d.png", threads);
        for (int k = 0; k < 20; ++k)
            sink->write(100 + k, noise_image(16, 8, static_cast<unsigned>(k)));
        sink->finish();
        EXPECT_GT(sink->times().encode_cpu_s, 0);
        EXPECT_GT(sink->times().write_cpu_s, 0);
        int files = 0;
        for (const auto& entry : fs::directory_iterator(folder)) {
            EXPECT_EQ(entry.path().filename().string().front(), 'f') << entry.path();
            ++files;
        }
        EXPECT_EQ(files, 20);
        for (int k = 0; k < 20; ++k)
            EXPECT_TRUE(read_png(fmt::format("{}/f_{:04}.png", folder, 100 + k)) ==
                        noise_image(16, 8, static_cast<unsigned>(k)));
    }
}

TEST_F(PngSequenceTest, MakesTheFolderAndTwoRunsAreAlike) {
    std::string bytes[2];
    for (int run = 0; run < 2; ++run) {
        const auto sink = make_png_sequence(in_folder("new"));
        sink->write(0, noise_image(16, 8, 1));
        sink->finish();
        bytes[run] = bytes_of(in_folder("new/frame_00000.png"));
    }
    EXPECT_FALSE(bytes[0].empty());
    EXPECT_TRUE(bytes[0] == bytes[1]);
}

TEST_F(PngSequenceTest, KeepsTheWholeFrames) {
    auto sink = make_png_sequence(in_folder("frames"));
    EXPECT_EQ(sink->keep_partial(), "");
    for (int k = 0; k < 5; ++k) sink->write(k, noise_image(16, 8, 1));
    EXPECT_EQ(sink->keep_partial(), in_folder("frames"));
    sink.reset();
    int files = 0;
    for (const auto& entry : fs::directory_iterator(in_folder("frames"))) {
        EXPECT_NO_THROW(read_png(entry.path().string()));
        ++files;
    }
    EXPECT_EQ(files, 5);
}

TEST_F(PngSequenceTest, AFullDiskIsAFailureThatLeavesNoHalfFrame) {
    const FullDisk full(1000);
    auto sink = make_png_sequence(in_folder("frames"));
    const std::string text = failure_text(FailureKind::kOutput, [&] {
        for (int k = 0; k < 20; ++k) sink->write(k, noise_image(64, 64, 1));
        sink->finish();
    });
    EXPECT_TRUE(contains(text, "File too large")) << text;
    sink.reset();
    EXPECT_TRUE(fs::is_empty(in_folder("frames")));
}

TEST_F(PngSequenceTest, AFolderThatCannotBeMadeIsAFailure) {
    std::ofstream(in_folder("file")) << "";
    const std::string text =
        failure_text(FailureKind::kOutput, [&] { make_png_sequence(in_folder("file/frames")); });
    EXPECT_TRUE(contains(text, in_folder("file/frames"))) << text;
    EXPECT_THROW(make_png_sequence(in_folder("file")), Failure);
}

}  // namespace
}  // namespace carom
