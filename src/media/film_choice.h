// Which codec, pixels and settings a film gets.
#pragma once

#include <string>

#include "media/film_format.h"
#include "media/frame_sink.h"

namespace carom {

/// FilmOptions with everything decided.
struct FilmChoice {
    const FilmFormat* format;
    const FilmCodec* codec;
    PixelFormat pixels;
    int level;           ///< the crf, or of a codec without one the number of its QualityStep
    std::string preset;  ///< empty where the codec has none
};

/// Of a film called `path`. Throws Failure(kInput) for what it cannot have: an unknown name (with
/// the nearest one), an option that its codec does not take, a number out of range, an odd size
/// where chroma is halved, a frame rate beyond the container.
FilmChoice choose_film(const std::string& path, const FilmOptions& options);

/// Bytes of a pixel in the file: exact where nothing is compressed, else as FilmCodec has them.
double film_bytes_per_pixel(const FilmChoice& choice);

}  // namespace carom
