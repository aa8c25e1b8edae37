#include "media/encoder_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/check.h"

namespace carom {

namespace {

/// Sets options until one fails.
class Setter {
  public:
    explicit Setter(AVCodecContext& context) : options_(context.priv_data) {}
    Setter& text(const char* name, const std::string& value) {
        if (result_ >= 0) result_ = libav().av_opt_set(options_, name, value.c_str(), 0);
        return *this;
    }
    Setter& number(const char* name, int value) {
        if (result_ >= 0) result_ = libav().av_opt_set_double(options_, name, value, 0);
        return *this;
    }
    int result() const { return result_; }

  private:
    void* options_;
    int result_ = 0;
};

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
std::string x264_settings(const std::string& preset) {
    std::string all = "8x8dct=1:sync-lookahead=0";
    if ((libav().av_get_cpu_flags() & AV_CPU_FLAG_AVX512) != 0) all += ":asm=AVX2";
    if (preset == "ultrafast" || preset == "superfast") return all;  // they do not look ahead
    return all + (preset == "veryfast" ? ":rc-lookahead=3" : ":rc-lookahead=20");
}

int set_x264(AVCodecContext& context, const FilmChoice& choice) {
    Setter set(context);
    set.text("preset", choice.preset);
    // Others need the profiles High 10 and High 4:4:4, which x264 takes by itself.
    if (choice.pixels == PixelFormat::kYuv420) set.text("profile", "high");
    return set.number("crf", choice.level)
        .number("forced-idr", 1)  // a keyframe that is asked for is one to begin at
        .text("x264-params", x264_settings(choice.preset))
        .result();
}

/// x265 prints to standard error by itself, and writes its settings into the stream.
int set_x265(AVCodecContext& context, const FilmChoice& choice) {
    return Setter(context)
        .text("preset", choice.preset)
        .number("crf", choice.level)
        .text("x265-params", fmt::format("log-level=none:info=0:pools={}", context.thread_count))
        .result();
}

/// "lp" bounds the threads: their number in SVT-AV1 1, and a level of at most 6 from version 2 on.
int set_svt_av1(AVCodecContext& context, const FilmChoice& choice) {
    constexpr int kMostLevel = 6;
    Setter set(context);
    set.text("preset", choice.preset).number("crf", choice.level);
    if (context.thread_count < libav().av_cpu_count())
        set.text("svtav1-params", fmt::format("lp={}", std::min(context.thread_count, kMostLevel)));
    return set.result();
}

/// Constant quality: a bit rate of 0, else crf is only a bound. With alpha, which is a second
/// stream beside this one, each packet is one frame, and keyframes stand at fixed distances.
int set_vp9(AVCodecContext& context, const FilmChoice& choice) {
    constexpr const char* kFastestGood = "5";  // above it libvpx needs its realtime mode
    const bool alpha = pixel_format_info(choice.pixels).alpha;
    context.bit_rate = 0;
    if (alpha) context.keyint_min = context.gop_size;
    return Setter(context)
        .number("crf", choice.level)
        .text("deadline", choice.preset > kFastestGood ? "realtime" : "good")
        .text("cpu-used", choice.preset)
        .number("row-mt", 1)
        .number("tile-columns", 2)
        .number("auto-alt-ref", alpha ? 0 : 1)
        .result();
}

/// A fixed quantiser; editors expect Apple's name as that of the maker.
int set_prores(AVCodecContext& context, const FilmChoice& choice) {
    context.flags |= AV_CODEC_FLAG_QSCALE;
    context.global_quality = choice.level * FF_QP2LAMBDA;
    return Setter(context)
        .text("profile", "4444")
        .text("vendor", "apl0")
        .number("alpha_bits", pixel_format_info(choice.pixels).alpha ? 16 : 0)
        .result();
}

/// Version 3, each frame by itself and with checksums: as archives want it.
int set_ffv1(AVCodecContext& context) {
    context.level = 3;
    context.gop_size = 1;
    return Setter(context).number("slicecrc", 1).result();
}

int set_apng(AVCodecContext& context, const FilmChoice& choice) {
    context.compression_level = choice.level;
    return Setter(context).text("pred", choice.level == 1 ? "sub" : "mixed").result();
}

}  // namespace

AVPixelFormat libav_pixel_format(PixelFormat format) {
    switch (format) {
        case PixelFormat::kYuv420:
            return AV_PIX_FMT_YUV420P;
        case PixelFormat::kYuv444:
            return AV_PIX_FMT_YUV444P;
        case PixelFormat::kYuv420Ten:
            return AV_PIX_FMT_YUV420P10LE;
        case PixelFormat::kYuv444Ten:
            return AV_PIX_FMT_YUV444P10LE;
        case PixelFormat::kYuva420:
            return AV_PIX_FMT_YUV420P;  // alpha beside: vp9_alpha.h
        case PixelFormat::kYuva444Ten:
            return AV_PIX_FMT_YUVA444P10LE;
        case PixelFormat::kRgb:
            return AV_PIX_FMT_RGB24;
        case PixelFormat::kRgba:
            return AV_PIX_FMT_RGBA;
        case PixelFormat::kBgr0:
            return AV_PIX_FMT_BGR0;
        case PixelFormat::kBgra:
            return AV_PIX_FMT_BGRA;
        case PixelFormat::kPalette:
            return AV_PIX_FMT_PAL8;
    }
    throw Bug("a pixel format without a name of FFmpeg's");
}

void set_picture_format(AVCodecContext& context, PixelFormat format, int width_px, int height_px) {
    context.width = width_px;
    context.height = height_px;
    context.sample_aspect_ratio = {1, 1};
    context.pix_fmt = libav_pixel_format(format);
    context.color_primaries = AVCOL_PRI_BT709;
    if (!pixel_format_info(format).yuv) {
        context.colorspace = AVCOL_SPC_RGB;
        context.color_trc = AVCOL_TRC_IEC61966_2_1;
        context.color_range = AVCOL_RANGE_JPEG;
        return;
    }
    context.colorspace = AVCOL_SPC_BT709;
    // Drawn pixels are sRGB. Films tagged BT.709 are shown like that by browsers and players, whose
    // screens decode both alike; the sRGB tag is less widely understood.
    context.color_trc = AVCOL_TRC_BT709;
    context.color_range = AVCOL_RANGE_MPEG;
    context.chroma_sample_location = AVCHROMA_LOC_LEFT;  // as the converters filter
}

int apply_settings(AVCodecContext& context, const FilmChoice& choice) {
    const std::string_view codec = choice.codec->name;
    if (codec == "h264") return set_x264(context, choice);
    if (codec == "h265") return set_x265(context, choice);
    if (codec == "av1") return set_svt_av1(context, choice);
    if (codec == "vp9") return set_vp9(context, choice);
    if (codec == "prores") return set_prores(context, choice);
    if (codec == "ffv1") return set_ffv1(context);
    if (codec == "apng") return set_apng(context, choice);
    return 0;
}

}  // namespace carom
