// Films of which parts stand still: pictures that are as the one before need no encoder, and
// everything else is as in other films.
#include <algorithm>
#include <cmath>
#include <optional>

#include "media/film_input.h"
#include "media/film_reader.h"
#include "media/frame_sink.h"
#include "media/frame_workers.h"
#include "media/h264_still.h"
#include "media_fixture.h"

namespace carom {
namespace {

constexpr int kWidth = 160, kHeight = 90;

struct Packet {
    std::int64_t pts, dts;
    int size;
    bool key;
};

class StillFilmTest : public FolderTest {
  protected:
    /// A film that shows the moving picture of each number.
    std::string make_film(const std::string& name, FilmOptions options,
                          const std::vector<int>& shown) const {
        options.width_px = kWidth;
        options.height_px = kHeight;
        options.threads = 2;
        const std::string path = in_folder(name);
        const auto sink = make_film_writer(path, options);
        for (std::size_t k = 0; k < shown.size(); ++k)
            sink->write_changed(
                static_cast<std::int64_t>(k), moving_picture(kWidth, kHeight, shown[k]),
                k > 0 && shown[k] == shown[k - 1] ? ChangedParts::nothing() : ChangedParts{});
        sink->finish();
        return path;
    }

    static std::vector<Packet> packets_of(const std::string& path) {
        FilmInput input(path);
        std::vector<Packet> packets;
        const PacketPtr packet(libav().av_packet_alloc());
        while (input.read(*packet)) {
            packets.push_back(
                {packet->pts, packet->dts, packet->size, (packet->flags & AV_PKT_FLAG_KEY) != 0});
            libav().av_packet_unref(packet.get());
        }
        return packets;
    }

