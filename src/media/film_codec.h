// What films are coded with: one row each, from which --codec, its options and their messages
// follow. What FFmpeg's encoders are asked for is in encoder_settings.cpp.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "media/pixel_format.h"

namespace carom {

/// What --quality chooses.
struct QualityStep {
    int level;                ///< the codec's crf; of one without, a number of its own
    std::string_view preset;  ///< "" where the codec has none
};

/// For estimates: Figure 9 at 1920x1080, quality medium, on two cores.
struct CodecCost {
    double bytes_per_px;  ///< in the file; 0: nothing is compressed
    double ns_per_px;     ///< CPU time of converting and encoding
    int pictures;         ///< memory of the encoder, in pictures of four bytes a pixel
};

struct FilmCodec {
    std::string_view name;                ///< of --codec
    std::string_view title;               ///< for people: "H.264"
    const char* encoder;                  ///< FFmpeg's
    std::span<const PixelFormat> pixels;  ///< the first with or without alpha is the default
    int least_crf, most_crf;              ///< best and smallest; both 0 where --crf means nothing
    std::span<const std::string_view> presets;  ///< from fast to slow; empty where there are none
    std::span<const QualityStep> qualities;     ///< draft, medium, high; empty where there is none
    bool threads;                               ///< works on several
    CodecCost cost;

    bool has_crf() const { return most_crf > 0; }
    bool has_alpha() const;
};

std::span<const FilmCodec> film_codecs();

/// Null if none is called so.
const FilmCodec* find_film_codec(std::string_view name);

/// The place of "draft", "medium" and "high" in FilmCodec::qualities.
std::span<const std::string_view> quality_names();

}  // namespace carom
