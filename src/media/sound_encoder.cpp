#include "media/sound_encoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

void set_one_channel(AVChannelLayout& layout) {
    layout.order = AV_CHANNEL_ORDER_NATIVE;
    layout.nb_channels = 1;
    layout.u.mask = AV_CH_LAYOUT_MONO;
}

/// Of one channel both are an array of floats.
AVSampleFormat sample_format(const SoundCodec& codec) {
    return codec.name == kAac.name ? AV_SAMPLE_FMT_FLTP : AV_SAMPLE_FMT_FLT;
}

class SoundEncoder {
  public:
    SoundEncoder(const std::string& path, const SoundCodec& codec, int rate)
        : path_(path), codec_(codec) {
        const LibavMessages messages;
        const AVCodec& found = find_encoder(path, codec);
        context_.reset(allocated(libav().avcodec_alloc_context3(&found)));
        context_->sample_rate = rate;
        context_->sample_fmt = sample_format(codec);
        set_one_channel(context_->ch_layout);
        context_->bit_rate = codec.bits_per_s;
        context_->time_base = {1, rate};
        context_->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
        context_->thread_count = 1;
        check(libav().avcodec_open2(context_.get(), nullptr, nullptr), "open", messages);
        if (context_->frame_size != codec.packet_samples ||
            context_->initial_padding != codec.delay)
            throw Failure(
                FailureKind::kRun,
                fmt::format("cannot encode the sound of '{}': this FFmpeg's {} has "
                            "packets of {} samples after {}, not of {} after {}",
                            path, codec.encoder, context_->frame_size, context_->initial_padding,
                            codec.packet_samples, codec.delay));
        packet_.reset(allocated(libav().av_packet_alloc()));
    }

    EncodedSound encode(const SoundSamples& sound) {
        EncodedSound encoded;
        const std::size_t size = sound.samples.size();
        const auto step = static_cast<std::size_t>(codec_.packet_samples);
        for (std::size_t at = 0; at < size; at += step) {
            const FramePtr frame = make_frame(at);
            const std::size_t count = std::min(step, size - at);
            auto* samples = reinterpret_cast<float*>(frame->data[0]);
            std::copy_n(sound.samples.begin() + static_cast<std::ptrdiff_t>(at), count, samples);
            std::fill(samples + count, samples + step, 0.0F);
            send(frame.get(), encoded.packets);
        }
        send(nullptr, encoded.packets);
        encoded.parameters.reset(allocated(libav().avcodec_parameters_alloc()));
        if (libav().avcodec_parameters_from_context(encoded.parameters.get(), context_.get()) < 0)
            throw std::bad_alloc();
        return encoded;
    }

  private:
    FramePtr make_frame(std::size_t at) const {
        FramePtr frame(allocated(libav().av_frame_alloc()));
        frame->nb_samples = codec_.packet_samples;
        frame->format = context_->sample_fmt;
        frame->sample_rate = context_->sample_rate;
        set_one_channel(frame->ch_layout);
        if (libav().av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
        frame->pts = static_cast<std::int64_t>(at);
        return frame;
    }

    void send(const AVFrame* frame, std::vector<PacketPtr>& packets) {
        const LibavMessages messages;
        check(libav().avcodec_send_frame(context_.get(), frame), "encode", messages);
        while (true) {
            const int result = libav().avcodec_receive_packet(context_.get(), packet_.get());
            if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
            check(result, "encode", messages);
            packets.push_back(std::move(packet_));
            packet_.reset(allocated(libav().av_packet_alloc()));
        }
    }

    void check(int result, const char* action, const LibavMessages& messages) const {
        if (result < 0)
            throw_libav(FailureKind::kRun,
                        fmt::format("{} the sound ({}) of", action, codec_.title), path_, result,
                        messages);
    }

    std::string path_;
    const SoundCodec& codec_;
    CodecPtr context_;
    PacketPtr packet_;
};

}  // namespace

const AVCodec& find_encoder(const std::string& path, const SoundCodec& codec) {
    const AVCodec* found = libav().avcodec_find_encoder_by_name(codec.encoder);
    if (found != nullptr) return *found;
    throw Failure(FailureKind::kRun,
                  fmt::format("cannot encode the sound of '{}': this FFmpeg has no {}, which "
                              "encodes {}; film.sound: false leaves the sound out",
                              path, codec.encoder, codec.title));
}

EncodedSound encode_sound(const std::string& path, const SoundCodec& codec,
                          const SoundSamples& sound) {
    return SoundEncoder(path, codec, static_cast<int>(std::lround(sound.rate))).encode(sound);
}

}  // namespace carom
