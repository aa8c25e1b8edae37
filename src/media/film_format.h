// The kinds of films that can be written: one row each, from which names, help, messages and sinks
// follow.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace carom {

/// How a container counts time.
enum class FilmTimes {
    kExact,         ///< ticks of which a whole number makes a frame (MP4 and its kin)
    kMilliseconds,  ///< rounded to those; the frame rate stands beside them
};

struct FilmFormat {
    std::string_view extension;  ///< without its dot; also what --format calls it
    std::string_view title;      ///< for people: "Matroska"
    const char* codec;           ///< FFmpeg's encoder
    const char* container;       ///< FFmpeg's muxer
    bool alpha;                  ///< keeps transparency
    FilmTimes times;
    bool streams;  ///< goes out as it is made; else only whole, for its index stands first
};

std::span<const FilmFormat> film_formats();

/// By the extension of a path, in either case; null if no film is called so.
const FilmFormat* find_film_format(const std::string& path);

/// The same; Failure(kInput) that names those that there are.
const FilmFormat& film_format(const std::string& path);

/// ".mp4 or .mkv": what the name of a film may end in.
std::string film_extensions();

/// Refuses a frame rate at which several frames would have one time: Failure(kInput).
void require_time_stamps(const FilmFormat& format, const std::string& path, double frames_per_s);

}  // namespace carom
