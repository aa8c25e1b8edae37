// Animated WebP. Only .cpp files of this folder include it.
#pragma once

#include <memory>
#include <string>

#include "media/film_choice.h"
#include "media/frame_sink.h"

namespace carom {

/// A lossless film. FFmpeg's own muxer lays each frame over the last one, so that what was
/// transparent would never become so again, and libwebp's animation encoder drops frames that are
/// like the last; here each frame replaces the rectangle that has changed (WebP Container
/// Specification, "Animation": ANMF with blending method 1, disposal 0), and all are there. Times
/// are rounded to milliseconds once each. One frame is in memory, and the last one to compare.
std::unique_ptr<FrameSink> make_webp_film(const std::string& path, const FilmChoice& choice,
                                          const FilmOptions& options);

}  // namespace carom
