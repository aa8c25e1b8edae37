#include "media/film_muxer.h"

#include <fmt/format.h>

#include "core/reader_gone.h"

namespace carom {

namespace {

/// Ticks a second of which a whole number makes one frame: a multiple of the numerator of the frame
/// rate. Fine enough that players which round to ticks of their own lose nothing.
int exact_time_scale(AVRational time_base) {
    constexpr int kLeast = 10000;
    int scale = time_base.den;
    while (scale < kLeast) scale *= 2;
    return scale;
}

/// FFmpeg's list of options, freed at the end.
class Options {
  public:
    Options() = default;
    ~Options() { libav().av_dict_free(&dictionary_); }
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;
    void set(const char* key, const std::string& value) {
        if (libav().av_dict_set(&dictionary_, key, value.c_str(), 0) < 0) throw std::bad_alloc();
    }
    AVDictionary** get() { return &dictionary_; }

  private:
    AVDictionary* dictionary_ = nullptr;
};

}  // namespace

bool FilmMuxer::wants_global_header(const FilmFormat& format) {
    const AVOutputFormat* muxer = libav().av_guess_format(format.container, nullptr, nullptr);
    return muxer != nullptr && (muxer->flags & AVFMT_GLOBALHEADER) != 0;
}

void FilmMuxer::CloseContext::operator()(AVFormatContext* context) const {
    libav().avio_closep(&context->pb);
    libav().avformat_free_context(context);
}

std::string pipe_url(int descriptor) { return fmt::format("pipe:{}", descriptor); }

FilmMuxer::FilmMuxer(const std::string& url, const std::string& path, const FilmFormat& format,
                     const FilmStream& film, const std::string& title, const std::string& comment)
    : path_(path), time_base_(film.time_base) {
    const LibavMessages messages;
    AVFormatContext* context = nullptr;
    check(libav().avformat_alloc_output_context2(&context, nullptr, format.container, url.c_str()),
          "make a container for", messages);
    context_.reset(context);
    context->flags |= AVFMT_FLAG_BITEXACT;
    const bool into_pipe = url.starts_with("pipe:");
    if (into_pipe) context->flush_packets = 1;  // somebody waits
    // Of YUV4MPEG2 more than 8 bits are an extension, which FFmpeg and mplayer read.
    context->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;

    AVStream* stream = allocated(libav().avformat_new_stream(context, nullptr));
    check(libav().avcodec_parameters_copy(stream->codecpar, film.parameters.get()),
          "describe the stream of", messages);
    const AVRational frame_rate = {time_base_.den, time_base_.num};
    stream->time_base = time_base_;
    stream->avg_frame_rate = frame_rate;
    stream->r_frame_rate = frame_rate;
    // Apple's players want H.265 with its parameter sets in the index alone, and this name says so.
    if (film.parameters->codec_id == AV_CODEC_ID_HEVC && format.times == FilmTimes::kExact)
        stream->codecpar->codec_tag = MKTAG('h', 'v', 'c', '1');
    if (film.alpha_beside) stream->codecpar->format = AV_PIX_FMT_YUVA420P;
    if (film.sound) add_sound(*film.sound, format, messages);
    set_text("title", title);
    set_text("comment", comment);

    check(libav().avio_open(&context->pb, context->url, AVIO_FLAG_WRITE), "write", messages);
    write_header(format, into_pipe);
}

void FilmMuxer::add_sound(const AVCodecParameters& parameters, const FilmFormat& format,
                          const LibavMessages& messages) {
    AVStream* stream = allocated(libav().avformat_new_stream(context_.get(), nullptr));
    check(libav().avcodec_parameters_copy(stream->codecpar, &parameters), "describe the sound of",
          messages);
    stream->codecpar->codec_tag = 0;  // each family of containers has names of its own
    stream->time_base = {1, parameters.sample_rate};
    if (format.times == FilmTimes::kMilliseconds) {
        // Readers take the codec's delay from the times in the file; the muxer does not add it, but
        // would delay the pictures.
        sound_delay_ = parameters.initial_padding;
        context_->avoid_negative_ts = 0;
    }
}

void FilmMuxer::set_text(const char* key, const std::string& text) {
    if (!text.empty() && libav().av_dict_set(&context_->metadata, key, text.c_str(), 0) < 0)
        throw std::bad_alloc();
}

void FilmMuxer::write_header(const FilmFormat& format, bool into_pipe) {
    const LibavMessages messages;
    Options options;
    if (format.times == FilmTimes::kExact) {
        const std::string scale = std::to_string(exact_time_scale(time_base_));
        // delay_moov: the index is written when the first times are known, so that it can say that
        // the film begins at 0 although its first packet is decoded earlier.
        options.set("movflags",
                    into_pipe ? "+frag_keyframe+delay_moov+default_base_moof" : "+faststart");
        options.set("video_track_timescale", scale);
        options.set("movie_timescale", scale);
    }
    if (format.times == FilmTimes::kFraction) options.set("plays", "0");  // again and again
    check(libav().avformat_write_header(context_.get(), options.get()), "write", messages);
}

FilmMuxer::~FilmMuxer() = default;

void FilmMuxer::check(int result, const char* action, const LibavMessages& messages) const {
    if (result == AVERROR(EPIPE)) throw ReaderGone{};
    if (result < 0) throw_libav(FailureKind::kOutput, action, path_, result, messages);
}

void FilmMuxer::write(AVPacket& packet) { write_to(0, time_base_, packet); }

void FilmMuxer::write_sound(AVPacket& packet) {
    packet.pts += sound_delay_;
    packet.dts += sound_delay_;
    write_to(1, {1, context_->streams[1]->codecpar->sample_rate}, packet);
}

void FilmMuxer::write_to(int stream, AVRational time_base, AVPacket& packet) {
    const LibavMessages messages;
    libav().av_packet_rescale_ts(&packet, time_base, context_->streams[stream]->time_base);
    packet.stream_index = stream;
    check(libav().av_interleaved_write_frame(context_.get(), &packet), "write", messages);
    check(context_->pb->error, "write", messages);
}

void FilmMuxer::close() {
    const LibavMessages messages;
    check(libav().av_write_trailer(context_.get()), "write", messages);
    libav().avio_flush(context_->pb);
    check(context_->pb->error, "write", messages);
    check(libav().avio_closep(&context_->pb), "write", messages);
}

}  // namespace carom
