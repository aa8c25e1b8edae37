// The sound of a film, or of a part of it, on its way into the container. Only .cpp files of this
// folder include it.
#pragma once

#include <cstdint>
#include <string>

#include "media/film_muxer.h"
#include "media/frame_sink.h"
#include "media/sound_encoder.h"

namespace carom {

inline constexpr int kSoundRate = 48'000;  ///< samples a second of all sound in films

/// The sample at which frame k of a film begins, to the nearest.
std::int64_t sample_of_frame(std::int64_t frame, AVRational frame_s);

/// Which packets of a film's sound a part of it holds: so that parts can be joined, a part has the
/// packets of the whole sound and no others. It begins some earlier than is heard, for the decoder.
struct SoundCut {
    std::int64_t first_packet = 0;
    std::int64_t end_packet = 0;  ///< one beyond the last
    std::int64_t skip = 0;  ///< samples that are decoded before the part begins, and not heard
};

/// Of samples first ... end - 1 of the whole.
SoundCut cut_sound(const SoundCodec& codec, std::int64_t first, std::int64_t end);

/// Says in the codec's parameters that `skip` samples are not heard.
void set_skip(AVCodecParameters& parameters, std::int64_t skip);

/// Gives a container the packets of a sound, in step with the pictures.
class SoundTrack {
  public:
    /// Encodes at once; the samples are not needed afterwards. Throws Failure(kRun).
    SoundTrack(const std::string& path, const SoundCodec& codec, const FilmOptions& options);

    ParametersPtr parameters() const;
    /// What is over at this time of the film [s], which is not beyond its end.
    void write_until(double s, FilmMuxer& muxer);
    /// The rest of a film of so many frames.
    void write_rest(std::int64_t frames, FilmMuxer& muxer);
    double encode_cpu_s() const { return encode_cpu_s_; }

  private:
    void write_before(std::int64_t sample, bool is_end, FilmMuxer& muxer);

    const SoundCodec& codec_;
    AVRational frame_s_;
    EncodedSound sound_;
    std::int64_t first_frame_;
    std::int64_t first_sample_;
    std::int64_t next_packet_ = 0;
    double encode_cpu_s_ = 0;
};

}  // namespace carom
