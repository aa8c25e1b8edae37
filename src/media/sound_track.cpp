#include "media/sound_track.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "media/thread_clock.h"

namespace carom {

std::int64_t sample_of_frame(std::int64_t frame, AVRational frame_s) {
    return libav().av_rescale_q(frame, frame_s, {1, kSoundRate});
}

SoundCut cut_sound(const SoundCodec& codec, std::int64_t first, std::int64_t end) {
    const std::int64_t size = codec.packet_samples, delay = codec.delay;
    SoundCut cut;
    cut.first_packet = std::max<std::int64_t>(0, (first + delay) / size - codec.preroll);
    cut.end_packet = (end + delay + size - 1) / size;
    cut.skip = first + delay - cut.first_packet * size;
    return cut;
}

void set_skip(AVCodecParameters& parameters, std::int64_t skip) {
    parameters.initial_padding = static_cast<int>(skip);
    if (parameters.codec_id != AV_CODEC_ID_OPUS) return;
    // "OpusHead", version, channels, then the pre-skip (RFC 7845, 5.1).
    constexpr int kPreSkip = 10;
    CAROM_CHECK(parameters.extradata_size, >, kPreSkip + 1);
    parameters.extradata[kPreSkip] = static_cast<std::uint8_t>(skip & 0xFF);
    parameters.extradata[kPreSkip + 1] = static_cast<std::uint8_t>(skip >> 8);
}

SoundTrack::SoundTrack(const std::string& path, const SoundCodec& codec, const FilmOptions& options)
    : codec_(codec),
      frame_s_{options.fps_denominator, options.fps_numerator},
      first_frame_(options.sound.first_frame),
      first_sample_(sample_of_frame(first_frame_, frame_s_)) {
    const double begin = calling_thread_cpu_s();
    CAROM_CHECK(std::lround(options.sound.samples->rate), ==, kSoundRate);
    sound_ = encode_sound(path, codec, *options.sound.samples);
    const SoundCut cut = cut_sound(codec, first_sample_, first_sample_ + 1);
    next_packet_ = cut.first_packet;
    set_skip(*sound_.parameters, cut.skip);
    encode_cpu_s_ = calling_thread_cpu_s() - begin;
}

ParametersPtr SoundTrack::parameters() const {
    ParametersPtr copy(allocated(libav().avcodec_parameters_alloc()));
    if (libav().avcodec_parameters_copy(copy.get(), sound_.parameters.get()) < 0)
        throw std::bad_alloc();
    return copy;
}

void SoundTrack::write_until(double s, FilmMuxer& muxer) {
    write_before(static_cast<std::int64_t>(s * kSoundRate), false, muxer);
}

void SoundTrack::write_rest(std::int64_t frames, FilmMuxer& muxer) {
    write_before(sample_of_frame(first_frame_ + frames, frame_s_) - first_sample_, true, muxer);
}

void SoundTrack::write_before(std::int64_t sample, bool is_end, FilmMuxer& muxer) {
    const auto packets = static_cast<std::int64_t>(sound_.packets.size());
    for (; next_packet_ < packets; ++next_packet_) {
        const std::int64_t begin =
            next_packet_ * codec_.packet_samples - codec_.delay - first_sample_;
        // What reaches beyond may be the last, whose length the film's end decides.
        if (begin >= sample || (!is_end && begin + codec_.packet_samples > sample)) return;
        AVPacket& packet = *sound_.packets[static_cast<std::size_t>(next_packet_)];
        packet.pts = packet.dts = begin;
        packet.duration = codec_.packet_samples;
        if (is_end) packet.duration = std::min(packet.duration, sample - begin);
        muxer.write_sound(packet);
    }
}

}  // namespace carom
