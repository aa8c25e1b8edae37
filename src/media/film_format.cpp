#include "media/film_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "core/failure.h"

namespace carom {

namespace {

using T = FilmTimes;
using S = FilmStreaming;

// Frames/s: Matroska has one millisecond each. Browsers show what stands for less than 20 ms (GIF)
// or up to 10 ms (WebP) for 100 ms.
constexpr int kNoLimit = 1'000'000'000, kOneMillisecondEach = 1000, kWebp = 90, kGif = 50;

constexpr std::array kFormats = {
    FilmFormat{
        "mp4", "MP4", "mp4", {"h264", "h265", "av1"}, T::kExact, kNoLimit, S::kFragments, &kAac},
    FilmFormat{"mkv",
               "Matroska",
               "matroska",
               {"h264", "h265", "ffv1", "vp9", "av1"},
               T::kMilliseconds,
               kOneMillisecondEach,
               S::kAsMade,
               &kOpus},
    FilmFormat{"mov",
               "QuickTime",
               "mov",
               {"prores", "h264", "h265"},
               T::kExact,
               kNoLimit,
               S::kFragments,
               &kAac},
    FilmFormat{"webm",
               "WebM",
               "webm",
               {"vp9", "av1"},
               T::kMilliseconds,
               kOneMillisecondEach,
               S::kAsMade,
               &kOpus},
    FilmFormat{"gif", "GIF", "gif", {"gif"}, T::kHundredths, kGif, S::kAtTheEnd, nullptr},
    FilmFormat{"apng", "APNG", "apng", {"apng"}, T::kFraction, kNoLimit, S::kAtTheEnd, nullptr},
    FilmFormat{"webp", "WebP", nullptr, {"webp"}, T::kMilliseconds, kWebp, S::kAtTheEnd, nullptr},
    FilmFormat{
        "y4m", "YUV4MPEG2", "yuv4mpegpipe", {"y4m"}, T::kRate, kNoLimit, S::kAsMade, nullptr},
    FilmFormat{"raw", "raw video", "rawvideo", {"raw"}, T::kRate, kNoLimit, S::kAsMade, nullptr},
};

constexpr int kMost16Bits = 65535;

template <class Wanted>
std::string extensions(const Wanted& wanted) {
    std::vector<std::string> names;
    for (const FilmFormat& format : kFormats)
        if (wanted(format)) names.push_back(fmt::format(".{}", format.extension));
    std::string text;
    for (const std::string& name : names) {
        const bool last = &name == &names.back();
        text += (text.empty() ? "" : last ? " or " : ", ") + name;
    }
    return text;
}

}  // namespace

std::span<const std::string_view> FilmFormat::codec_names() const {
    const auto end = std::find(codecs.begin(), codecs.end(), std::string_view());
    return {codecs.data(), static_cast<std::size_t>(end - codecs.begin())};
}

bool FilmFormat::has_alpha() const {
    const auto names = codec_names();
    return std::any_of(names.begin(), names.end(),
                       [](std::string_view name) { return find_film_codec(name)->has_alpha(); });
}

std::span<const FilmFormat> film_formats() { return kFormats; }

const FilmFormat* find_film_format(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto found =
        std::find_if(kFormats.begin(), kFormats.end(), [&](const FilmFormat& format) {
            return extension == fmt::format(".{}", format.extension);
        });
    return found == kFormats.end() ? nullptr : &*found;
}

const FilmFormat& film_format(const std::string& path) {
    const FilmFormat* format = find_film_format(path);
    if (format != nullptr) return *format;
    throw Failure(FailureKind::kInput, fmt::format("cannot write a film '{}': its name must end in "
                                                   "{}",
                                                   path, film_extensions()));
}

std::string film_extensions(bool alpha) {
    return extensions([alpha](const FilmFormat& format) { return !alpha || format.has_alpha(); });
}

std::string sound_film_extensions() {
    return extensions([](const FilmFormat& format) { return format.sound != nullptr; });
}

void require_time_stamps(const FilmFormat& format, const std::string& path, int fps_numerator,
                         int fps_denominator) {
    const double fps = static_cast<double>(fps_numerator) / fps_denominator;
    const auto refuse = [&](const std::string& why) {
        throw Failure(FailureKind::kInput, fmt::format("'{}': {}", path, why));
    };
    if (format.times == FilmTimes::kFraction &&
        (fps_numerator > kMost16Bits || fps_denominator > kMost16Bits))
        refuse(
            fmt::format("{} keeps a frame's duration as a fraction of two numbers up to {}, "
                        "which {}/{} s is not; choose another film.fps (--fps)",
                        format.title, kMost16Bits, fps_denominator, fps_numerator));
    if (fps <= format.most_per_s) return;
    const char* counts =
        format.times == FilmTimes::kHundredths ? "hundredths of a second" : "milliseconds";
    const char* then = format.most_per_s == kOneMillisecondEach
                           ? "several frames would have one time"
                           : "players would show each frame for a tenth of a second";
    refuse(
        fmt::format("{} counts {}, and at {:.6g} frames/s {}; take at most {} (--fps {}), or "
                    "write an .mp4",
                    format.title, counts, fps, then, format.most_per_s, format.most_per_s));
}

}  // namespace carom
