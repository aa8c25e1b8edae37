#include "media/video_encoder.h"

#include <fmt/format.h>
extern "C" {
#include <libavutil/cpu.h>
#include <libavutil/opt.h>
}

#include <algorithm>

#include "core/check.h"
#include "core/diagnostics.h"

namespace carom {

namespace {

const std::vector<std::string>& presets() {
    static const std::vector<std::string> kNames = {"ultrafast", "superfast", "veryfast", "faster",
                                                    "fast",      "medium",    "slow",     "slower",
                                                    "veryslow",  "placebo"};
    return kNames;
}

[[noreturn]] void refuse(const std::string& text) { throw Failure(FailureKind::kInput, text); }

/// Seconds between frames that a player can jump to.
constexpr double kKeyframeInterval = 1.0;

void set_picture_format(AVCodecContext& context, const FilmOptions& options) {
    context.width = options.width_px;
    context.height = options.height_px;
    context.sample_aspect_ratio = {1, 1};
    context.pix_fmt = AV_PIX_FMT_YUV420P;
    context.colorspace = AVCOL_SPC_BT709;
    context.color_primaries = AVCOL_PRI_BT709;
    // Drawn pixels are sRGB. Films tagged BT.709 are shown like that by browsers and players, whose
    // screens decode both alike; the sRGB tag is less widely understood.
    context.color_trc = AVCOL_TRC_BT709;
    context.color_range = AVCOL_RANGE_MPEG;
    context.chroma_sample_location = AVCHROMA_LOC_LEFT;  // as Yuv420Converter filters
}

void set_timing(AVCodecContext& context, const FilmOptions& options) {
    context.time_base = {options.fps_denominator, options.fps_numerator};
    context.framerate = {options.fps_numerator, options.fps_denominator};
    const double fps = av_q2d(context.framerate);
    context.gop_size = static_cast<int>(std::clamp(fps * kKeyframeInterval, 1.0, 1000.0));
}

/// What we ask of x264 beyond its preset.
///
/// Looking ahead: on no thread of its own, and not as far. Each frame costs three to four bytes a
/// pixel; at 1280x720 veryfast's own 10 frames and thread take 36 MB more and give 1 dB for some
/// 10 % more bytes, which is no gain; medium's 40 take 79 MB more and give nothing.
///
/// 8x8 transform: ultrafast leaves it out, and without it the stream is not of the High profile. It
/// costs no time that can be measured.
///
/// Instructions: AVX2 where there is AVX-512. x264 r3095's AVX-512 code for looking ahead reads
/// memory that nobody has written, so that the coded pictures change from run to run with what
/// malloc gives (seen with glibc.malloc.perturb at most sizes; never without AVX-512). Costs a
/// tenth of the time to encode, and makes the film the same on both kinds of processors.
std::string encoder_settings(const std::string& preset) {
    std::string all = "8x8dct=1:sync-lookahead=0";
    if ((libav().av_get_cpu_flags() & AV_CPU_FLAG_AVX512) != 0) all += ":asm=AVX2";
    if (preset == "ultrafast" || preset == "superfast") return all;  // they do not look ahead
    return all + (preset == "veryfast" ? ":rc-lookahead=3" : ":rc-lookahead=20");
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

void require_film_options(const FilmOptions& options) {
    if (options.width_px < 2 || options.height_px < 2 || options.width_px % 2 != 0 ||
        options.height_px % 2 != 0)
        refuse(
            fmt::format("a film of {}x{} pixels cannot be encoded: width and height must be even",
                        options.width_px, options.height_px));
    if (options.fps_numerator <= 0 || options.fps_denominator <= 0)
        refuse(fmt::format("a film cannot have {}/{} frames a second", options.fps_numerator,
                           options.fps_denominator));
    if (options.crf < 1 || options.crf > 51)
        refuse(fmt::format("crf {} is not one of 1 (best) ... 51 (smallest){}", options.crf,
                           options.crf == 0 ? "; 0 would be lossless, which players of the High "
                                              "profile cannot show"
                                            : ""));
    if (options.threads < 0)
        refuse(fmt::format("the encoder cannot have {} threads", options.threads));
    const std::vector<std::string>& names = presets();
    if (std::find(names.begin(), names.end(), options.preset) != names.end()) return;
    const std::string nearest = nearest_word(options.preset, names);
    refuse(fmt::format("unknown preset '{}'{}; x264 has {}", options.preset,
                       nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest),
                       fmt::join(names, ", ")));
}

VideoEncoder::VideoEncoder(const std::string& path, const FilmOptions& options, bool global_header)
    : path_(path) {
    require_film_options(options);
    const LibavMessages messages;
    const AVCodec* codec = libav().avcodec_find_encoder_by_name("libx264");
    if (codec == nullptr)
        throw Failure(FailureKind::kRun, fmt::format("cannot encode '{}': this FFmpeg has no "
                                                     "libx264",
                                                     path));
    packet_.reset(allocated(libav().av_packet_alloc()));
    const auto open_with = [&](int threads) {
        context_.reset(allocated(libav().avcodec_alloc_context3(codec)));
        if (global_header) context_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        int result = 0;
        x264_threads_.watch("carom-x264", [&] { result = open(options, threads); });
        return result;
    };
    int result = open_with(options.threads > 0 ? options.threads : libav().av_cpu_count());
    // x264 says no more than that it failed: for want of threads it does without them.
    if (result == AVERROR_EXTERNAL && context_->thread_count > 1) result = open_with(1);
    if (result < 0)
        throw_libav(FailureKind::kRun, "open the H.264 encoder for", path_, result, messages);
    frame_ = make_frame(*context_);
}

int VideoEncoder::open(const FilmOptions& options, int threads) {
    set_picture_format(*context_, options);
    set_timing(*context_, options);
    context_->flags |= AV_CODEC_FLAG_BITEXACT;
    context_->thread_count = threads;

    void* x264 = context_->priv_data;
    int result = libav().av_opt_set(x264, "preset", options.preset.c_str(), 0);
    if (result >= 0) result = libav().av_opt_set(x264, "profile", "high", 0);
    if (result >= 0) result = libav().av_opt_set_double(x264, "crf", options.crf, 0);
    if (result >= 0)
        result =
            libav().av_opt_set(x264, "x264-params", encoder_settings(options.preset).c_str(), 0);
    if (result >= 0) result = libav().avcodec_open2(context_.get(), nullptr, nullptr);
    return result;
}

void VideoEncoder::encode(const Image& image, const TakePacket& take) {
    CAROM_CHECK(image.width_px, ==, context_->width);
    CAROM_CHECK(image.height_px, ==, context_->height);
    const double begin = calling_thread_cpu_s();
    // x264 copies its input, so the one frame is ours again after every call.
    if (libav().av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    converter_.convert(image, {frame_->data[0], frame_->data[1], frame_->data[2],
                               frame_->linesize[0], frame_->linesize[1], frame_->linesize[2]});
    frame_->pts = frames_++;
    convert_cpu_s_ += calling_thread_cpu_s() - begin;
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
        packet_->duration = 1;  // x264 says none, and the last frame's must not be guessed
        take(*packet_);
        libav().av_packet_unref(packet_.get());
    }
}

double VideoEncoder::encode_cpu_s() const { return caller_cpu_s_ + x264_threads_.total_s(); }

}  // namespace carom
