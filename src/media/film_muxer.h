// The container of a film. Only .cpp files of this folder include it.
#pragma once

#include <memory>
#include <string>

#include "media/libav.h"

namespace carom {

enum class FilmContainer { kMp4, kMatroska };

/// By the extension, in either case. Throws Failure(kInput) that names those that it knows.
FilmContainer film_container(const std::string& path);

/// One frame a millisecond: FFmpeg's Matroska has no finer time stamps.
inline constexpr int kMostMatroskaRate = 1000;

/// FFmpeg's name of an open descriptor.
std::string pipe_url(int descriptor);

/// Writes one stream of packets into a file.
///
/// MP4: moov first, and a time scale in which a frame's duration is a whole number, also for
/// 30000/1001. Matroska: FFmpeg rounds its times to milliseconds; the frame rate stands beside
/// them, and rates above kMostMatroskaRate are refused, where frames would share a time. Neither
/// holds a date or a version, so the bytes follow from the packets alone.
class FilmMuxer {
  public:
    /// Writes to `url` (libav_url() or pipe_url()); `path` is for messages. `title` may be empty.
    /// Throws Failure(kOutput).
    FilmMuxer(const std::string& url, const std::string& path, FilmContainer container,
              const AVCodecContext& encoder, const std::string& title);
    ~FilmMuxer();
    FilmMuxer(const FilmMuxer&) = delete;
    FilmMuxer& operator=(const FilmMuxer&) = delete;

    static bool wants_global_header(FilmContainer container);

    void write(AVPacket& packet);  ///< times in the encoder's time base; takes the packet's content
    void close();                  ///< the rest of the file; everything is written or it throws

  private:
    void write_header(FilmContainer container);
    void check(int result, const char* action, const LibavMessages& messages) const;

    struct CloseContext {
        void operator()(AVFormatContext* context) const;
    };
    std::string path_;
    std::unique_ptr<AVFormatContext, CloseContext> context_;
    AVRational encoder_time_base_;
};

}  // namespace carom
