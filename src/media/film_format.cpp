#include "media/film_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "core/failure.h"

namespace carom {

namespace {

constexpr std::array kFormats = {
    FilmFormat{"mp4", "MP4", "libx264", "mp4", false, FilmTimes::kExact, false},
    FilmFormat{"mkv", "Matroska", "libx264", "matroska", false, FilmTimes::kMilliseconds, true},
};

constexpr int kMostInMilliseconds = 1000;  // frames/s: one time each

}  // namespace

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

std::string film_extensions() {
    std::string text;
    for (const FilmFormat& format : kFormats) {
        const bool last = &format == &kFormats.back();
        text += text.empty() ? "." : last ? " or ." : ", .";
        text += format.extension;
    }
    return text;
}

void require_time_stamps(const FilmFormat& format, const std::string& path, double frames_per_s) {
    if (format.times != FilmTimes::kMilliseconds || frames_per_s <= kMostInMilliseconds) return;
    throw Failure(FailureKind::kInput,
                  fmt::format("'{}': {} counts milliseconds, and at {:.6g} frames/s "
                              "several frames would have one time; write an .mp4, or at most {} "
                              "frames/s",
                              path, format.title, frames_per_s, kMostInMilliseconds));
}

}  // namespace carom
