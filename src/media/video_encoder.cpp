#include "media/video_encoder.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/check.h"
#include "media/encoder_settings.h"

namespace carom {

namespace {

/// Seconds between frames that a player can jump to.
constexpr double kKeyframeInterval = 1.0;

void set_timing(AVCodecContext& context, const FilmOptions& options) {
    context.time_base = {options.fps_denominator, options.fps_numerator};
    context.framerate = {options.fps_numerator, options.fps_denominator};
    const double fps = av_q2d(context.framerate);
    context.gop_size = static_cast<int>(std::clamp(fps * kKeyframeInterval, 1.0, 1000.0));
}

FramePtr make_frame(const AVCodecContext& context) {
    FramePtr frame(allocated(libav().av_frame_alloc()));
    frame->width = context.width;
    frame->height = context.height;
    frame->format = context.pix_fmt;
    frame->colorspace = context.colorspace;
    frame->color_primaries = context.color_primaries;
    frame->color_trc = context.color_trc;
    frame->color_range = context.color_range;
    frame->chroma_location = context.chroma_sample_location;
    if (libav().av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
    return frame;
}

}  // namespace

const AVCodec& find_encoder(const std::string& path, const FilmCodec& codec) {
    const AVCodec* found = libav().avcodec_find_encoder_by_name(codec.encoder);
    if (found != nullptr) return *found;
    throw Failure(FailureKind::kRun, fmt::format("cannot encode '{}': this FFmpeg has no {}, which "
                                                 "encodes {}",
                                                 path, codec.encoder, codec.title));
}

VideoEncoder::VideoEncoder(const std::string& path, const FilmChoice& choice,
                           const FilmOptions& options, bool global_header)
    : path_(path), converter_(choice.pixels) {
    const LibavMessages messages;
    const AVCodec& codec = find_encoder(path, *choice.codec);
    packet_.reset(allocated(libav().av_packet_alloc()));
    const auto open_with = [&](int threads) {
        context_.reset(allocated(libav().avcodec_alloc_context3(&codec)));
        if (global_header) context_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        int result = 0;
        encoder_threads_.watch("carom-encoder", [&] { result = open(choice, options, threads); });
        return result;
    };
    int result = open_with(options.threads > 0 ? options.threads : libav().av_cpu_count());
    // x264 says no more than that it failed: for want of threads it does without them.
    if (result == AVERROR_EXTERNAL && context_->thread_count > 1) result = open_with(1);
    if (result < 0)
        throw_libav(FailureKind::kRun, fmt::format("open the {} encoder for", choice.codec->title),
                    path_, result, messages);
    frame_ = make_frame(*context_);
    if (choice.pixels == PixelFormat::kYuva420) alpha_.emplace(path, codec, *context_, choice);
}

int VideoEncoder::open(const FilmChoice& choice, const FilmOptions& options, int threads) {
    set_picture_format(*context_, choice.pixels, options.width_px, options.height_px);
    set_timing(*context_, options);
    context_->flags |= AV_CODEC_FLAG_BITEXACT;
    context_->thread_count = choice.codec->threads ? threads : 1;
    int result = apply_settings(*context_, choice);
    if (result >= 0) result = libav().avcodec_open2(context_.get(), nullptr, nullptr);
    return result;
}

FilmStream VideoEncoder::stream() const {
    FilmStream stream;
    stream.parameters.reset(allocated(libav().avcodec_parameters_alloc()));
    if (libav().avcodec_parameters_from_context(stream.parameters.get(), context_.get()) < 0)
        throw std::bad_alloc();
    stream.time_base = context_->time_base;
    stream.alpha_beside = alpha_.has_value();
    return stream;
}

void VideoEncoder::encode(const Image& image, const TakePacket& take) {
    CAROM_CHECK(image.width_px, ==, context_->width);
    CAROM_CHECK(image.height_px, ==, context_->height);
    const double begin = calling_thread_cpu_s();
    // x264 copies its input; of an encoder that keeps it we get another frame here.
    if (libav().av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    FramePlanes planes;
    for (std::size_t i = 0; i < planes.data.size(); ++i)
        planes.data[i] = frame_->data[i], planes.stride[i] = frame_->linesize[i];
    converter_.convert(image, planes);
    frame_->pts = frames_++;
    const double converted = calling_thread_cpu_s();
    convert_cpu_s_ += converted - begin;
    if (alpha_) alpha_->encode(image);
    caller_cpu_s_ += calling_thread_cpu_s() - converted;
    send(frame_.get());
    receive(take);
}

void VideoEncoder::flush(const TakePacket& take) {
    send(nullptr);
    receive(take);
}

void VideoEncoder::send(const AVFrame* frame) {
    const LibavMessages messages;
    const double begin = calling_thread_cpu_s();
    const int result = libav().avcodec_send_frame(context_.get(), frame);
    caller_cpu_s_ += calling_thread_cpu_s() - begin;
    if (result < 0)
        throw_libav(FailureKind::kRun, fmt::format("encode frame {} of", frames_), path_, result,
                    messages);
}

void VideoEncoder::receive(const TakePacket& take) {
    const LibavMessages messages;
    while (true) {
        const double begin = calling_thread_cpu_s();
        const int result = libav().avcodec_receive_packet(context_.get(), packet_.get());
        caller_cpu_s_ += calling_thread_cpu_s() - begin;
        if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
        if (result < 0)
            throw_libav(FailureKind::kRun, "encode a frame of", path_, result, messages);
        // Of films of one or two frames x265 3.5 gives decoding times that are none.
        constexpr int kMostReordered = 16;
        if (packet_->dts < -kMostReordered) packet_->dts = packets_;
        ++packets_;
        packet_->duration = 1;  // encoders say none, and the last frame's must not be guessed
        if (alpha_) alpha_->attach(*packet_);
        take(*packet_);
        libav().av_packet_unref(packet_.get());
    }
}

double VideoEncoder::encode_cpu_s() const { return caller_cpu_s_ + encoder_threads_.total_s(); }

}  // namespace carom
