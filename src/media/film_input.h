// A film that is read. Only .cpp files of this folder include it.
#pragma once

#include <string>

#include "media/libav.h"

namespace carom {

/// An open container and its video stream.
class FilmInput {
  public:
    /// Throws Failure(kInput) where it cannot be opened or has no video.
    explicit FilmInput(std::string path);

    /// The stream's next packet, or `with_sound` the film's; false at the end. Throws
    /// Failure(kInput).
    bool read(AVPacket& packet, bool with_sound = false);
    bool is_sound(const AVPacket& packet) const { return packet.stream_index == sound_; }

    const std::string& path() const { return path_; }
    const AVFormatContext& context() const { return *context_; }
    const AVStream& stream() const { return *context_->streams[stream_]; }
    /// Null where there is none.
    const AVStream* sound() const { return sound_ < 0 ? nullptr : context_->streams[sound_]; }
    const AVCodec* decoder() const { return decoder_; }  ///< FFmpeg's own; may be null
    /// The text under this key of the film's, or the stream's, metadata; "" where there is none.
    std::string text(const char* key) const;
    std::string stream_text(const char* key) const;
    /// Failure(kInput) for a negative result of one of FFmpeg's functions.
    void check(int result, const LibavMessages& messages) const;

  private:
    struct Close {
        void operator()(AVFormatContext* context) const { libav().avformat_close_input(&context); }
    };
    std::string path_;
    std::unique_ptr<AVFormatContext, Close> context_;
    const AVCodec* decoder_ = nullptr;
    int stream_ = 0;
    int sound_ = -1;  ///< negative: none
};

}  // namespace carom
