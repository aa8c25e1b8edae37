// Pictures into packets, through one of FFmpeg's encoders. Only .cpp files of this folder include
// it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "media/film_choice.h"
#include "media/film_muxer.h"
#include "media/frame_converter.h"
#include "media/h264_still.h"
#include "media/libav.h"
#include "media/thread_clock.h"
#include "media/vp9_alpha.h"

namespace carom {

/// The codec's encoder; Failure(kRun) that names it where this FFmpeg lacks it.
const AVCodec& find_encoder(const std::string& path, const FilmCodec& codec);

/// Pictures in, packets out. pts counts frames from 0 in units of 1/fps.
class VideoEncoder {
  public:
    using TakePacket = std::function<void(AVPacket&)>;

    /// `path` is for messages. `global_header`: the container keeps the parameter sets itself.
    /// Throws Failure(kRun), e.g. when the encoder is missing.
    VideoEncoder(const std::string& path, const FilmChoice& choice, const FilmOptions& options,
                 bool global_header);

    /// Converts and encodes; `take` gets the packets that come out, maybe none. `changed`: since
    /// the picture before.
    void encode(const Image& image, const ChangedParts& changed, const TakePacket& take);
    /// Gives the rest of the packets; nothing may be encoded after it.
    void flush(const TakePacket& take);

    /// What its packets are, for a container; before the first picture.
    FilmStream stream() const;
    std::int64_t frames() const { return frames_; }
    double convert_cpu_s() const { return convert_cpu_s_; }
    /// The caller's time in the encoder, and that of the threads that the encoder started.
    double encode_cpu_s() const;

  private:
    int open(int threads);
    void open();
    void close();
    void send(const AVFrame* frame);
    void receive(const TakePacket& take);
    void give(const TakePacket& take);
    void fill_frame(const Image& image, const ChangedParts& changed);

    /// Of H.264, pictures that are as the one before need no encoder (media/h264_still.h): where
    /// they have come for a while it is closed, and opened again for one that differs.
    bool stands_still(const ChangedParts& changed);
    void begin_stillness(const TakePacket& take);
    void repeat(const TakePacket& take);
    void make_still_keyframe();
    void give_unit(const std::string& unit, bool key, const TakePacket& take);

    std::string path_;
    const AVCodec& codec_;
    const FilmChoice choice_;
    const FilmOptions options_;
    const bool global_header_;
    CodecPtr context_;
    FramePtr frame_;
    PacketPtr packet_;
    FrameConverter converter_;
    std::optional<Vp9Alpha> alpha_;
    std::int64_t frames_ = 0;
    std::int64_t packets_ = 0;
    std::optional<H264Still> still_;  ///< where pictures may be repeated
    std::int64_t equal_ = 0;          ///< frames in a row that were as the one before
    bool repeating_ = false;          ///< there is no encoder
    std::int64_t delay_ = 0;          ///< packets before the one that is shown first
    std::int64_t keyframe_ = 0;       ///< the last one
    std::string still_keyframe_;      ///< of what stands still; empty: not made yet
    double convert_cpu_s_ = 0;
    double caller_cpu_s_ = 0;
    ForeignThreads encoder_threads_;
};

}  // namespace carom
