// Versions of the libraries that this folder names.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "media/film_codec.h"

namespace carom {

/// Of a library that cannot be loaded, "none: " and why.
std::map<std::string, std::string> media_versions();

struct FoundCodec {
    const FilmCodec* codec;
    bool found;  ///< this FFmpeg has its encoder
};
/// All of film_codecs(); none where FFmpeg cannot be loaded.
std::vector<FoundCodec> found_codecs();

}  // namespace carom
