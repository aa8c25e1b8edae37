#include "media/video_encoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/check.h"
#include "media/encoder_settings.h"

namespace carom {

namespace {

/// Seconds between frames that a player can jump to.
constexpr double kKeyframeInterval = 1.0;

/// Frames that are equal before an encoder is closed: to open it again takes as long as some of
/// them, and costs a keyframe.
constexpr int kEqualBeforeStill = 12;

int keyframe_interval(const FilmOptions& options) {
    const double fps = static_cast<double>(options.fps_numerator) / options.fps_denominator;
    return static_cast<int>(std::clamp(fps * kKeyframeInterval, 1.0, 1000.0));
}

void set_timing(AVCodecContext& context, const FilmOptions& options) {
    context.time_base = {options.fps_denominator, options.fps_numerator};
    context.framerate = {options.fps_numerator, options.fps_denominator};
    context.gop_size = keyframe_interval(options);
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
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
    : path_(path),
      codec_(find_encoder(path, *choice.codec)),
      choice_(choice),
      options_(options),
      global_header_(global_header),
      converter_(choice.pixels) {
    packet_.reset(allocated(libav().av_packet_alloc()));
    open();
    frame_ = make_frame(*context_);
    if (choice.pixels == PixelFormat::kYuva420) alpha_.emplace(path, codec_, *context_, choice);
    // Parameter sets of our own need a place in the header. Keyframes in a row are not repeated.
    if (choice.codec->name == "h264" && global_header && context_->gop_size > kEqualBeforeStill)
        still_ = H264Still::read(
            {context_->extradata, static_cast<std::size_t>(context_->extradata_size)});
}

void VideoEncoder::open() {
    const LibavMessages messages;
    const auto open_with = [&](int threads) {
        context_.reset(allocated(libav().avcodec_alloc_context3(&codec_)));
        if (global_header_) context_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        int result = 0;
        encoder_threads_.watch("carom-encoder", [&] { result = open(threads); });
        return result;
    };
    int result = open_with(options_.threads > 0 ? options_.threads : libav().av_cpu_count());
    // x264 says no more than that it failed: for want of threads it does without them.
    if (result == AVERROR_EXTERNAL && context_->thread_count > 1) result = open_with(1);
    if (result < 0)
        throw_libav(FailureKind::kRun, fmt::format("open the {} encoder for", choice_.codec->title),
                    path_, result, messages);
}

int VideoEncoder::open(int threads) {
    set_picture_format(*context_, choice_.pixels, options_.width_px, options_.height_px);
    set_timing(*context_, options_);
    context_->flags |= AV_CODEC_FLAG_BITEXACT;
    context_->thread_count = choice_.codec->threads ? threads : 1;
    int result = apply_settings(*context_, choice_);
    if (result >= 0) result = libav().avcodec_open2(context_.get(), nullptr, nullptr);
    return result;
}

void VideoEncoder::close() {
    caller_cpu_s_ += encoder_threads_.total_s();  // which end with it
    context_.reset();
    encoder_threads_ = {};
}

FilmStream VideoEncoder::stream() const {
    FilmStream stream;
    stream.parameters.reset(allocated(libav().avcodec_parameters_alloc()));
    AVCodecParameters& parameters = *stream.parameters;
    if (libav().avcodec_parameters_from_context(&parameters, context_.get()) < 0)
        throw std::bad_alloc();
    if (still_) {
        const std::string& set = still_->parameter_set();
        const auto size = static_cast<std::size_t>(parameters.extradata_size);
        auto* headers = static_cast<std::uint8_t*>(
            allocated(libav().av_mallocz(size + set.size() + AV_INPUT_BUFFER_PADDING_SIZE)));
        std::copy_n(parameters.extradata, size, headers);
        std::copy(set.begin(), set.end(), headers + size);
        libav().av_free(parameters.extradata);
        parameters.extradata = headers;
        parameters.extradata_size = static_cast<int>(size + set.size());
    }
    stream.time_base = context_->time_base;
    stream.alpha_beside = alpha_.has_value();
    return stream;
}

void VideoEncoder::fill_frame(const Image& image, const ChangedParts& changed) {
    CAROM_CHECK(image.width_px, ==, options_.width_px);
    CAROM_CHECK(image.height_px, ==, options_.height_px);
    const double begin = calling_thread_cpu_s();
    // x264 copies its input; of an encoder that keeps it we get another frame here, a copy.
    if (libav().av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    FramePlanes planes;
    for (std::size_t i = 0; i < planes.data.size(); ++i)
        planes.data[i] = frame_->data[i], planes.stride[i] = frame_->linesize[i];
    converter_.convert(image, frames_ == 0 ? ChangedParts{} : changed, planes);
    frame_->pts = frames_;
    convert_cpu_s_ += calling_thread_cpu_s() - begin;
}

void VideoEncoder::encode(const Image& image, const ChangedParts& changed, const TakePacket& take) {
    fill_frame(image, changed);
    if (stands_still(changed)) {
        if (!repeating_) begin_stillness(take);
        repeat(take);
        ++frames_;
        return;
    }
    if (repeating_) {
        open();
        repeating_ = false;
    }
    ++frames_;
    if (alpha_) {
        const double begin = calling_thread_cpu_s();
        alpha_->encode(image);
        caller_cpu_s_ += calling_thread_cpu_s() - begin;
    }
    send(frame_.get());
    receive(take);
}

bool VideoEncoder::stands_still(const ChangedParts& changed) {
    equal_ = changed.is_nothing() && frames_ > 0 ? equal_ + 1 : 0;
    return still_ && equal_ >= kEqualBeforeStill;
}

void VideoEncoder::begin_stillness(const TakePacket& take) {
    send(nullptr);
    receive(take);
    if (!still_) {  // its numbers are not those that were expected
        open();
        return;
    }
    close();
    repeating_ = true;
    still_keyframe_.clear();
}

void VideoEncoder::repeat(const TakePacket& take) {
    if (!repeating_) {
        send(frame_.get());
        receive(take);
        return;
    }
    const auto interval = static_cast<std::int64_t>(keyframe_interval(options_));
    const bool key = frames_ - keyframe_ >= interval;
    if (key && still_keyframe_.empty()) make_still_keyframe();
    const std::string unit = key ? still_keyframe_ : still_->repeat(frames_);
    if (key) still_->follow(bytes_of(unit), frames_);
    give_unit(unit, key, take);
}

/// Of two keyframes in a row the second: the number by which an IDR picture differs from the one
/// before it is then not that of an encoder's first, which may follow.
void VideoEncoder::make_still_keyframe() {
    open();
    const std::int64_t frame = frame_->pts;
    for (int i = 0; i < 2; ++i, ++frame_->pts) {
        frame_->pict_type = AV_PICTURE_TYPE_I;
        send(frame_.get());
    }
    frame_->pict_type = AV_PICTURE_TYPE_NONE;
    frame_->pts = frame;
    send(nullptr);
    const double begin = calling_thread_cpu_s();
    while (libav().avcodec_receive_packet(context_.get(), packet_.get()) >= 0) {
        CAROM_CHECK((packet_->flags & AV_PKT_FLAG_KEY) != 0, ==, true);
        still_keyframe_ =
            H264Still::pictures_of({packet_->data, static_cast<std::size_t>(packet_->size)});
        libav().av_packet_unref(packet_.get());
    }
    caller_cpu_s_ += calling_thread_cpu_s() - begin;
    CAROM_CHECK(still_keyframe_.empty(), ==, false);
    close();
}

void VideoEncoder::give_unit(const std::string& unit, bool key, const TakePacket& take) {
    std::string padded = unit;
    padded.resize(unit.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    packet_->data = reinterpret_cast<std::uint8_t*>(padded.data());
    packet_->size = static_cast<int>(unit.size());
    packet_->flags = key ? AV_PKT_FLAG_KEY : 0;
    packet_->pts = frames_;
    packet_->dts = packets_ - delay_;
    give(take);
}

void VideoEncoder::flush(const TakePacket& take) {
    if (repeating_) return;  // there is nothing that an encoder would hold back
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
        if (still_) {
            if (packets_ == 0) delay_ = packet_->pts - packet_->dts;
            packet_->dts = packets_ - delay_;  // an encoder that was opened again begins anew
            const std::span unit(packet_->data, static_cast<std::size_t>(packet_->size));
            if (!still_->follow(unit, packet_->pts)) still_.reset();
        }
        give(take);
    }
}

void VideoEncoder::give(const TakePacket& take) {
    ++packets_;
    if ((packet_->flags & AV_PKT_FLAG_KEY) != 0) keyframe_ = packet_->pts;
    packet_->duration = 1;  // encoders say none, and the last frame's must not be guessed
    if (alpha_) alpha_->attach(*packet_);
    take(*packet_);
    libav().av_packet_unref(packet_.get());
}

double VideoEncoder::encode_cpu_s() const { return caller_cpu_s_ + encoder_threads_.total_s(); }

}  // namespace carom
