// Title and comment in films whose muxer keeps none.
#pragma once

#include <string>

#include "media/film_format.h"

namespace carom {

/// A chunk of a PNG: tEXt, or iTXt where the text is not ASCII (PNG, third edition, 11.3.3).
std::string png_text_chunk(const std::string& keyword, const std::string& text);

/// Puts both behind the frames of a finished GIF (a comment extension) or APNG (text chunks);
/// empty texts are left out, other formats stay as they are. `name` is the film's for messages.
/// Throws Failure(kOutput).
void append_film_text(const std::string& path, const std::string& name, const FilmFormat& format,
                      const std::string& title, const std::string& comment);

}  // namespace carom
