// Where frames go: a film, a folder of PNGs, or several of them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/changed_parts.h"
#include "core/image.h"
#include "media/output_file.h"
#include "media/png.h"
#include "media/wav.h"

namespace carom {

/// CPU seconds by stage, summed over all threads that work for the sink, the encoder's own included
/// (found by their name, see media/thread_clock.h; without /proc they are missing).
struct SinkTimes {
    double convert_cpu_s = 0;
    double encode_cpu_s = 0;
    double write_cpu_s = 0;
};

class FrameSink {
  public:
    virtual ~FrameSink() = default;
    /// Frames arrive in order; `number` is absolute.
    virtual void write(std::int64_t number, const Image& frame) = 0;
    /// The same for a caller that knows what differs from the frame before: a sink that keeps what
    /// it has made of that one makes anew no more than this.
    virtual void write_changed(std::int64_t number, const Image& frame,
                               const ChangedParts& /*changed*/) {
        write(number, frame);
    }
    /// The same for a caller that needs the pixels no more: a sink that keeps frames for another
    /// thread swaps `frame` for a used one instead of copying it. Afterwards the frame has the same
    /// size, and its pixels mean nothing.
    virtual void write_swapped(std::int64_t number, Image& frame) { write(number, frame); }
    /// Makes the output appear under its name; must be called, so that closing can fail out loud.
    virtual void finish() = 0;
    /// After an interrupt: keeps what is playable (a film as its partial_path()), returns its path,
    /// or "" when nothing was worth keeping.
    virtual std::string keep_partial() = 0;
    virtual SinkTimes times() const = 0;
};

/// What is heard in a film; in the containers that hold sound (FilmFormat::sound).
struct FilmSound {
    bool wanted = false;                    ///< for require_film()
    const SoundSamples* samples = nullptr;  ///< of the film with all its frames, at 48 kHz; null
                                            ///< for silence; read while the sink is made
    std::int64_t first_frame = 0;           ///< of these, the one that is written first
};

/// How a film is coded. What is not given is as the kind of film has it; what is given and means
/// nothing to its codec is refused by name.
struct FilmOptions {
    int width_px = 1280;
    int height_px = 720;
    int fps_numerator = 60;
    int fps_denominator = 1;
    bool transparent = false;            ///< the frames' alpha is kept; else they lie over black
    std::string codec;                   ///< FilmCodec::name; empty: the first that will do
    std::string pixels;                  ///< PixelFormatInfo::name; empty: the codec's first
    std::optional<std::string> quality;  ///< draft | medium | high; none: medium
    std::optional<int> crf;              ///< none: as the quality says
    std::optional<std::string> preset;   ///< none: as the quality says
    int threads = 0;                     ///< of the encoder; 0: as many as there are processors
    std::string title;                   ///< metadata, empty for none
    std::string comment;                 ///< metadata, empty for none
    FilmSound sound{};
    Existing existing = Existing::kReplace;  ///< what stands under the film's name
};

/// A film of the kind that the extension of `path` names (media/film_format.h), of constant rate
/// with pts = frame index; Y'CbCr is converted and tagged as BT.709, H.264 of 4:2:0 and 8 bits has
/// the High profile. Throws Failure(kRun) that names the encoder when it is missing.
std::unique_ptr<FrameSink> make_film_writer(const std::string& path, const FilmOptions& options);

/// The same into an open pipe, as the frames come, for formats that stream: MP4 in fragments,
/// Matroska without a length in its header and without an index. `descriptor` stays open. Throws
/// ReaderGone when nobody reads any more.
std::unique_ptr<FrameSink> make_film_pipe(int descriptor, const std::string& extension,
                                          const FilmOptions& options);

/// Refuses what no film of this name can have, before any work: Failure(kInput) for a codec or an
/// option that this kind does not have, an odd size where chroma is halved, or a frame rate that
/// the container has no time stamps for; Failure(kRun) for an encoder that this FFmpeg lacks.
void require_film(const std::string& path, const FilmOptions& options);

/// What the PNG of a frame says besides its pixels; asked from several threads at once.
using FrameNotes = std::function<PngNotes(std::int64_t number)>;

/// One PNG per frame; `pattern` holds %05d (or %d, %0Nd), or names a folder, which is made if need
/// be and gets frame_%05d.png. "%%" stands for a percent sign. `threads` encode beside the caller
/// (0: one per processor, at most 8); each keeps three frames in memory. A frame appears under its
/// name only when whole; keep_partial() keeps all that are, and returns the folder.
/// Throws Failure(kInput) for a pattern that is none, Failure(kOutput) for a folder that cannot be
/// made.
std::unique_ptr<FrameSink> make_png_sequence(const std::string& pattern, int threads = 0,
                                             Existing existing = Existing::kReplace,
                                             FrameNotes notes = {});

/// The path of one frame of a PNG sequence. Throws Failure(kInput) as make_png_sequence() does.
std::string sequence_path(const std::string& pattern, std::int64_t number);

/// The folder of a sequence, "." for the current one; and the number of the frame that has this
/// name in it, none where no frame has. Both throw as make_png_sequence() does.
std::string sequence_folder(const std::string& pattern);
std::optional<std::int64_t> sequence_number(const std::string& pattern, const std::string& name);

}  // namespace carom
