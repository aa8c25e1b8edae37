// The tables of films: what belongs together, and what a name means.
#include "media/film_format.h"

#include <algorithm>
#include <set>

#include "media/film_choice.h"
#include "media/video_encoder.h"
#include "media_fixture.h"

namespace carom {
namespace {

TEST(FilmFormats, EveryCodecOfAContainerIsInTheTable) {
    std::set<std::string_view> used;
    for (const FilmFormat& format : film_formats()) {
        ASSERT_FALSE(format.codec_names().empty()) << format.extension;
        for (const std::string_view name : format.codec_names()) {
            ASSERT_NE(find_film_codec(name), nullptr) << name;
            used.insert(name);
        }
    }
    EXPECT_EQ(used.size(), film_codecs().size()) << "a codec that nothing is written with";
}

TEST(FilmFormats, StepsOfQualityAreWithinTheCodec) {
    for (const FilmCodec& codec : film_codecs()) {
        ASSERT_FALSE(codec.pixels.empty());
        if (codec.qualities.empty()) {
            EXPECT_FALSE(codec.has_crf()) << codec.name;
            continue;
        }
        ASSERT_EQ(codec.qualities.size(), quality_names().size()) << codec.name;
        for (const QualityStep& step : codec.qualities) {
            if (codec.has_crf()) {
                EXPECT_GE(step.level, codec.least_crf) << codec.name;
                EXPECT_LE(step.level, codec.most_crf) << codec.name;
            }
            const bool known = std::find(codec.presets.begin(), codec.presets.end(), step.preset) !=
                               codec.presets.end();
            EXPECT_EQ(known, !codec.presets.empty()) << codec.name;
        }
    }
}

TEST(FilmFormats, NamesInEitherCase) {
    ASSERT_NE(find_film_format("a/b.WebM"), nullptr);
    EXPECT_EQ(find_film_format("a/b.WebM")->title, "WebM");
    EXPECT_EQ(find_film_format("a.mp4/b"), nullptr);
    EXPECT_EQ(find_film_format("mp4"), nullptr);
}

TEST(FilmFormats, TransparencyChoosesCodecAndPixels) {
    FilmOptions options;
    EXPECT_EQ(choose_film("a.mkv", options).codec->name, "h264");
    EXPECT_EQ(choose_film("a.webm", options).pixels, PixelFormat::kYuv420);
    options.transparent = true;
    EXPECT_EQ(choose_film("a.mkv", options).codec->name, "ffv1");
    EXPECT_EQ(choose_film("a.mkv", options).pixels, PixelFormat::kBgra);
    EXPECT_EQ(choose_film("a.webm", options).pixels, PixelFormat::kYuva420);
    EXPECT_EQ(choose_film("a.mov", options).pixels, PixelFormat::kYuva444Ten);
    for (const FilmFormat& format : film_formats()) {
        const std::string path = "a." + std::string(format.extension);
        options.fps_numerator = 25;
        if (format.has_alpha()) {
            EXPECT_TRUE(pixel_format_info(choose_film(path, options).pixels).alpha) << path;
        } else {
            EXPECT_THROW(choose_film(path, options), Failure) << path;
        }
    }
}

TEST(FilmFormats, OddSizesWhereChromaIsWhole) {
    FilmOptions options;
    options.width_px = 161;
    options.height_px = 91;
    options.fps_numerator = 25;
    EXPECT_THROW(choose_film("a.mp4", options), Failure);
    EXPECT_THROW(choose_film("a.webm", options), Failure);
    for (const char* path : {"a.gif", "a.apng", "a.webp", "a.mov", "a.raw"})
        EXPECT_NO_THROW(choose_film(path, options)) << path;
}

TEST(FilmFormats, RatesAtTheLimit) {
    FilmOptions options;
    const auto holds = [&](const char* path, int numerator, int denominator) {
        options.fps_numerator = numerator;
        options.fps_denominator = denominator;
        try {
            choose_film(path, options);
        } catch (const Failure&) {
            return false;
        }
        return true;
    };
    EXPECT_TRUE(holds("a.gif", 50, 1));
    EXPECT_FALSE(holds("a.gif", 51, 1));
    EXPECT_TRUE(holds("a.webp", 90, 1));
    EXPECT_FALSE(holds("a.webp", 91, 1));
    EXPECT_TRUE(holds("a.mkv", 1000, 1));
    EXPECT_FALSE(holds("a.mkv", 1001, 1));
    EXPECT_TRUE(holds("a.apng", 65535, 1));
    EXPECT_FALSE(holds("a.apng", 65536, 1));
    EXPECT_TRUE(holds("a.mp4", 90000, 1));
}

TEST(FilmFormats, AnEncoderThatIsMissingIsNamed) {
    FilmCodec codec = *find_film_codec("vp9");
    codec.encoder = "libvpx-vp10";
    const std::string text =
        failure_text(FailureKind::kRun, [&] { find_encoder("a.webm", codec); });
    EXPECT_EQ(text, "cannot encode 'a.webm': this FFmpeg has no libvpx-vp10, which encodes VP9");
}

TEST(FilmFormats, BytesOfAPixelWithoutCompression) {
    FilmOptions options;
    const auto bytes = [&](const char* path, const char* pixels) {
        options.pixels = pixels;
        return film_bytes_per_pixel(choose_film(path, options));
    };
    EXPECT_EQ(bytes("a.y4m", "yuv420p"), 1.5);
    EXPECT_EQ(bytes("a.y4m", "yuv444p10le"), 6);
    EXPECT_EQ(bytes("a.raw", "rgb24"), 3);
    EXPECT_EQ(bytes("a.raw", "bgra"), 4);
}

}  // namespace
}  // namespace carom
