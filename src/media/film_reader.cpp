#include "media/film_reader.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <utility>

#include "media/film_input.h"
#include "media/libav.h"
#include "media/straight_alpha.h"

namespace carom {

namespace {

constexpr std::int64_t kMostPixels = 100'000'000;

/// The matrix that the frame names, or the one that players take where it names none: BT.709 for
/// high definition, else BT.601.
int matrix_of(const AVFrame& frame) {
    constexpr int kHdWidth = 1280, kSdHeight = 576;
    if (frame.colorspace != AVCOL_SPC_UNSPECIFIED) return frame.colorspace;
    return frame.width >= kHdWidth || frame.height > kSdHeight ? SWS_CS_ITU709 : SWS_CS_ITU601;
}

/// swscale's position of the left chroma sample: on the luma sample, between the rows, in 1/256.
constexpr int kLeftChroma = 0, kBetweenRows = 128;

}  // namespace

class FilmReader::Impl {
  public:
    explicit Impl(std::string path) : input_(std::move(path)) {
        const LibavMessages messages;
        open_decoder(with_alpha(input_.decoder()), messages);
        packet_.reset(allocated(libav().av_packet_alloc()));
        frame_.reset(allocated(libav().av_frame_alloc()));
    }

    bool next(Image& image) {
        const LibavMessages messages;
        while (true) {
            const int result = libav().avcodec_receive_frame(decoder_.get(), frame_.get());
            if (result == AVERROR_EOF) return false;
            if (result != AVERROR(EAGAIN)) {
                check(result, messages);
                convert(image, messages);
                if (!first_pts_) first_pts_ = frame_->best_effort_timestamp;
                return true;
            }
            feed(messages);
        }
    }

    double tick_s() const { return av_q2d(input_.stream().time_base); }
    /// A stamp is off by up to half a tick, and so is the first one unless it is 0.
    double time_error_s() const { return first_pts_ == 0 ? tick_s() / 2 : tick_s(); }
    double time_s() const {
        const std::int64_t pts = frame_->best_effort_timestamp;
        if (!first_pts_ || pts == AV_NOPTS_VALUE || *first_pts_ == AV_NOPTS_VALUE)
            return std::numeric_limits<double>::quiet_NaN();
        return static_cast<double>(pts - *first_pts_) * tick_s();
    }

  private:
    void check(int result, const LibavMessages& messages) const { input_.check(result, messages); }

    /// FFmpeg's own decoder of VP9 leaves the alpha out that stands beside the pictures; libvpx
    /// does not.
    const AVCodec* with_alpha(const AVCodec* codec) const {
        if (input_.stream().codecpar->codec_id != AV_CODEC_ID_VP9) return codec;
        if (input_.stream_text("alpha_mode").empty()) return codec;
        const AVCodec* libvpx = libav().avcodec_find_decoder_by_name("libvpx-vp9");
        return libvpx == nullptr ? codec : libvpx;
    }

    void open_decoder(const AVCodec* codec, const LibavMessages& messages) {
        decoder_.reset(allocated(libav().avcodec_alloc_context3(codec)));
        decoder_->max_pixels = kMostPixels;
        decoder_->err_recognition = AV_EF_EXPLODE;  // a damaged frame must not pass for a whole one
        decoder_->thread_count = 1;  // more would hold more frames; nobody waits for the reader
        check(libav().avcodec_parameters_to_context(decoder_.get(), input_.stream().codecpar),
              messages);
        check(libav().avcodec_open2(decoder_.get(), codec, nullptr), messages);
    }

    /// Gives the decoder the next packet, or the end.
    void feed(const LibavMessages& messages) {
        if (!input_.read(*packet_)) {
            check(libav().avcodec_send_packet(decoder_.get(), nullptr), messages);
            return;
        }
        const int sent = libav().avcodec_send_packet(decoder_.get(), packet_.get());
        libav().av_packet_unref(packet_.get());
        check(sent, messages);
    }

    /// The scaler for frames of this size and format, made anew when they change.
    void prepare_scaler(const LibavMessages& messages) {
        const int flags = SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP;
        const int width = frame_->width, height = frame_->height;
        const auto format = static_cast<AVPixelFormat>(frame_->format);
        const bool same = scaler_ && width == width_ && height == height_ && format == format_;
        if (same) return;
        scaler_.reset(allocated(libav().sws_alloc_context()));
        libav().av_opt_set_int(scaler_.get(), "srcw", width, 0);
        libav().av_opt_set_int(scaler_.get(), "srch", height, 0);
        libav().av_opt_set_int(scaler_.get(), "src_format", format, 0);
        libav().av_opt_set_int(scaler_.get(), "dstw", width, 0);
        libav().av_opt_set_int(scaler_.get(), "dsth", height, 0);
        libav().av_opt_set_int(scaler_.get(), "dst_format", AV_PIX_FMT_BGRA, 0);
        libav().av_opt_set_int(scaler_.get(), "sws_flags", flags, 0);
        if (frame_->chroma_location == AVCHROMA_LOC_LEFT) {
            libav().av_opt_set_int(scaler_.get(), "src_h_chr_pos", kLeftChroma, 0);
            libav().av_opt_set_int(scaler_.get(), "src_v_chr_pos", kBetweenRows, 0);
        }
        check(libav().sws_init_context(scaler_.get(), nullptr, nullptr), messages);
        const int unit = 1 << 16;  // swscale's 1 for contrast and saturation
        libav().sws_setColorspaceDetails(
            scaler_.get(), libav().sws_getCoefficients(matrix_of(*frame_)),
            frame_->color_range == AVCOL_RANGE_JPEG ? 1 : 0,
            libav().sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, unit, unit);
        width_ = width;
        height_ = height;
        format_ = format;
    }

    void convert(Image& image, const LibavMessages& messages) {
        prepare_scaler(messages);
        if (image.width_px != width_ || image.height_px != height_) image = Image(width_, height_);
        std::uint8_t* planes[] = {image.bgra.data()};
        const int strides[] = {static_cast<int>(image.stride_bytes())};
        check(libav().sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, height_, planes,
                                strides),
              messages);
        const AVPixFmtDescriptor* format = libav().av_pix_fmt_desc_get(format_);
        if (format != nullptr && (format->flags & AV_PIX_FMT_FLAG_ALPHA) != 0)
            premultiply_image(image);
    }

    FilmInput input_;
    CodecPtr decoder_;
    PacketPtr packet_;
    FramePtr frame_;
    std::optional<std::int64_t> first_pts_;
    ScalerPtr scaler_;
    int width_ = 0;
    int height_ = 0;
    AVPixelFormat format_ = AV_PIX_FMT_NONE;
};

FilmReader::FilmReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
FilmReader::~FilmReader() = default;
FilmReader::FilmReader(FilmReader&&) noexcept = default;
FilmReader& FilmReader::operator=(FilmReader&&) noexcept = default;

bool FilmReader::next(Image& frame) { return impl_->next(frame); }
double FilmReader::time_s() const { return impl_->time_s(); }
double FilmReader::time_error_s() const { return impl_->time_error_s(); }

}  // namespace carom
