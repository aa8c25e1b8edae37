// The film as pictures: colours and losses.
#include <cstdio>

#include "media/film_reader.h"
#include "media/frame_sink.h"
#include "media/libav.h"
#include "media_fixture.h"

namespace carom {
namespace {

class FilmPixelsTest : public FolderTest {
  protected:
    std::string film_of(const std::vector<Image>& frames, const std::string& name = "a.mp4") {
        FilmOptions options;
        options.width_px = frames.at(0).width_px;
        options.height_px = frames.at(0).height_px;
        options.threads = 2;
        const auto sink = make_film_writer(in_folder(name), options);
        for (std::size_t k = 0; k < frames.size(); ++k)
            sink->write(static_cast<std::int64_t>(k), frames[k]);
        sink->finish();
        return in_folder(name);
    }
};

/// The decoder's own samples, without a conversion: the mean of each plane of the first frame.
std::vector<double> plane_means(const std::string& path) {
    AVFormatContext* input = nullptr;
    EXPECT_EQ(libav().avformat_open_input(&input, libav_url(path).c_str(), nullptr, nullptr), 0);
    EXPECT_GE(libav().avformat_find_stream_info(input, nullptr), 0);
    const AVCodec* codec = libav().avcodec_find_decoder(input->streams[0]->codecpar->codec_id);
    const CodecPtr decoder(libav().avcodec_alloc_context3(codec));
    libav().avcodec_parameters_to_context(decoder.get(), input->streams[0]->codecpar);
    EXPECT_EQ(libav().avcodec_open2(decoder.get(), codec, nullptr), 0);
    const PacketPtr packet(libav().av_packet_alloc());
    const FramePtr frame(libav().av_frame_alloc());
    while (libav().av_read_frame(input, packet.get()) >= 0) {
        libav().avcodec_send_packet(decoder.get(), packet.get());
        libav().av_packet_unref(packet.get());
    }
    libav().avcodec_send_packet(decoder.get(), nullptr);
    EXPECT_EQ(libav().avcodec_receive_frame(decoder.get(), frame.get()), 0);
    libav().avformat_close_input(&input);

    std::vector<double> means;
    for (int plane = 0; plane < 3; ++plane) {
        const int width = plane == 0 ? frame->width : frame->width / 2;
        const int height = plane == 0 ? frame->height : frame->height / 2;
        double sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sum += frame->data[plane][y * frame->linesize[plane] + x];
        means.push_back(sum / width / height);
    }
    return means;
}

TEST_F(FilmPixelsTest, ColoursAreThoseOfBt709) {
    struct Colour {
        std::uint8_t b, g, r;
        double y, cb, cr;
    };
    for (const Colour& c :
         {Colour{0, 0, 255, 63, 102, 240}, Colour{0, 0, 0, 16, 128, 128},
          Colour{255, 255, 255, 235, 128, 128}, Colour{128, 128, 128, 126, 128, 128}}) {
        const std::string path =
            film_of(std::vector<Image>(8, filled_image(64, 64, c.b, c.g, c.r)));
        const std::vector<double> means = plane_means(path);
        std::printf("red %d green %d blue %d: %.2f %.2f %.2f (exact %.0f %.0f %.0f)\n", c.r, c.g,
                    c.b, means[0], means[1], means[2], c.y, c.cb, c.cr);
        EXPECT_NEAR(means[0], c.y, 1);
        EXPECT_NEAR(means[1], c.cb, 1);
        EXPECT_NEAR(means[2], c.cr, 1);
    }
}

TEST_F(FilmPixelsTest, TheReaderGivesTheColoursBack) {
    for (const std::string name : {"a.mp4", "a.mkv"})
        for (const Image& image :
             {filled_image(64, 48, 0, 0, 255), filled_image(64, 48, 200, 100, 50),
              filled_image(64, 48, 255, 255, 255), filled_image(64, 48, 0, 0, 0)}) {
            FilmReader reader(film_of(std::vector<Image>(4, image), name));
            Image frame;
            ASSERT_TRUE(reader.next(frame));
            EXPECT_LE(compare_images(frame, image).largest, 4);
        }
}

TEST_F(FilmPixelsTest, AMovingPictureKeeps38Decibels) {
    std::vector<Image> frames;
    for (int k = 0; k < 60; ++k) frames.push_back(moving_picture(320, 180, k));
    FilmReader reader(film_of(frames));
    Image frame;
    double worst = 1000;
    std::size_t k = 0;
    for (; reader.next(frame); ++k) {
        ASSERT_LT(k, frames.size());
        worst = std::min(worst, compare_images(frame, frames[k]).psnr_luma_db);
        // In order: the frame is nearer to its own source than to another.
        const std::size_t other = (k + 10) % frames.size();
        EXPECT_GT(compare_images(frame, frames[k]).psnr_luma_db,
                  compare_images(frame, frames[other]).psnr_luma_db + 3);
    }
    EXPECT_EQ(k, frames.size());
    std::printf("luma PSNR of the worst frame %.2f dB, bound 38\n", worst);
    EXPECT_GE(worst, 38);
    EXPECT_LT(worst, 100);
}

// A filter or a tag off by half a pixel would show: an edge of red and green has equal luma
// nearly everywhere, so what the reader gives back hangs on where the chroma lies.
TEST_F(FilmPixelsTest, ChromaComesBackWhereItWas) {
    Image image(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            std::uint8_t* pixel = image.row(y) + 4 * x;
            pixel[0] = 60;
            pixel[1] = static_cast<std::uint8_t>(200 - 2 * x);
            pixel[2] = static_cast<std::uint8_t>(60 + 2 * x);
            pixel[3] = 255;
        }
    FilmReader reader(film_of(std::vector<Image>(4, image)));
    Image frame;
    ASSERT_TRUE(reader.next(frame));
    double shift = 0;  // mean of red's difference over its slope of 2 a pixel
    for (int y = 8; y < 56; ++y)
        for (int x = 8; x < 56; ++x)
            shift += (frame.row(y)[4 * x + 2] - image.row(y)[4 * x + 2]) / 2.0;
    shift /= 48 * 48;
    std::printf("colour shifted by %.3f px, bound 0.2\n", shift);
    EXPECT_LT(std::abs(shift), 0.2);
}

TEST_F(FilmPixelsTest, SaysWhyAFilmCannotBeRead) {
    const auto reading = [](const std::string& path) {
        testing::internal::CaptureStderr();
        const std::string text = failure_text(FailureKind::kInput, [&] {
            FilmReader reader(path);
            Image frame;
            while (reader.next(frame)) continue;
        });
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
        EXPECT_TRUE(contains(text, path)) << text;
        return text;
    };
    EXPECT_TRUE(contains(reading(in_folder("missing.mp4")), "No such file"));
    std::ofstream(in_folder("text.mp4")) << "no film";
    EXPECT_TRUE(contains(reading(in_folder("text.mp4")), "Invalid data"));

    std::vector<Image> frames;
    for (unsigned k = 0; k < 10; ++k) frames.push_back(noise_image(64, 64, k));
    const std::string whole = bytes_of(film_of(frames));
    std::ofstream(in_folder("cut.mp4"), std::ios::binary) << whole.substr(0, whole.size() / 2);
    EXPECT_FALSE(reading(in_folder("cut.mp4")).empty());
}

}  // namespace
}  // namespace carom
