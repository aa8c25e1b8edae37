// The film as a file: what a player finds in it, and when it appears.
#include <fmt/format.h>
#include <malloc.h>

#include <cstring>

#include "core/check.h"
#include "media/film_reader.h"
#include "media/frame_sink.h"
#include "media/libav.h"
#include "media_fixture.h"

namespace carom {
namespace {

using Names = std::vector<std::string>;

class FilmTest : public FolderTest {
  protected:
    /// A film of `frames` moving pictures.
    std::string make_film(const std::string& name, FilmOptions options, int frames) const {
        const std::string path = in_folder(name);
        const auto sink = make_film_writer(path, options);
        for (int k = 0; k < frames; ++k)
            sink->write(k, moving_picture(options.width_px, options.height_px, k));
        sink->finish();
        return path;
    }
};

FilmOptions small_film(int fps_numerator = 60, int fps_denominator = 1) {
    FilmOptions options;
    options.width_px = 160;
    options.height_px = 90;
    options.fps_numerator = fps_numerator;
    options.fps_denominator = fps_denominator;
    options.threads = 2;
    return options;
}

struct CloseInput {
    void operator()(AVFormatContext* context) const { libav().avformat_close_input(&context); }
};
using Input = std::unique_ptr<AVFormatContext, CloseInput>;

Input open_film(const std::string& path) {
    AVFormatContext* context = nullptr;
    EXPECT_EQ(libav().avformat_open_input(&context, libav_url(path).c_str(), nullptr, nullptr), 0)
        << path;
    Input input(context);
    if (input) {
        EXPECT_GE(libav().avformat_find_stream_info(context, nullptr), 0);
    }
    return input;
}

/// Presentation times of all packets, sorted, in the stream's time base.
std::vector<std::int64_t> packet_times(AVFormatContext& input) {
    std::vector<std::int64_t> times;
    const PacketPtr packet(libav().av_packet_alloc());
    while (libav().av_read_frame(&input, packet.get()) >= 0) {
        times.push_back(packet->pts);
        libav().av_packet_unref(packet.get());
    }
    std::sort(times.begin(), times.end());
    return times;
}

/// The names of the boxes at the top of an MP4 file, in order.
Names top_boxes(const std::string& bytes) {
    Names boxes;
    std::size_t at = 0;
    while (at + 8 <= bytes.size()) {
        std::uint64_t size = 0;
        for (std::size_t i = 0; i < 4; ++i)
            size = size << 8 | static_cast<unsigned char>(bytes[at + i]);
        boxes.push_back(bytes.substr(at + 4, 4));
        if (size < 8) break;  // to the end, or 64 bits: not in a small film
        at += size;
    }
    EXPECT_EQ(at, bytes.size());
    return boxes;
}

TEST_F(FilmTest, HoldsWhatPlayersNeed) {
    for (const std::string name : {"a.mp4", "a.mkv"}) {
        FilmOptions options = small_film();
        options.title = "Küche & <Ball>";
        const Input input = open_film(make_film(name, options, 30));
        ASSERT_TRUE(input);
        ASSERT_EQ(input->nb_streams, 1U);
        const AVCodecParameters& stream = *input->streams[0]->codecpar;
        EXPECT_EQ(stream.codec_id, AV_CODEC_ID_H264);
        EXPECT_EQ(stream.profile, FF_PROFILE_H264_HIGH);
        EXPECT_EQ(stream.format, AV_PIX_FMT_YUV420P);
        EXPECT_EQ(stream.width, 160);
        EXPECT_EQ(stream.height, 90);
        EXPECT_EQ(stream.color_space, AVCOL_SPC_BT709);
        EXPECT_EQ(stream.color_primaries, AVCOL_PRI_BT709);
        EXPECT_EQ(stream.color_trc, AVCOL_TRC_BT709);
        EXPECT_EQ(stream.color_range, AVCOL_RANGE_MPEG);
        EXPECT_EQ(stream.chroma_location, AVCHROMA_LOC_LEFT);
        const AVDictionaryEntry* title = libav().av_dict_get(input->metadata, "title", nullptr, 0);
        ASSERT_NE(title, nullptr);
        EXPECT_EQ(title->value, options.title);
    }
}

// Frame k stands at k / fps, and the film lasts frames / fps, both exactly.
TEST_F(FilmTest, Mp4TimesAreExact) {
    constexpr int kFrames = 47;
    for (const AVRational rate : {AVRational{60, 1}, AVRational{30000, 1001}, AVRational{25, 1},
                                  AVRational{24000, 1001}, AVRational{1, 2}, AVRational{1000, 7}}) {
        const int numerator = rate.num, denominator = rate.den;
        const Input input =
            open_film(make_film("a.mp4", small_film(numerator, denominator), kFrames));
        ASSERT_TRUE(input);
        const AVStream& stream = *input->streams[0];
        const auto ticks_of = [&](std::int64_t frame) {  // of the stream's time base, times num
            return frame * denominator * stream.time_base.den;
        };
        const std::int64_t unit = std::int64_t{numerator} * stream.time_base.num;
        EXPECT_EQ(av_cmp_q(stream.avg_frame_rate, {numerator, denominator}), 0) << numerator;
        EXPECT_EQ(stream.duration * unit, ticks_of(kFrames)) << numerator;
        EXPECT_EQ(stream.nb_frames, kFrames);
        const std::vector<std::int64_t> times = packet_times(*input);
        ASSERT_EQ(times.size(), static_cast<std::size_t>(kFrames));
        for (std::size_t k = 0; k < times.size(); ++k)
            EXPECT_EQ(times[k] * unit, ticks_of(static_cast<std::int64_t>(k))) << numerator;
    }
}

// Matroska's times are whole milliseconds: off by half of one at most, never drifting.
TEST_F(FilmTest, MatroskaTimesAreRoundedOnce) {
    const Input input = open_film(make_film("a.mkv", small_film(30000, 1001), 90));
    ASSERT_TRUE(input);
    const std::vector<std::int64_t> times = packet_times(*input);
    ASSERT_EQ(times.size(), 90U);
    for (std::size_t k = 0; k < times.size(); ++k)
        EXPECT_NEAR(static_cast<double>(times[k]), 1001.0 / 30 * static_cast<double>(k), 0.501);
    EXPECT_EQ(av_cmp_q(input->streams[0]->avg_frame_rate, {30000, 1001}), 0);
}

TEST_F(FilmTest, TheIndexStandsBeforeThePictures) {
    const Names boxes = top_boxes(bytes_of(make_film("a.mp4", small_film(), 30)));
    const auto moov = std::find(boxes.begin(), boxes.end(), "moov");
    const auto mdat = std::find(boxes.begin(), boxes.end(), "mdat");
    ASSERT_NE(moov, boxes.end());
    ASSERT_NE(mdat, boxes.end());
    EXPECT_LT(moov, mdat);
}

TEST_F(FilmTest, HasAKeyframeEverySecond) {
    const Input input = open_film(make_film("a.mp4", small_film(30), 95));
    ASSERT_TRUE(input);
    const PacketPtr packet(libav().av_packet_alloc());
    int keyframes = 0;
    while (libav().av_read_frame(input.get(), packet.get()) >= 0) {
        if ((packet->flags & AV_PKT_FLAG_KEY) != 0) ++keyframes;
        libav().av_packet_unref(packet.get());
    }
    EXPECT_GE(keyframes, 4);
    EXPECT_LE(keyframes, 8);
}

TEST_F(FilmTest, OneFrameIsAFilm) {
    const std::string path = make_film("a.mp4", small_film(), 1);
    FilmReader reader(path);
    Image frame;
    EXPECT_TRUE(reader.next(frame));
    EXPECT_FALSE(reader.next(frame));
    EXPECT_FALSE(reader.next(frame));
    EXPECT_EQ(open_film(path)->streams[0]->nb_frames, 1);
}

/// Fills all memory that malloc gives with a byte, so that reading what was never written shows.
class FilledMemory {
  public:
    explicit FilledMemory(int byte) { mallopt(M_PERTURB, byte); }
    ~FilledMemory() { mallopt(M_PERTURB, 0); }
    FilledMemory(const FilledMemory&) = delete;
    FilledMemory& operator=(const FilledMemory&) = delete;
};

TEST_F(FilmTest, RunsGiveTheSameBytesWhateverTheMemoryHeld) {
    for (const std::string extension : {".mp4", ".mkv"})
        for (const auto& [width, height] : {std::pair{160, 90}, {192, 208}, {320, 180}}) {
            FilmOptions options = small_film();
            options.width_px = width;
            options.height_px = height;
            options.title = "again";
            std::string first;
            for (const int byte : {0, 1, 85, 170, 254}) {
                const FilledMemory filled(byte);
                const std::string film = bytes_of(make_film("a" + extension, options, 40));
                if (first.empty()) first = film;
                EXPECT_GT(film.size(), 1000U);
                EXPECT_TRUE(film == first) << extension << " " << width << " " << byte;
            }
        }
}

TEST_F(FilmTest, AppearsOnlyWhenFinished) {
    const std::string path = in_folder("a.mp4");
    const auto sink = make_film_writer(path, small_film());
    for (int k = 0; k < 20; ++k) {
        sink->write(k, moving_picture(160, 90, k));
        EXPECT_FALSE(std::filesystem::exists(path));
    }
    EXPECT_EQ(names().size(), 1U);
    sink->finish();
    EXPECT_EQ(names(), Names{"a.mp4"});
    const SinkTimes times = sink->times();
    EXPECT_GT(times.convert_cpu_s, 0);
    EXPECT_GT(times.encode_cpu_s, 0);
    EXPECT_GT(times.write_cpu_s, 0);
}

TEST_F(FilmTest, LeavesNothingWhenGivenUp) {
    auto sink = make_film_writer(in_folder("a.mp4"), small_film());
    for (int k = 0; k < 20; ++k) sink->write(k, moving_picture(160, 90, k));
    EXPECT_EQ(names().size(), 1U);
    sink.reset();
    EXPECT_EQ(names(), Names{});
}

TEST_F(FilmTest, KeepsThePlayablePart) {
    for (const std::string extension : {".mp4", ".mkv"}) {
        const std::string path = in_folder("film" + extension);
        std::ofstream(path) << "old";
        auto sink = make_film_writer(path, small_film());
        for (int k = 0; k < 25; ++k) sink->write(k, moving_picture(160, 90, k));
        const std::string kept = sink->keep_partial();
        sink.reset();
        EXPECT_EQ(kept, in_folder("film.partial" + extension));
        EXPECT_EQ(names(), (Names{"film" + extension, "film.partial" + extension}));
        EXPECT_EQ(bytes_of(path), "old");
        FilmReader reader(kept);
        Image frame;
        int frames = 0;
        while (reader.next(frame)) ++frames;
        EXPECT_EQ(frames, 25);
        std::filesystem::remove(path);
        std::filesystem::remove(kept);
    }
}

TEST_F(FilmTest, NothingIsKeptOfNothing) {
    auto sink = make_film_writer(in_folder("a.mp4"), small_film());
    EXPECT_EQ(sink->keep_partial(), "");
    sink.reset();
    EXPECT_EQ(names(), Names{});
}

TEST_F(FilmTest, AFullDiskIsAFailureThatLeavesNothing) {
    for (const std::string extension : {".mp4", ".mkv"}) {
        const std::string path = in_folder("a" + extension);
        for (const rlim_t room : {0UL, 1000UL, 100000UL}) {
            const FullDisk full(room);
            testing::internal::CaptureStderr();
            const std::string text = failure_text(FailureKind::kOutput, [&] {
                const auto sink = make_film_writer(path, small_film());
                for (int k = 0; k < 60; ++k)
                    sink->write(k, noise_image(160, 90, static_cast<unsigned>(k)));
                sink->finish();
            });
            EXPECT_TRUE(contains(text, "cannot write '" + path + "': File too large")) << text;
            EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
            EXPECT_EQ(names(), Names{});
        }
    }
}

TEST_F(FilmTest, AFolderThatIsMissingIsAFailure) {
    const std::string path = in_folder("missing/a.mp4");
    const std::string text =
        failure_text(FailureKind::kOutput, [&] { make_film_writer(path, small_film()); });
    EXPECT_TRUE(contains(text, path + "': No such file or directory")) << text;
}

TEST_F(FilmTest, RefusesOptionsThatCannotBe) {
    const auto refused = [&](const std::string& name, const FilmOptions& options) {
        const std::string text =
            failure_text(FailureKind::kInput, [&] { make_film_writer(in_folder(name), options); });
        EXPECT_EQ(names(), Names{});
        return text;
    };
    FilmOptions preset = small_film();
    preset.preset = "veryfats";
    EXPECT_TRUE(contains(refused("a.mp4", preset), "did you mean 'veryfast'"));
    preset.preset = "";
    EXPECT_TRUE(contains(refused("a.mp4", preset), "H.264 has ultrafast, superfast"));
    FilmOptions crf = small_film();
    crf.crf = 52;
    EXPECT_TRUE(contains(refused("a.mp4", crf), "crf 52"));
    crf.crf = -1;
    EXPECT_TRUE(contains(refused("a.mp4", crf), "crf -1"));
    crf.crf = 0;
    EXPECT_TRUE(contains(refused("a.mp4", crf), "lossless"));
    FilmOptions odd = small_film();
    odd.height_px = 91;
    EXPECT_TRUE(contains(refused("a.mp4", odd), "160x91"));
    EXPECT_TRUE(contains(refused("a.mp4", small_film(0, 1)), "0/1 frames a second"));
    EXPECT_TRUE(contains(refused("a.mp4", small_film(25, -1)), "25/-1"));
    EXPECT_TRUE(contains(refused("a.avi", small_film()), ".mp4, .mkv, .mov"));
    EXPECT_TRUE(contains(refused("film", small_film()), ".y4m or .raw"));
}

TEST_F(FilmTest, EveryPresetAndBothEndsOfCrfGiveHighProfile) {
    for (const char* preset : {"ultrafast", "superfast", "veryfast", "faster", "medium", "slow"})
        for (const int crf : {1, 51}) {
            FilmOptions options = small_film();
            options.preset = preset;
            options.crf = crf;
            const Input input = open_film(make_film("A.MP4", options, 20));
            ASSERT_TRUE(input);
            EXPECT_EQ(input->streams[0]->codecpar->profile, FF_PROFILE_H264_HIGH) << preset << crf;
            EXPECT_EQ(packet_times(*input).size(), 20U);
        }
}

TEST_F(FilmTest, AnyNameThatTheDiskTakes) {
    for (const std::string name : {"a:b.mp4", "50%d.mp4", "ä ö.mkv", "-.mp4", "http:x.mkv"}) {
        FilmReader reader(make_film(name, small_film(), 3));
        Image frame;
        EXPECT_TRUE(reader.next(frame)) << name;
        EXPECT_EQ(names(), Names{name});
        std::filesystem::remove(in_folder(name));
    }
}

TEST_F(FilmTest, AFrameOfAnotherSizeIsABug) {
    const auto sink = make_film_writer(in_folder("a.mp4"), small_film());
    EXPECT_THROW(sink->write(0, Image(160, 92)), Bug);
    EXPECT_THROW(sink->write(0, Image()), Bug);
}

}  // namespace
}  // namespace carom
