// The container of a film. Only .cpp files of this folder include it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "media/film_format.h"
#include "media/libav.h"

namespace carom {

/// FFmpeg's name of an open descriptor.
std::string pipe_url(int descriptor);

/// What the packets are that a film is made of.
struct FilmStream {
    ParametersPtr parameters;
    AVRational time_base;       ///< of the packets: 1 / frame rate
    bool alpha_beside = false;  ///< packets carry their alpha beside them (vp9_alpha.h)
    ParametersPtr sound{};      ///< null: there is none
};

/// Writes a stream of pictures, and maybe one of sound, into a file.
///
/// With exact times (MP4): moov first, and a time scale in which a frame's duration is a whole
/// number, also for 30000/1001; into a pipe, fragments from keyframe to keyframe instead. No
/// container holds a date or FFmpeg's version, so the bytes follow from packets and texts alone.
class FilmMuxer {
  public:
    /// Writes to `url` (libav_url() or pipe_url()); `path` is for messages. `title` and `comment`
    /// may be empty. Throws Failure(kOutput).
    FilmMuxer(const std::string& url, const std::string& path, const FilmFormat& format,
              const FilmStream& film, const std::string& title, const std::string& comment);
    ~FilmMuxer();
    FilmMuxer(const FilmMuxer&) = delete;
    FilmMuxer& operator=(const FilmMuxer&) = delete;

    static bool wants_global_header(const FilmFormat& format);

    void write(AVPacket& packet);  ///< times in FilmStream::time_base; takes the packet's content
    /// The same of the sound, times in samples; in step with the pictures, so that few wait.
    void write_sound(AVPacket& packet);
    void close();  ///< the rest of the file; everything is written or it throws

  private:
    void set_text(const char* key, const std::string& text);
    void add_sound(const AVCodecParameters& parameters, const FilmFormat& format,
                   const LibavMessages& messages);
    void write_to(int stream, AVRational time_base, AVPacket& packet);
    void write_header(const FilmFormat& format, bool into_pipe);
    void check(int result, const char* action, const LibavMessages& messages) const;

    struct CloseContext {
        void operator()(AVFormatContext* context) const;
    };
    std::string path_;
    std::unique_ptr<AVFormatContext, CloseContext> context_;
    AVRational time_base_;
    std::int64_t sound_delay_ = 0;  ///< samples that the times of the sound in the file have more
};

}  // namespace carom
