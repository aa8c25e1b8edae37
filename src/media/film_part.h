// What a film says that holds a part of the frames: so that the parts can be joined.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace carom {

/// Frames `first` to `last` of a film of `count` frames. Its text is a film's comment:
/// "ORIGIN, frames 0-149 of 600 at 60/1, h264 18 veryfast yuv420p".
struct FilmPart {
    std::string origin;  ///< carom's version and the scene's fingerprint, of all parts alike
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::int64_t count = 0;
    int fps_numerator = 60;
    int fps_denominator = 1;
    std::string settings;  ///< of the encoder, its codec first (FilmCodec::name); alike as well

    std::int64_t frames() const { return last - first + 1; }
    std::string text() const;
};

/// The part that a film's comment speaks of; none where it speaks of none.
std::optional<FilmPart> read_film_part(const std::string& comment);

}  // namespace carom
