// The kinds of films that can be written: one row each, from which names, help, messages and sinks
// follow.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "media/film_codec.h"
#include "media/sound_codec.h"

namespace carom {

/// How a container counts time.
enum class FilmTimes {
    kExact,         ///< ticks of which a whole number makes a frame (MP4 and its kin)
    kFraction,      ///< each frame's duration as a fraction of two numbers of 16 bits
    kMilliseconds,  ///< rounded to those
    kHundredths,    ///< of a second, rounded to those
    kRate,          ///< no time stamps: the frame rate alone, or what the reader is told
};

/// How a film goes into a pipe.
enum class FilmStreaming {
    kAsMade,     ///< frame by frame, as into a file
    kFragments,  ///< in pieces of a second, each with an index of its own
    kAtTheEnd,   ///< whole, when all is known
};

struct FilmFormat {
    std::string_view extension;              ///< without its dot; also what --format calls it
    std::string_view title;                  ///< for people: "Matroska"
    const char* container;                   ///< FFmpeg's muxer; null: written by webp_film.cpp
    std::array<std::string_view, 5> codecs;  ///< FilmCodec::name; the first is the default
    FilmTimes times;
    int most_per_s;  ///< frames/s: with more some would have one time, or be shown too long
    FilmStreaming streaming;
    const SoundCodec* sound;  ///< how its sound is coded; null: it holds none

    /// Those of `codecs` that are not empty.
    std::span<const std::string_view> codec_names() const;
    /// True where one of the codecs keeps transparency.
    bool has_alpha() const;
};

std::span<const FilmFormat> film_formats();

/// By the extension of a path, in either case; null if no film is called so.
const FilmFormat* find_film_format(const std::string& path);

/// The same; Failure(kInput) that names those that there are.
const FilmFormat& film_format(const std::string& path);

/// ".mp4, .mkv or .webm": what the name of a film may end in; of those that keep transparency only,
/// where `alpha`.
std::string film_extensions(bool alpha = false);

/// The same of those that hold sound.
std::string sound_film_extensions();

/// Refuses a frame rate that the container has no time stamps for: Failure(kInput) that says which
/// it has.
void require_time_stamps(const FilmFormat& format, const std::string& path, int fps_numerator,
                         int fps_denominator);

}  // namespace carom
