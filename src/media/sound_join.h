// The sound of parts of a film into the film's. Only .cpp files of this folder include it.
#pragma once

#include <cstdint>
#include <string>

#include "media/film_muxer.h"
#include "media/film_part.h"
#include "media/sound_codec.h"

namespace carom {

/// The codec that a part names for its sound; null where it is silent. Failure(kInput) for one that
/// there is not.
const SoundCodec* sound_codec_of(const std::string& path, const FilmPart& part);

/// Parts in order, each with the packets of the whole sound that it holds (sound_track.h): every
/// packet is written once, so that the film has those that it would have had in one go.
class SoundJoin {
  public:
    explicit SoundJoin(const SoundCodec& codec) : codec_(codec) {}

    void begin(const FilmPart& part);
    /// The part's next packet; takes its content where it is written. `muxer` may be null, to count
    /// only.
    void take(AVPacket& packet, FilmMuxer* muxer);
    /// Failure(kInput) where the part has not the packets that belong to it.
    void end(const std::string& path) const;

  private:
    const SoundCodec& codec_;
    std::int64_t begin_ = 0, at_ = 0, end_ = 0;  ///< packets of the part, by their place in all
    std::int64_t next_ = 0;                      ///< to be written
    std::int64_t film_end_ = 0;                  ///< samples
};

}  // namespace carom
