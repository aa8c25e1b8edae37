#include "media/vp9_alpha.h"

#include <cstring>

#include "core/check.h"
#include "media/yuv_planes.h"

namespace carom {

Vp9Alpha::Vp9Alpha(const std::string& path, const AVCodec& codec, const AVCodecContext& colours,
                   const FilmChoice& choice)
    : path_(path), context_(allocated(libav().avcodec_alloc_context3(&codec))) {
    const LibavMessages messages;
    context_->width = colours.width;
    context_->height = colours.height;
    context_->pix_fmt = AV_PIX_FMT_YUV420P;
    context_->color_range = AVCOL_RANGE_JPEG;
    context_->time_base = colours.time_base;
    context_->framerate = colours.framerate;
    context_->gop_size = colours.gop_size;
    context_->keyint_min = colours.keyint_min;
    context_->thread_count = colours.thread_count;
    context_->flags |= AV_CODEC_FLAG_BITEXACT;
    void* libvpx = context_->priv_data;
    const bool realtime = choice.preset > "5";
    check(libav().av_opt_set(libvpx, "deadline", realtime ? "realtime" : "good", 0), "set up",
          messages);
    check(libav().av_opt_set(libvpx, "cpu-used", choice.preset.c_str(), 0), "set up", messages);
    check(libav().av_opt_set_double(libvpx, "lossless", 1, 0), "set up", messages);
    check(libav().av_opt_set_double(libvpx, "lag-in-frames", 0, 0), "set up", messages);
    check(libav().av_opt_set_double(libvpx, "row-mt", 1, 0), "set up", messages);
    check(libav().avcodec_open2(context_.get(), nullptr, nullptr), "open the encoder for",
          messages);

    packet_.reset(allocated(libav().av_packet_alloc()));
    frame_.reset(allocated(libav().av_frame_alloc()));
    frame_->width = context_->width;
    frame_->height = context_->height;
    frame_->format = context_->pix_fmt;
    frame_->color_range = context_->color_range;
    if (libav().av_frame_get_buffer(frame_.get(), 0) < 0) throw std::bad_alloc();
    constexpr int kGrey = 128;
    for (int plane = 1; plane <= 2; ++plane)
        for (int y = 0; y < (frame_->height + 1) / 2; ++y)
            std::memset(frame_->data[plane] + y * frame_->linesize[plane], kGrey,
                        static_cast<std::size_t>(frame_->linesize[plane]));
}

void Vp9Alpha::check(int result, const char* action, const LibavMessages& messages) const {
    if (result < 0)
        throw_libav(FailureKind::kRun, std::string(action) + " the transparency of", path_, result,
                    messages);
}

void Vp9Alpha::encode(const Image& image) {
    const LibavMessages messages;
    if (libav().av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    copy_alpha(image, 8, frame_->data[0], frame_->linesize[0]);
    frame_->pts = frames_++;
    check(libav().avcodec_send_frame(context_.get(), frame_.get()), "encode", messages);
    check(libav().avcodec_receive_packet(context_.get(), packet_.get()), "encode", messages);
    waiting_.emplace_back(reinterpret_cast<const char*>(packet_->data),
                          static_cast<std::size_t>(packet_->size));
    libav().av_packet_unref(packet_.get());
}

void Vp9Alpha::attach(AVPacket& colours) {
    CAROM_CHECK(waiting_.empty(), ==, false);
    constexpr std::size_t kIdBytes = 8;  // big-endian, before the content
    const std::string& alpha = waiting_.front();
    std::uint8_t* data = allocated(libav().av_packet_new_side_data(
        &colours, AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, kIdBytes + alpha.size()));
    std::memset(data, 0, kIdBytes);
    data[kIdBytes - 1] = 1;
    std::memcpy(data + kIdBytes, alpha.data(), alpha.size());
    waiting_.pop_front();
}

}  // namespace carom