    /// Every frame is there, near the picture that it shows.
    static void expect_pictures(const std::string& path, const std::vector<int>& shown) {
        FilmReader reader(path);
        Image frame;
        std::size_t k = 0;
        for (; reader.next(frame); ++k) {
            ASSERT_LT(k, shown.size());
            const Image wanted = moving_picture(kWidth, kHeight, shown[k]);
            EXPECT_GT(compare_images(wanted, frame).psnr_luma_db, 36) << "frame " << k;
        }
        EXPECT_EQ(shown.size(), k);
    }
};

/// Moves, stands for three seconds, moves, stands shortly, moves, stands to the end.
std::vector<int> moving_and_standing() {
    std::vector<int> shown;
    const auto move = [&](int frames) {
        for (int i = 0; i < frames; ++i) shown.push_back(shown.empty() ? 0 : shown.back() + 1);
    };
    const auto stand = [&](int frames) {
        for (int i = 0; i < frames; ++i) shown.push_back(shown.back());
    };
    move(10);
    stand(180);
    move(7);
    stand(5);
    move(1);
    stand(30);
    move(20);
    stand(100);
    return shown;
}

TEST_F(StillFilmTest, ShowTheSamePicturesAtTheSameTimes) {
    const std::vector<int> shown = moving_and_standing();
    for (const char* preset : {"ultrafast", "veryfast", "medium"}) {
        for (const char* pixels : {"yuv420p", "yuv444p10le"}) {
            for (const char* name : {"film.mp4", "film.mkv", "film.mov"}) {
                const bool usual = std::string(preset) + pixels == "veryfastyuv420p";
                if (!usual && std::string(name) != "film.mp4") continue;
                SCOPED_TRACE(std::string(preset) + " " + pixels + " " + name);
                FilmOptions options;
                options.codec = "h264";
                options.preset = preset;
                options.pixels = pixels;
                const std::string path = make_film(name, options, shown);
                expect_pictures(path, shown);
                const std::vector<Packet> packets = packets_of(path);
                ASSERT_EQ(shown.size(), packets.size());
                std::vector<std::int64_t> times;
                for (const Packet& packet : packets) times.push_back(packet.pts);
                std::sort(times.begin(), times.end());
                EXPECT_EQ(times.end(), std::adjacent_find(times.begin(), times.end()));
                if (std::string(name) == "film.mkv") continue;  // has no other times
                for (std::size_t i = 1; i < packets.size(); ++i) {
                    EXPECT_GT(packets[i].dts, packets[i - 1].dts);
                    EXPECT_GE(packets[i].pts, packets[i].dts);
                }
            }
        }
    }
}

TEST_F(StillFilmTest, StandsInAFewBytesBetweenKeyframesOfEverySecond) {
    std::vector<int> shown(600, 3);
    FilmOptions options;
    const std::vector<Packet> packets = packets_of(make_film("film.mp4", options, shown));
    ASSERT_EQ(600u, packets.size());
    std::size_t last_key = 0, repeated = 0;
    for (std::size_t i = 0; i < packets.size(); ++i) {
        if (packets[i].key) last_key = i;
        EXPECT_LT(i - last_key, 60u);
        if (packets[i].size < 32) ++repeated;
    }
    EXPECT_GE(repeated, 560u);
    EXPECT_EQ(540u, last_key);
}

TEST_F(StillFilmTest, IsTheSameFilmEachTime) {
    const std::vector<int> shown = moving_and_standing();
    const std::string one = bytes_of(make_film("one.mp4", {}, shown));
    const std::string two = bytes_of(make_film("two.mp4", {}, shown));
    EXPECT_EQ(one, two);
    EXPECT_GT(one.size(), 1000u);
}

TEST_F(StillFilmTest, OfOtherCodecsIsAsGood) {
    std::vector<int> shown(40, 5);
    shown.push_back(6);
    for (const char* codec : {"ffv1", "vp9"}) {
        SCOPED_TRACE(codec);
        FilmOptions options;
        options.codec = codec;
        const std::string path = make_film("film.mkv", options, shown);
        FilmReader reader(path);
        Image frame;
        std::size_t k = 0;
        for (; reader.next(frame); ++k)
            EXPECT_GT(compare_images(moving_picture(kWidth, kHeight, shown[k]), frame).psnr_luma_db,
                      30);
        EXPECT_EQ(shown.size(), k);
    }
}

TEST(H264Still, RefusesWhatItDoesNotWrite) {
    const std::uint8_t nothing[] = {0, 0, 0, 1, 0x68, 0x80};
    EXPECT_FALSE(H264Still::read(nothing));
    // High profile, level 4, set 0, 4:2:0 of 8 bits, then scaling lists: 1 010 1 1 0 1...
    const std::uint8_t lists[] = {0, 0, 0, 1, 0x67, 100, 0, 40, 0b10101101, 0xFF, 0xFF};
    EXPECT_FALSE(H264Still::read(lists));
}

/// Of each frame a part differs from the one before; the places of the queue are behind by several.
TEST(FrameWorkers, CopiesOnlyWhatHasChangedSince) {
    constexpr int kFrames = 200;
    std::vector<Image> expected(kFrames), found(kFrames);
    std::vector<ChangedParts> changes(kFrames);
    Image picture = noise_image(32, 24, 1);
    FrameWorkers workers(
        3, 2, [&](int, std::int64_t number, const Image& frame, const ChangedParts& changed) {
            found[static_cast<std::size_t>(number)] = frame;
            changes[static_cast<std::size_t>(number)] = changed;
        });
    for (int k = 0; k < kFrames; ++k) {
        ChangedParts changed = ChangedParts::nothing();
        if (k == 0) {
            changed = {};
        } else if (k % 3 != 0) {
            const PixelRect part = PixelRect::at(k % 20, k % 17, 1 + k % 9, 1 + k % 5);
            for (int y = part.top; y < part.bottom; ++y)
                for (int x = 4 * part.left; x < 4 * part.right; ++x)
                    picture.row(y)[x] = static_cast<std::uint8_t>(k);
            changed = ChangedParts::only({part});
        }
        workers.push(k, picture, changed);
        expected[static_cast<std::size_t>(k)] = picture;
    }
    workers.drain();
    for (std::size_t k = 0; k < kFrames; ++k) {
        EXPECT_EQ(expected[k], found[k]) << k;
        EXPECT_EQ(k % 3 == 0 && k > 0, changes[k].is_nothing()) << k;
    }
}

}  // namespace
}  // namespace carom
