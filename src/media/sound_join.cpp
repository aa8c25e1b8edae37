#include "media/sound_join.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/failure.h"
#include "media/sound_track.h"

namespace carom {

const SoundCodec* sound_codec_of(const std::string& path, const FilmPart& part) {
    constexpr std::string_view kBefore = ", sound ";
    const std::size_t at = part.settings.find(kBefore);
    if (at == std::string::npos) return nullptr;
    const std::size_t from = at + kBefore.size();
    const std::string name = part.settings.substr(from, part.settings.find(',', from) - from);
    for (const SoundCodec* codec : {&kAac, &kOpus})
        if (codec->name == name) return codec;
    throw Failure(FailureKind::kInput,
                  fmt::format("'{}' has its sound as {}, which is not known", path, name));
}

void SoundJoin::begin(const FilmPart& part) {
    const AVRational frame_s = {part.fps_denominator, part.fps_numerator};
    const SoundCut cut = cut_sound(codec_, sample_of_frame(part.first, frame_s),
                                   sample_of_frame(part.last + 1, frame_s));
    begin_ = at_ = cut.first_packet;
    end_ = cut.end_packet;
    film_end_ = sample_of_frame(part.count, frame_s);
}

void SoundJoin::take(AVPacket& packet, FilmMuxer* muxer) {
    const std::int64_t place = at_++;
    if (muxer == nullptr || place != next_) return;
    ++next_;
    // What is said of a part's ends is not of the film's.
    libav().av_packet_free_side_data(&packet);
    packet.flags &= ~AV_PKT_FLAG_DISCARD;
    packet.pts = packet.dts = place * codec_.packet_samples - codec_.delay;
    packet.duration = std::min<std::int64_t>(codec_.packet_samples, film_end_ - packet.pts);
    packet.pos = -1;
    muxer->write_sound(packet);
}

void SoundJoin::end(const std::string& path) const {
    if (at_ == end_) return;
    throw Failure(FailureKind::kInput,
                  fmt::format("'{}' is not what it says it is: it has {} packets of sound, and its "
                              "frames take {}",
                              path, at_ - begin_, end_ - begin_));
}

}  // namespace carom
