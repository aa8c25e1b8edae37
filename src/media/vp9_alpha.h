// Transparency of VP9 films. Only .cpp files of this folder include it.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "core/image.h"
#include "media/film_choice.h"
#include "media/libav.h"

namespace carom {

/// Encodes alpha as a second VP9 stream, whose packets travel beside those of the colours (WebM
/// Project, "VP8 Encode API and Alpha", 2012: BlockAdditional 1, its luma is alpha).
///
/// FFmpeg's own way, libvpx-vp9 with yuva420p, gives alpha the loss of the colours: off by 28 of
/// 255 at the edges of a ball. Here it has none.
class Vp9Alpha {
  public:
    /// Keyframes stand where those of `colours` stand. Throws Failure(kRun).
    Vp9Alpha(const std::string& path, const AVCodec& codec, const AVCodecContext& colours,
             const FilmChoice& choice);

    /// The next frame, before the colours are encoded: its packet is made at once.
    void encode(const Image& image);
    /// Gives the packet of colours its alpha, in order.
    void attach(AVPacket& colours);

  private:
    void check(int result, const char* action, const LibavMessages& messages) const;

    std::string path_;
    CodecPtr context_;
    FramePtr frame_;
    PacketPtr packet_;
    std::deque<std::string> waiting_;
    std::int64_t frames_ = 0;
};

}  // namespace carom
