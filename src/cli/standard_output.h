// Data on standard output: text, PNG frames one after another, or a whole film.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/reader_gone.h"
#include "media/frame_sink.h"

namespace carom {

/// Throws ReaderGone on a closed pipe, Failure(kOutput) on any other error.
void write_standard_output(std::string_view bytes);

/// Frames as PNGs, one after another.
std::unique_ptr<FrameSink> make_png_stream(FrameNotes notes);

/// A film in `format`, the extension of a FilmFormat. What streams goes out as it is made. The rest
/// is made as a temporary file and copied at the end, for its head says what is known last.
std::unique_ptr<FrameSink> make_film_stream(const std::string& format, const FilmOptions& options,
                                            int waiting_frames);

}  // namespace carom
